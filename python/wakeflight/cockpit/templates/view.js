// The view out: horizon, ground, the helicopter with blades and wake, in perspective. Plain canvas: no library, no graphics card
// needed. Lengths over R. Hub axes x aft, y right, z up; body axes x forward, y right, z down; earth axes north, east, down.
"use strict";
const View = (function () {
  const PLASMA = ["#0d0887", "#41049d", "#6a00a8", "#8f0da4", "#b12a90", "#cc4778", "#e16462", "#f2844b", "#fca636", "#fcce25", "#f0f921"];
  const NEAR = 0.08, GRID = 100, REACH = 24;
  // stations of the hull: x forward, half width, top, bottom (z up), over R
  const HULL = [[0.62, 0.03, -0.08, -0.14], [0.5, 0.11, 0.02, -0.2], [0.25, 0.15, 0.1, -0.22], [-0.2, 0.15, 0.12, -0.2], [-0.45, 0.08, 0.08, -0.08],
    [-1.1, 0.03, 0.06, 0.0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const times = (m, p) => [dot(m[0], p), dot(m[1], p), dot(m[2], p)];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => { const n = Math.hypot(...a); return a.map((v) => v / n); };

  function earthOfBody(roll, pitch, yaw) {
    const [cr, sr, cp, sp, cy, sy] = [Math.cos(roll), Math.sin(roll), Math.cos(pitch), Math.sin(pitch), Math.cos(yaw), Math.sin(yaw)];
    return [
      [cp * cy, sr * sp * cy - cr * sy, cr * sp * cy + sr * sy],
      [cp * sy, sr * sp * sy + cr * cy, cr * sp * sy - sr * cy],
      [-sp, sr * cp, cr * cp],
    ];
  }
  function bodyOfHub(forward, lateral) {
    const [st, ct, sp, cp] = [Math.sin(-forward), Math.cos(forward), Math.sin(lateral), Math.cos(lateral)];
    const hub = [[-ct, 0, st], [st * sp, cp, ct * sp], [-st * cp, sp, -ct * cp]];
    return [0, 1, 2].map((i) => hub.map((row) => row[i]));
  }

  function make(canvas) {
    const pen = canvas.getContext("2d");
    const state = { around: 0, above: 0.32, far: 4.6, seat: false, wake: true, heading: null };
    let width = 1, height = 1, ratio = 1;

    function camera(frame) {
      const s = frame.scalars, body = frame.attitude;
      if (state.seat) {
        const forward = body.map((row) => row[0]), right = body.map((row) => row[1]), down = body.map((row) => row[2]);
        return { at: times(body, [0.45, 0, -0.05]), forward, right, down };
      }
      // it follows the heading softly
      if (state.heading === null) state.heading = s.yaw;
      let turn = s.yaw - state.heading;
      turn -= 2 * Math.PI * Math.round(turn / (2 * Math.PI));
      state.heading += 0.08 * turn;
      const azimuth = state.heading + Math.PI + state.around;
      const out = [Math.cos(state.above) * Math.cos(azimuth), Math.cos(state.above) * Math.sin(azimuth), -Math.sin(state.above)];
      const at = out.map((v) => state.far * v), forward = unit(at.map((v, k) => [0, 0, 0.35][k] - v));
      const right = unit(cross([0, 0, 1], forward));
      return { at, forward, right, down: cross(forward, right) };
    }
    function lens(eye) {
      const focal = 0.95 * Math.max(height, 0.72 * width), [x0, y0] = [width / 2, height * (state.seat ? 0.5 : 0.46)];
      const turn = (p) => { const q = [p[0] - eye.at[0], p[1] - eye.at[1], p[2] - eye.at[2]]; return [dot(q, eye.right), dot(q, eye.down), dot(q, eye.forward)]; };
      const flat = (q) => [x0 + focal * q[0] / q[2], y0 + focal * q[1] / q[2]];
      return { turn, flat, focal, x0, y0 };
    }
    function clipped(a, b) {
      if (a[2] < NEAR && b[2] < NEAR) return null;
      const cut = (from, to) => { const k = (NEAR - from[2]) / (to[2] - from[2]); return from.map((v, i) => v + k * (to[i] - v)); };
      return [a[2] < NEAR ? cut(a, b) : a, b[2] < NEAR ? cut(b, a) : b];
    }
    function line(look, p, q) {
      const piece = clipped(look.turn(p), look.turn(q));
      if (!piece) return;
      const [a, b] = piece.map(look.flat);
      pen.moveTo(a[0], a[1]);
      pen.lineTo(b[0], b[1]);
    }
    function polygon(look, points) {
      const seen = points.map(look.turn);
      if (seen.some((q) => q[2] < NEAR)) return null;
      return { points: seen.map(look.flat), depth: seen.reduce((sum, q) => sum + q[2], 0) / seen.length };
    }

    function skyAndGround(frame, eye, look) {
      const sky = pen.createLinearGradient(0, 0, 0, height);
      sky.addColorStop(0, "#3b6f9e"); sky.addColorStop(1, "#a9c7dc");
      pen.fillStyle = sky;
      pen.fillRect(0, 0, width, height);
      // where a direction points down: a x + b y + c > 0 on the screen
      const [a, b, c] = [eye.right[2], eye.down[2], eye.forward[2] * look.focal];
      const side = (p) => a * (p[0] - look.x0) + b * (p[1] - look.y0) + c;
      const frameOf = [[0, 0], [width, 0], [width, height], [0, height]], ground = [];
      frameOf.forEach((p, k) => {
        const q = frameOf[(k + 1) % 4], [m, n] = [side(p), side(q)];
        if (m > 0) ground.push(p);
        if ((m > 0) !== (n > 0)) ground.push([p[0] + (q[0] - p[0]) * m / (m - n), p[1] + (q[1] - p[1]) * m / (m - n)]);
      });
      if (ground.length > 2) {
        pen.beginPath();
        ground.forEach((p, k) => (k ? pen.lineTo(...p) : pen.moveTo(...p)));
        pen.fillStyle = "#5d6f53";
        pen.fill();
      }
      const s = frame.scalars, R = frame.opening.radius, level = s.height / R, step = GRID / R;
      const [north, east] = [-(s.north % GRID) / R, -(s.east % GRID) / R];
      pen.beginPath();
      for (let k = -REACH; k <= REACH; k++) {
        line(look, [north + k * step, east - REACH * step, level], [north + k * step, east + REACH * step, level]);
        line(look, [north - REACH * step, east + k * step, level], [north + REACH * step, east + k * step, level]);
      }
      pen.strokeStyle = "rgba(225, 235, 215, .38)";
      pen.lineWidth = ratio;
      pen.stroke();
      const shadow = polygon(look, Array.from({ length: 24 }, (_, k) => [Math.cos(k * Math.PI / 12), Math.sin(k * Math.PI / 12), level]));
      if (shadow) fill(shadow.points, "rgba(20, 25, 20, .45)");
    }
    function fill(points, colour, edge) {
      pen.beginPath();
      points.forEach((p, k) => (k ? pen.lineTo(p[0], p[1]) : pen.moveTo(p[0], p[1])));
      pen.closePath();
      pen.fillStyle = colour;
      pen.fill();
      if (edge) { pen.strokeStyle = edge; pen.lineWidth = ratio; pen.stroke(); }
    }

    function wakeLines(frame, look, place) {
      const { ages, blades } = frame.opening, strength = frame.strength;
      let low = Infinity, high = -Infinity;
      for (const v of strength) { if (v < low) low = v; if (v > high) high = v; }
      const groups = PLASMA.map(() => []);
      for (let b = 0; b < blades; b++) {
        let from = null;
        for (let k = 0; k < ages; k++) {
          const i = b * ages + k, to = look.turn(place([frame.wake[3 * i], frame.wake[3 * i + 1], frame.wake[3 * i + 2]]));
          const piece = from && clipped(from, to);
          if (piece) groups[Math.min(PLASMA.length - 1, Math.floor(PLASMA.length * (strength[i] - low) / (high - low || 1)))].push(piece);
          from = to;
        }
      }
      pen.lineWidth = 1.6 * ratio;
      groups.forEach((pieces, k) => {
        pen.beginPath();
        for (const piece of pieces) {
          const [a, b] = piece.map(look.flat);
          pen.moveTo(a[0], a[1]);
          pen.lineTo(b[0], b[1]);
        }
        pen.strokeStyle = PLASMA[k];
        pen.stroke();
      });
      return [low, high];
    }
    function craft(frame, look, place, shapes) {
      const ring = (row) => Array.from({ length: 8 }, (_, k) => {
        const a = (k + 0.5) * Math.PI / 4, [x, half, top, bottom] = row;
        return times(frame.attitude, [x, 1.08 * half * Math.cos(a), -((top + bottom) / 2 + 1.08 * (top - bottom) / 2 * Math.sin(a))]);
      });
      const rings = HULL.map(ring);
      for (let i = 0; i + 1 < rings.length; i++) for (let k = 0; k < 8; k++) {
        const shape = polygon(look, [rings[i][k], rings[i][(k + 1) % 8], rings[i + 1][(k + 1) % 8], rings[i + 1][k]]);
        const shade = 74 + Math.round(46 * Math.sin((k + 1) * Math.PI / 4));
        if (shape) shapes.push({ ...shape, fill: i === 0 ? "#26323c" : "rgb(" + shade + "," + (shade + 8) + "," + (shade + 2) + ")" });
      }
      for (const part of [[[-1.0, 0, -0.04], [-1.1, 0, -0.36], [-1.24, 0, -0.36], [-1.16, 0, -0.02]],
        [[-1.02, -0.24, -0.02], [-1.02, 0.24, -0.02], [-1.14, 0.24, -0.02], [-1.14, -0.24, -0.02]]]) {
        const shape = polygon(look, part.map((p) => times(frame.attitude, p)));
        if (shape) shapes.push({ ...shape, fill: "#5b6660", edge: "#39423d" });
      }
      const { hinge_offset: e, root_cutout: cut, chord } = frame.opening.rotor, sense = frame.opening.rotation;
      for (let b = 0; b < frame.opening.blades; b++) {
        const [psi, flap, lead] = frame.motion.subarray(3 * b, 3 * b + 3);
        const [er, et] = [[Math.cos(psi), Math.sin(psi)], [-Math.sin(psi), Math.cos(psi)]];
        const at = (r, along) => {
          const l = Math.max(r - e, 0), c = l * Math.cos(flap), radial = Math.min(r, e) + c * Math.cos(lead), side = c * Math.sin(lead) + along;
          return place([radial * er[0] + side * et[0], sense * (radial * er[1] + side * et[1]), l * Math.sin(flap)]);
        };
        const shape = polygon(look, [at(cut, 0.25 * chord), at(1, 0.25 * chord), at(1, -0.75 * chord), at(cut, -0.75 * chord)]);
        if (shape) shapes.push({ ...shape, fill: b ? "#1c2126" : "#0072b2", edge: b ? "#1c2126" : "#0072b2" });
        const arm = polygon(look, [place([0, 0, 0]), at(cut, 0)]);
        if (arm) shapes.push({ ...arm, edge: "#333a40" });
      }
    }
    function scale(low, high) {
      const [x, y, w] = [12 * ratio, 64 * ratio, 110 * ratio];
      PLASMA.forEach((colour, k) => { pen.fillStyle = colour; pen.fillRect(x + k * w / PLASMA.length, y, w / PLASMA.length + 1, 8 * ratio); });
      pen.fillStyle = "#10161c";
      pen.font = 11 * ratio + "px system-ui, sans-serif";
      pen.fillText("Γ " + low.toFixed(0).replace("-", "−") + " to " + high.toFixed(0) + " m²/s", x, y + 20 * ratio);
    }
    function draw(frame) {
      ratio = Math.min(window.devicePixelRatio || 1, 2);
      const box = canvas.getBoundingClientRect(), [w, h] = [Math.round(box.width * ratio), Math.round(box.height * ratio)];
      if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
      [width, height] = [w, h];
      const s = frame.scalars, opening = frame.opening;
      frame.attitude = earthOfBody(s.roll, s.pitch, s.yaw);
      const eye = camera(frame), look = lens(eye), tilt = bodyOfHub(...opening.shaft_tilt);
      const place = (p) => times(frame.attitude, times(tilt, p).map((v, k) => v + opening.hub[k]));
      skyAndGround(frame, eye, look);
      let range = null;
      if (frame.wake && state.wake) range = wakeLines(frame, look, place);
      const shapes = [];
      if (!state.seat) craft(frame, look, place, shapes);
      shapes.sort((a, b) => b.depth - a.depth);
      for (const shape of shapes) {
        if (shape.fill) fill(shape.points, shape.fill, shape.edge);
        else { pen.beginPath(); pen.moveTo(...shape.points[0]); pen.lineTo(...shape.points[1]); pen.strokeStyle = shape.edge; pen.lineWidth = 3 * ratio; pen.stroke(); }
      }
      if (range) scale(...range);
    }
    let held = null;
    canvas.addEventListener("pointerdown", (event) => { held = [event.clientX, event.clientY]; canvas.setPointerCapture(event.pointerId); });
    canvas.addEventListener("pointerup", () => { held = null; });
    canvas.addEventListener("pointermove", (event) => {
      if (!held) return;
      state.around -= 0.008 * (event.clientX - held[0]);
      state.above = Math.max(-0.5, Math.min(1.5, state.above + 0.008 * (event.clientY - held[1])));
      held = [event.clientX, event.clientY];
    });
    canvas.addEventListener("wheel", (event) => { event.preventDefault(); state.far = Math.max(1.6, Math.min(30, state.far * Math.exp(0.001 * event.deltaY))); }, { passive: false });
    return { draw, state };
  }
  return { make };
})();
