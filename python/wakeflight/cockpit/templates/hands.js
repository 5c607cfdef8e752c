// The pilot's hands: keys, gamepad, two fields to drag in. Sticks are shares of travel from the stop: right, aft, up, right pedal.
"use strict";
const Hands = (function () {
  const NAMES = ["lateral", "longitudinal", "collective", "pedal"];
  // share of travel a second while a key is down, and while it comes back; how far keys reach from where sticks rest
  const MOVES = 0.35, RETURNS = 0.9, REACH = [0.3, 0.3, 1, 0.5], COLLECTIVE = 0.16;
  const KEYS = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [1, -1], ArrowDown: [1, 1], KeyS: [2, -1], KeyW: [2, 1], KeyA: [3, -1], KeyD: [3, 1] };
  const held = (v) => Math.min(1, Math.max(0, v));

  function make(left, right) {
    const down = new Set(), rest = [0.5, 0.5, 0.5, 0.5], now = [0.5, 0.5, 0.5, 0.5], pads = [null, null];
    let padUsed = false;
    function begin(trim, continued, at) {
      NAMES.forEach((name, k) => {
        if (!continued) rest[k] = now[k] = trim[name];
        else if (at) now[k] = at[k];
      });
    }
    function hold() { now.forEach((v, k) => { rest[k] = v; }); }
    const typing = (event) => event.target.tagName === "SELECT" || event.ctrlKey || event.metaKey || event.altKey;
    window.addEventListener("keydown", (event) => {
      if (typing(event) || !KEYS[event.code]) return;
      down.add(event.code);
      event.preventDefault();
    });
    window.addEventListener("keyup", (event) => down.delete(event.code));
    window.addEventListener("blur", () => down.clear());
    [left, right].forEach((pad, k) => {
      const to = (event) => {
        const box = pad.getBoundingClientRect();
        pads[k] = [2 * (event.clientX - box.left) / box.width - 1, 2 * (event.clientY - box.top) / box.height - 1].map((v) => Math.max(-1, Math.min(1, v)));
      };
      pad.addEventListener("pointerdown", (event) => { pad.setPointerCapture(event.pointerId); to(event); });
      pad.addEventListener("pointermove", (event) => { if (pads[k]) to(event); });
      for (const kind of ["pointerup", "pointercancel"]) pad.addEventListener(kind, () => { pads[k] = null; });
    });
    function gamepad() {
      const found = navigator.getGamepads ? [...navigator.getGamepads()].find((each) => each && each.connected) : null;
      if (!found) return null;
      const quiet = (v) => (Math.abs(v || 0) < 0.06 ? 0 : v);
      return { yaw: quiet(found.axes[0]), lift: -quiet(found.axes[1]), roll: quiet(found.axes[2]), pitch: quiet(found.axes[3]) };
    }
    function toward(k, target, rate, dt) { now[k] += Math.max(-rate * dt, Math.min(rate * dt, target - now[k])); }
    // sticks after `dt` seconds
    function advance(dt) {
      const push = [0, 0, 0, 0];
      for (const code of down) push[KEYS[code][0]] += KEYS[code][1];
      const pad = gamepad(), asked = [null, null, null, null];
      if (pad && (pad.roll || pad.pitch || pad.yaw || padUsed)) {
        padUsed = true;
        asked[0] = rest[0] + 0.4 * pad.roll; asked[1] = rest[1] + 0.4 * pad.pitch; asked[3] = rest[3] + 0.5 * pad.yaw;
      }
      if (pad && pad.lift) push[2] += pad.lift;
      if (pads[0]) { push[2] -= pads[0][1]; asked[3] = rest[3] + 0.5 * pads[0][0]; }
      if (pads[1]) { asked[0] = rest[0] + 0.4 * pads[1][0]; asked[1] = rest[1] + 0.4 * pads[1][1]; }
      now[2] = held(now[2] + COLLECTIVE * push[2] * dt);
      for (const k of [0, 1, 3]) {
        if (asked[k] !== null) toward(k, asked[k], 4, dt);
        else if (push[k]) toward(k, rest[k] + REACH[k] * Math.sign(push[k]), MOVES, dt);
        else toward(k, rest[k], RETURNS, dt);
        now[k] = held(now[k]);
      }
      [left, right].forEach((each, k) => {
        const spot = each.querySelector("i"), [x, y] = pads[k] || [0, 0];
        spot.style.left = 50 + 50 * x + "%";
        spot.style.top = 50 + 50 * y + "%";
      });
      return now;
    }
    return { begin, hold, advance };
  }
  return { make };
})();
