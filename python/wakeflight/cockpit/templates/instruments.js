// Instruments: attitude, sticks, and numbers in the units of pilots.
"use strict";
const Instruments = (function () {
  const DEG = 180 / Math.PI, KNOT = 3600 / 1852, FOOT = 1 / 0.3048;
  // no zero below zero
  const text = (v, digits) => (Number.isFinite(v) ? v.toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1").replace("-", "−") : "–");
  const signed = (v, digits) => (v >= 0 && Number(v.toFixed(digits)) > 0 ? "+" : "") + text(v, digits);
  // title, unit, what stands there
  const TILES = [
    ["speed", "kt", (s) => text(s.speed * KNOT, 0)],
    ["altitude", "ft", (s) => text(s.altitude * FOOT, 0)],
    ["climb", "ft/min", (s) => signed(s.climb_rate * FOOT * 60, 0)],
    ["heading", "°", (s) => text(((s.yaw * DEG) % 360 + 360) % 360, 0)],
    ["height", "ft", (s) => text(s.height * FOOT, 0)],
    ["sideslip", "°", (s) => signed(s.sideslip * DEG, 1)],
    ["roll φ", "°", (s) => signed(s.roll * DEG, 1)],
    ["pitch θ", "°", (s) => signed(s.pitch * DEG, 1)],
    ["load factor", "g", (s) => text(s.load_factor, 2)],
    ["p", "°/s", (s) => signed(s.p * DEG, 1)],
    ["q", "°/s", (s) => signed(s.q * DEG, 1)],
    ["r", "°/s", (s) => signed(s.r * DEG, 1)],
    ["power", "kW", (s) => text(s.power / 1e3, 0)],
    ["torque", "kN m", (s) => text(s.torque / 1e3, 1)],
    ["thrust / weight", "", (s, o) => text(s.thrust / o.weight, 2)],
    ["thrust", "kN", (s) => text(s.thrust / 1e3, 1)],
    ["inflow λ₀", "", (s) => text(s.inflow_mean, 4)],
    ["inflow vᵢ", "m/s", (s) => text(s.induced_velocity, 1)],
    ["coning β₀", "°", (s) => text(s.beta_0 * DEG, 1)],
    ["flapping β₁c", "°", (s) => signed(s.beta_1c * DEG, 1)],
    ["flapping β₁s", "°", (s) => signed(s.beta_1s * DEG, 1)],
    ["an exchange takes: half · 99 % · longest, of", "ms",
      (s) => [s.exchange_median, s.exchange_p99, s.exchange_max].map((v) => text(v, 1)).join(" · ") + " of " + text(s.exchange_length, 2), true],
  ];

  function make(list, ball, sticks) {
    const values = TILES.map(([title, unit, , wide]) => {
      const tile = document.createElement("div"), term = document.createElement("dt"), value = document.createElement("dd");
      const number = document.createElement("span"), small = document.createElement("small");
      if (wide) tile.className = "wide";
      term.textContent = title;
      small.textContent = " " + unit;
      value.append(number, small);
      tile.append(term, value);
      list.append(tile);
      return number;
    });
    function size(canvas) {
      const ratio = Math.min(window.devicePixelRatio || 1, 2), n = Math.round(canvas.getBoundingClientRect().width * ratio);
      if (canvas.width !== n) canvas.width = canvas.height = n;
      const pen = canvas.getContext("2d");
      pen.setTransform(n / 155, 0, 0, n / 155, 0, 0);
      pen.clearRect(0, 0, 155, 155);
      return pen;
    }
    function attitude(s) {
      const pen = size(ball), c = 77.5, R = 74, perDegree = 1.9;
      pen.save();
      pen.beginPath(); pen.arc(c, c, R, 0, 2 * Math.PI); pen.clip();
      pen.translate(c, c); pen.rotate(-s.roll); pen.translate(0, s.pitch * DEG * perDegree);
      pen.fillStyle = "#4f86b3"; pen.fillRect(-200, -400, 400, 400);
      pen.fillStyle = "#7a5f43"; pen.fillRect(-200, 0, 400, 400);
      pen.strokeStyle = pen.fillStyle = "#fff"; pen.lineWidth = 1.2; pen.font = "9px system-ui, sans-serif";
      for (let mark = -90; mark <= 90; mark += 10) {
        const half = mark === 0 ? 200 : mark % 20 ? 10 : 18, y = -mark * perDegree;
        pen.beginPath(); pen.moveTo(-half, y); pen.lineTo(half, y); pen.stroke();
        if (mark && mark % 20 === 0) pen.fillText(text(mark, 0), half + 3, y + 3);
      }
      pen.restore();
      pen.strokeStyle = "#ffd24a"; pen.lineWidth = 2.5;
      pen.beginPath(); pen.moveTo(c - 34, c); pen.lineTo(c - 12, c); pen.lineTo(c, c + 8); pen.lineTo(c + 12, c); pen.lineTo(c + 34, c); pen.stroke();
      pen.save(); pen.translate(c, c); pen.strokeStyle = "#e8edf2"; pen.lineWidth = 1;
      for (const mark of [-60, -30, 0, 30, 60]) { pen.save(); pen.rotate(mark / DEG); pen.beginPath(); pen.moveTo(0, -R); pen.lineTo(0, -R + 7); pen.stroke(); pen.restore(); }
      pen.rotate(-s.roll); pen.fillStyle = "#ffd24a"; pen.beginPath(); pen.moveTo(0, -R + 8); pen.lineTo(-5, -R + 16); pen.lineTo(5, -R + 16); pen.fill();
      pen.restore();
    }
    function hands(s, trim) {
      const pen = size(sticks), [x0, y0, n] = [40, 4, 108];
      pen.fillStyle = "#1b252e"; pen.strokeStyle = "#4a5b68"; pen.lineWidth = 1;
      for (const box of [[x0, y0, n, n], [6, y0, 18, n], [x0, 126, n, 18]]) { pen.fillRect(...box); pen.strokeRect(...box); }
      const at = (kind) => [[x0 + n * kind.lateral, y0 + n * kind.longitudinal], [15, y0 + n * (1 - kind.collective)], [x0 + n * kind.pedal, 135]];
      const blades = { lateral: s.lateral_blades, longitudinal: s.longitudinal_blades, collective: s.collective_blades, pedal: s.pedal_blades };
      const mark = (kind, colour, radius, open) => at(kind).forEach(([x, y]) => {
        pen.beginPath(); pen.arc(x, y, radius, 0, 2 * Math.PI);
        if (open) { pen.strokeStyle = colour; pen.stroke(); } else { pen.fillStyle = colour; pen.fill(); }
      });
      mark(trim, "#9fb0bf", 3, true); mark(blades, "#ffd24a", 6, true); mark(s, "#6cb6ff", 4, false);
      pen.fillStyle = "#9fb0bf"; pen.font = "9px system-ui, sans-serif";
      pen.fillText("collective", 2, 122); pen.fillText("pedals", 6, 139); pen.fillText("cyclic", x0 + 3, y0 + 11);
    }
    let shown = 0;
    function draw(frame) {
      attitude(frame.scalars);
      hands(frame.scalars, frame.opening.trim);
      const now = performance.now();
      // numbers that change faster cannot be read
      if (now - shown < 90) return;
      shown = now;
      TILES.forEach(([, , value], k) => { values[k].textContent = value(frame.scalars, frame.opening); });
    }
    return { draw };
  }
  return { make, text };
})();
