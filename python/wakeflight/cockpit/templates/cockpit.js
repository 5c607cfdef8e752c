// The page: takes pictures as they come, draws the newest, says where the sticks are.
"use strict";
(function () {
  const part = (name) => document.getElementById(name);
  const view = View.make(part("view")), hands = Hands.make(part("left"), part("right"));
  const instruments = Instruments.make(part("tiles"), part("ball"), part("sticks"));
  const seen = { frames: 0, drawn: 0, rate: 0, scalars: null, status: null };
  window.cockpit = seen;
  let socket = null, opening = null, frame = null, fresh = false, last = null, said = "", saidAt = 0, counted = 0, since = performance.now();

  const say = (message) => { if (socket && socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message)); };

  function opened(told) {
    const before = opening;
    opening = told;
    // sticks stay where they are when another inflow model takes over
    hands.begin(told.trim, told.continued && before !== null, null);
    if (!told.continued) view.state.heading = null;
  }
  function status(told) {
    seen.status = told;
    part("state").textContent = told.inflow + ", " + told.state;
    part("note").textContent = told.note + (told.state === "ended" && told.kept.length ? " · kept: " + told.kept.join(", ") : "");
    document.querySelector("[data-do=fly]").textContent = told.state === "flying" ? "pause" : "fly";
    const select = part("inflow");
    if (select.length !== told.models.length) select.replaceChildren(...told.models.map((name) => new Option(name, name)));
    select.value = told.preparing || told.inflow;
  }
  function read(buffer) {
    const run = new DataView(buffer).getUint32(0, true);
    if (!opening || run !== opening.run) return;
    const values = new Float32Array(buffer, 4), names = opening.scalars, n = opening.blades;
    const scalars = {};
    names.forEach((name, k) => { scalars[name] = values[k]; });
    let at = names.length;
    const take = (count) => values.subarray(at, (at += count));
    frame = { opening, scalars, motion: take(3 * n), disk: take(3), wake: null, strength: null };
    if (opening.ages) { frame.wake = take(3 * n * opening.ages); frame.strength = take(n * opening.ages); }
    seen.frames++;
    seen.scalars = scalars;
    fresh = true;
  }
  function connect() {
    socket = new WebSocket("ws://" + location.host + "/fly" + location.search);
    socket.binaryType = "arraybuffer";
    socket.onmessage = (event) => {
      if (typeof event.data !== "string") return read(event.data);
      const told = JSON.parse(event.data);
      if (told.opening) opened(told.opening);
      if (told.status) status(told.status);
    };
    socket.onclose = () => {
      part("state").textContent = "no connection";
      part("note").textContent = "the session has ended, or the connection was lost; looking for it again";
      opening = null;
      setTimeout(connect, 1500);
    };
  }
  function pace(scalars) {
    const slow = scalars.pace < 0.97;
    part("pace").className = slow ? "slow" : "";
    part("factor").textContent = (slow ? "slow motion × " : "real time × ") + Instruments.text(scalars.pace, 2);
    part("rate").textContent = Instruments.text(seen.rate, 0) + " pictures/s";
    part("clock").textContent = Instruments.text(scalars.time, 1) + " s";
    part("craft").textContent = opening.aircraft;
  }
  function turn(now) {
    const dt = last === null ? 0 : Math.min(0.1, (now - last) / 1000);
    last = now;
    if (opening) {
      // in slow motion hands are as slow as the time
      const slow = seen.scalars ? Math.min(1, Math.max(0.02, seen.scalars.pace)) : 1;
      const sticks = hands.advance(dt * slow).map((v) => Math.round(v * 1e5) / 1e5), text = sticks.join();
      if (now - saidAt > 15 && text !== said) { say({ sticks, run: opening.run }); said = text; saidAt = now; }
    }
    if (fresh && frame && opening) {
      fresh = false;
      view.draw(frame);
      instruments.draw(frame);
      pace(frame.scalars);
      seen.drawn++;
      counted++;
    }
    if (now - since > 1000) { seen.rate = 1000 * counted / (now - since); counted = 0; since = now; }
    requestAnimationFrame(turn);
  }
  const again = () => { if (frame) fresh = true; };
  const ORDERS = {
    Space: () => say({ do: seen.status && seen.status.state === "flying" ? "pause" : "fly" }),
    KeyN: () => say({ do: "step" }),
    KeyR: () => say({ do: "restart" }),
    KeyI: () => { const s = part("inflow"); s.selectedIndex = (s.selectedIndex + 1) % s.length; say({ inflow: s.value }); },
    KeyC: () => { view.state.seat = !view.state.seat; part("camera").textContent = view.state.seat ? "outside" : "seat"; again(); },
    KeyV: () => { view.state.wake = !view.state.wake; part("wake").textContent = view.state.wake ? "hide wake" : "show wake"; again(); },
    KeyT: () => hands.hold(),
  };
  window.addEventListener("keydown", (event) => {
    if (event.repeat || event.target.tagName === "SELECT" || event.ctrlKey || event.metaKey || event.altKey || !ORDERS[event.code]) return;
    event.preventDefault();
    ORDERS[event.code]();
  });
  document.querySelectorAll("[data-do]").forEach((button) => button.addEventListener("click", () => {
    if (button.dataset.do === "fly") ORDERS.Space(); else say({ do: button.dataset.do });
    button.blur();
  }));
  for (const [name, order] of [["camera", ORDERS.KeyC], ["wake", ORDERS.KeyV], ["hold", ORDERS.KeyT]]) part(name).addEventListener("click", () => { order(); part(name).blur(); });
  part("inflow").addEventListener("change", (event) => { say({ inflow: event.target.value }); event.target.blur(); });
  part("view").addEventListener("pointermove", again);
  part("view").addEventListener("wheel", again);
  window.addEventListener("resize", again);
  connect();
  requestAnimationFrame(turn);
})();
