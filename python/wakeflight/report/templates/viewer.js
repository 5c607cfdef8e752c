// Inflow models side by side in three dimensions, in step. Plain canvas: no library, no graphics card needed.
// Lengths over R. Hub axes and earth axes are drawn alike: x aft, y right, z up.
"use strict";
(function () {
  const root = document.getElementById("wake-view");
  if (!root) return;
  const data = JSON.parse(document.getElementById("wake-data").textContent);
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const floats = (text) => new Float32Array(bytes(text));
  const shorts = (text) => new Int16Array(bytes(text));
  const FULL = 32767, DEG = 180 / Math.PI, BLADE = ["#0072B2", "#D55E00", "#009E73", "#B0479B"];
  const names = Object.keys(data.maneuvers);
  const part = (name) => root.querySelector("[data-part=" + name + "]");

  for (const name of names) {
    const maneuver = data.maneuvers[name];
    maneuver.time = floats(maneuver.time);
    for (const model of maneuver.models) {
      for (const key of ["attitude", "path", "blades", "inflowMean", "disk"]) if (model[key]) model[key] = floats(model[key]);
      for (const key of ["wake", "strength"]) if (model[key]) model[key] = shorts(model[key]);
    }
    part("maneuver").add(new Option(name.replaceAll("-", " "), name));
  }
  const state = { maneuver: names[0], frame: 0, yaw: -0.9, up: 0.42, zoom: 1, playing: false, last: 0 };
  const panels = data.maneuvers[names[0]].models.map((_, k) => part("panels").querySelectorAll("canvas")[k]);
  const current = () => data.maneuvers[state.maneuver];

  // --- rotations ------------------------------------------------------------------------------------------------------
  // rows of the matrix that takes hub axes (x aft, y right, z up) to earth axes drawn alike (x south, y east, z up)
  function attitude(model, f) {
    const [roll, pitch, yaw] = model.attitude.subarray(3 * f, 3 * f + 3);
    const [cr, sr, cp, sp, cy, sy] = [Math.cos(roll), Math.sin(roll), Math.cos(pitch), Math.sin(pitch), Math.cos(yaw), Math.sin(yaw)];
    const earth = [
      [cp * cy, sr * sp * cy - cr * sy, cr * sp * cy + sr * sy],
      [cp * sy, sr * sp * sy + cr * cy, cr * sp * sy - sr * cy],
      [-sp, sr * cp, cr * cp],
    ];
    const [c, s] = [Math.cos(data.rotor.shaft_tilt), Math.sin(data.rotor.shaft_tilt)];
    // body x forward, y right, z down from hub axes: shaft tilted forward, then x and z turned round
    const body = [[-c, 0, s], [0, 1, 0], [-s, 0, -c]];
    const m = earth.map((row) => [0, 1, 2].map((k) => row[0] * body[0][k] + row[1] * body[1][k] + row[2] * body[2][k]));
    return [m[0].map((v) => -v), m[1], m[2].map((v) => -v)];
  }
  const times = (m, p) => m.map((r) => r[0] * p[0] + r[1] * p[1] + r[2] * p[2]);
  const turned = (m, p) => [0, 1, 2].map((k) => m[0][k] * p[0] + m[1][k] * p[1] + m[2][k] * p[2]);
  const identity = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

  // camera: azimuth and elevation of the eye about the middle of the wake
  function camera(canvas) {
    const [cy, sy, cu, su] = [Math.cos(state.yaw), Math.sin(state.yaw), Math.cos(state.up), Math.sin(state.up)];
    const right = [-sy, cy, 0], toward = [cy * cu, sy * cu, su], up = [-cy * su, -sy * su, cu];
    const scale = state.zoom * Math.min(canvas.width, 1.15 * canvas.height) / 7.2;
    const centre = part("axes").value === "hub" ? [1.9, 0, -0.1] : [1.5, 0, 0];
    return (p) => {
      const q = [p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]];
      const dot = (a) => a[0] * q[0] + a[1] * q[1] + a[2] * q[2];
      return [canvas.width / 2 + scale * dot(right), canvas.height / 2 - scale * dot(up), dot(toward)];
    };
  }

  // --- what is drawn ----------------------------------------------------------------------------------------------------
  function node(model, f, b, k) {
    const i = 3 * ((f * model.nBlades + b) * model.nNodes + k), s = model.reach / FULL;
    return [s * model.wake[i], s * model.wake[i + 1], s * model.wake[i + 2]];
  }
  function colour(share) {
    const n = data.colours.length;
    return data.colours[Math.max(0, Math.min(n - 1, Math.floor(share * n)))];
  }
  function wakeLines(model, f, place, lines) {
    const by = part("colour").value, [low, high] = current().circulation;
    const blades = part("blades").value === "first" ? 1 : model.nBlades;
    for (let b = 0; b < blades; b++) {
      let from = place(node(model, f, b, 0));
      for (let k = 1; k < model.nNodes; k++) {
        const to = place(node(model, f, b, k));
        const i = (f * model.nBlades + b) * model.nNodes + k;
        const gamma = model.strongest * model.strength[i] / FULL;
        const share = by === "age" ? k / (model.nNodes - 1) : (gamma - low) / (high - low || 1);
        lines.push({ depth: (from[2] + to[2]) / 2, points: [from, to], stroke: by === "blade" ? BLADE[b] : colour(share), width: 1.5 });
        from = to;
      }
    }
  }
  function bladeShapes(model, f, place, shapes) {
    const { hinge_offset: e, root_cutout: cut, chord, rotation: turn = 1 } = data.rotor;
    for (let b = 0; b < model.nBlades; b++) {
      const [psi, flap, lead] = model.blades.subarray(3 * (f * model.nBlades + b), 3 * (f * model.nBlades + b) + 3);
      const [er, et] = [[Math.cos(psi), Math.sin(psi)], [-Math.sin(psi), Math.cos(psi)]];
      const at = (r, along) => {
        const l = Math.max(r - e, 0), c = l * Math.cos(flap);
        const radial = Math.min(r, e) + c * Math.cos(lead), side = c * Math.sin(lead) + along;
        return place([radial * er[0] + side * et[0], turn * (radial * er[1] + side * et[1]), l * Math.sin(flap)]);
      };
      const corners = [at(cut, 0.25 * chord), at(1, 0.25 * chord), at(1, -0.75 * chord), at(cut, -0.75 * chord)];
      const depth = corners.reduce((sum, c) => sum + c[2], 0) / 4 + 0.01;
      shapes.push({ depth, points: corners, fill: b ? "#333" : BLADE[0], stroke: b ? "#333" : BLADE[0], width: 1 });
      shapes.push({ depth: depth - 0.01, points: [place([0, 0, 0]), at(cut, 0)], stroke: "#555", width: 2 });
    }
  }
  function diskShapes(model, f, place, shapes) {
    const circle = (r, n, a0 = 0, a1 = 2 * Math.PI) =>
      Array.from({ length: n + 1 }, (_, k) => place([r * Math.cos(a0 + (a1 - a0) * k / n), r * Math.sin(a0 + (a1 - a0) * k / n), 0]));
    if (model.disk) {
      const [mean, cosine, sine] = model.disk.subarray(3 * f, 3 * f + 3), [low, high] = current().inflow;
      const rings = 5, parts = 24, inner = data.rotor.root_cutout;
      for (let i = 0; i < rings; i++) for (let j = 0; j < parts; j++) {
        const [r0, r1] = [i, i + 1].map((k) => inner + (1 - inner) * k / rings);
        const [a0, a1] = [j, j + 1].map((k) => 2 * Math.PI * k / parts), r = (r0 + r1) / 2, a = (a0 + a1) / 2;
        const lambda = mean + r * (cosine * Math.cos(a) + sine * Math.sin(a));
        const points = [...circle(r0, 2, a0, a1), ...circle(r1, 2, a0, a1).reverse()];
        const fill = colour((lambda - low) / (high - low));
        shapes.push({ depth: points.reduce((s, p) => s + p[2], 0) / points.length - 0.02, points, fill, stroke: fill, width: 1, alpha: 0.75 });
      }
    }
    const rim = circle(1, 72);
    for (let k = 0; k < 72; k++) shapes.push({ depth: (rim[k][2] + rim[k + 1][2]) / 2 - 0.01, points: [rim[k], rim[k + 1]], stroke: "#999", width: 1 });
  }
  function pathLines(model, f, fromEarth, place, lines) {
    const here = model.path.subarray(3 * f, 3 * f + 3), n = model.path.length / 3;
    const at = (g) => {
      const d = [0, 1, 2].map((k) => model.path[3 * g + k] - here[k]);
      return place(fromEarth([-d[0], d[1], -d[2]]));
    };
    for (let g = 1; g < n; g++) {
      const far = Math.abs(g - f) > 12;
      if (far && g > f) break;
      if (far && f - g > 24) continue;
      const [a, b] = [at(g - 1), at(g)];
      lines.push({ depth: (a[2] + b[2]) / 2, points: [a, b], stroke: "#000", width: 1.2, dash: g > f ? [3, 4] : null });
    }
  }
  function drawPanel(canvas, model) {
    const ratio = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
    canvas.width = Math.round(box.width * ratio); canvas.height = Math.round(box.height * ratio);
    const pen = canvas.getContext("2d"), f = state.frame, look = camera(canvas);
    const tilt = attitude(model, f), hub = part("axes").value === "hub";
    const place = (p) => look(hub ? p : times(tilt, p));
    const fromEarth = hub ? (p) => turned(tilt, p) : (p) => p;
    const shapes = [];
    diskShapes(model, f, place, shapes);
    bladeShapes(model, f, place, shapes);
    if (model.wake) wakeLines(model, f, place, shapes);
    pathLines(model, f, fromEarth, hub ? look : look, shapes);
    shapes.sort((a, b) => a.depth - b.depth);
    for (const shape of shapes) {
      pen.globalAlpha = shape.alpha || 1;
      pen.beginPath();
      shape.points.forEach((p, k) => (k ? pen.lineTo(p[0], p[1]) : pen.moveTo(p[0], p[1])));
      if (shape.fill) { pen.closePath(); pen.fillStyle = shape.fill; pen.fill(); }
      pen.strokeStyle = shape.stroke; pen.lineWidth = shape.width * ratio; pen.setLineDash(shape.dash || []); pen.stroke();
    }
    pen.globalAlpha = 1; pen.setLineDash([]);
    axesMark(pen, canvas, ratio, hub);
    const [roll, pitch] = model.attitude.subarray(3 * f, 3 * f + 3);
    pen.fillStyle = "#222"; pen.font = "600 " + 14 * ratio + "px system-ui, sans-serif";
    pen.fillText(model.name, 10 * ratio, 20 * ratio);
    pen.font = 12 * ratio + "px system-ui, sans-serif";
    pen.fillText("θ " + text(pitch * DEG, 1) + "°   φ " + text(roll * DEG, 1) + "°   mean inflow λ₀ " + text(model.inflowMean[f], 4), 10 * ratio, 38 * ratio);
    if (!model.wake) pen.fillText("no wake; disk coloured by inflow λ", 10 * ratio, 55 * ratio);
  }
  function text(v, digits) {
    return v.toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1").replace("-", "−");
  }
  function axesMark(pen, canvas, ratio, hub) {
    const [cy, sy, cu, su] = [Math.cos(state.yaw), Math.sin(state.yaw), Math.cos(state.up), Math.sin(state.up)];
    const size = state.zoom * Math.min(canvas.width, 1.15 * canvas.height) / 7.2;
    const at = [Math.min(70 * ratio + size * 0.2, canvas.width / 3), canvas.height - 46 * ratio];
    const labels = hub ? ["x aft", "y right", "z up"] : ["south", "east", "up"];
    pen.font = 11 * ratio + "px system-ui, sans-serif";
    [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((a, k) => {
      const x = at[0] + 0.5 * size * (-sy * a[0] + cy * a[1]), y = at[1] - 0.5 * size * (-cy * su * a[0] - sy * su * a[1] + cu * a[2]);
      pen.beginPath(); pen.moveTo(at[0], at[1]); pen.lineTo(x, y); pen.strokeStyle = "#666"; pen.lineWidth = ratio; pen.stroke();
      pen.fillStyle = "#444"; pen.fillText(labels[k], x + 3 * ratio, y - 2 * ratio);
    });
    pen.fillText("axes: 0.5 R", 10 * ratio, canvas.height - 8 * ratio);
  }
  function legend() {
    const by = part("colour").value, pen = part("scale").getContext("2d"), { width, height } = part("scale");
    pen.clearRect(0, 0, width, height);
    const [low, high] = current().circulation, [l0, l1] = current().inflow;
    const wake = current().models.find((m) => m.wake), turns = wake ? wake.turns : 0;
    const bar = (x, w, from, to, title) => {
      for (let k = 0; k < w; k++) { pen.fillStyle = colour(k / w); pen.fillRect(x + k, 18, 1, 12); }
      pen.fillStyle = "#222"; pen.font = "12px system-ui, sans-serif";
      pen.textAlign = "left"; pen.fillText(title, x, 12); pen.fillText(from, x, 44);
      pen.textAlign = "right"; pen.fillText(to, x + w, 44); pen.textAlign = "left";
    };
    if (wake && by === "circulation") bar(10, 240, text(low, 1), text(high, 1), "wake: circulation Γ [m²/s]");
    if (wake && by === "age") bar(10, 240, "0", turns.toFixed(0), "wake: age [revolutions]");
    if (wake && by === "blade") BLADE.forEach((c, k) => {
      pen.fillStyle = c; pen.fillRect(10 + 62 * k, 20, 14, 10); pen.fillStyle = "#222"; pen.font = "12px system-ui, sans-serif";
      pen.fillText("blade " + (k + 1), 28 + 62 * k, 30);
    });
    if (current().models.some((m) => m.disk)) bar(wake ? 300 : 10, 240, text(l0, 3), text(l1, 3), "dynamic inflow: λ [–], positive down");
  }
  function draw() {
    const maneuver = current(), t = maneuver.time[state.frame];
    part("slider").max = maneuver.time.length - 1;
    part("slider").value = state.frame;
    part("clock").textContent = t.toFixed(2) + " s, revolution " + (t * data.omega / (2 * Math.PI)).toFixed(2);
    maneuver.models.forEach((model, k) => drawPanel(panels[k], model));
    legend();
  }
  function setFrame(f) {
    const n = current().time.length;
    state.frame = ((Math.round(f) % n) + n) % n;
    draw();
  }
  // --- hands ---------------------------------------------------------------------------------------------------------
  const VIEWS = { oblique: [-0.9, 0.42], side: [-Math.PI / 2, 0], top: [-Math.PI / 2, Math.PI / 2 - 1e-6], rear: [0, 0] };
  root.querySelectorAll("[data-view]").forEach((button) => button.addEventListener("click", () => {
    [state.yaw, state.up] = VIEWS[button.dataset.view];
    state.zoom = 1;
    draw();
  }));
  part("slider").addEventListener("input", (event) => setFrame(Number(event.target.value)));
  part("maneuver").addEventListener("change", (event) => { state.maneuver = event.target.value; setFrame(0); });
  for (const name of ["colour", "axes", "blades"]) part(name).addEventListener("change", draw);
  part("play").addEventListener("click", () => {
    state.playing = !state.playing;
    part("play").textContent = state.playing ? "pause" : "play";
    state.last = 0;
    if (state.playing) requestAnimationFrame(step);
  });
  function step(now) {
    if (!state.playing) return;
    const pause = 60 / Number(part("speed").value);
    if (now - state.last >= pause) { state.last = now; setFrame(state.frame + 1); }
    requestAnimationFrame(step);
  }
  for (const canvas of panels) {
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      if (!(event.buttons & 1)) return;
      state.yaw -= 0.008 * event.movementX;
      state.up = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, state.up + 0.008 * event.movementY));
      draw();
    });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      state.zoom = Math.max(0.3, Math.min(8, state.zoom * Math.exp(-0.001 * event.deltaY)));
      draw();
    }, { passive: false });
  }
  window.addEventListener("resize", draw);
  window.wakeView = { state, setFrame, draw, panels };
  draw();
})();
