// page.js - the page around engine.js and table.js: an outline that is dragged, and what is measured of it.
//
// One outline is shown at a time (`outline`), as engine.js takes it; every surface keeps its own. Every change goes
// through `change`, which remembers the one before for undo, then `refresh`: measure, draw, write. The eye is
// infinitely far away: `view.rows` are the directions right, up and towards the eye; `view.focus` is the point in the
// middle of the drawing. Laid out by prettier, 120 columns.

const $ = (id) => document.getElementById(id);
const presets = JSON.parse($("presets").textContent);
const DEFAULT_SHAPE = { plane: [1, 1, 1], sphere: [1, 1, 1], ellipsoid: [1.5, 1.2, 0.9], torus: [1, 0.45, 0] };
const MOST_ON_BODY = 128; // corners on ellipsoid and torus, where each edge is a geodesic to be found
const FOLD = ["", "", "elongated", "triangular", "square", "pentagonal", "hexagonal"];
const NOUN = ["", "", "", "a triangle", "a square", "a pentagon", "a hexagon"];

let engine;
let outline = { kind: "sphere", shape: [1, 1, 1], base: 0, corners: [] };
let found = null; // what engine.measure says of it
let rank = 3;
let transport = "corrected"; // drawn on the surface
let selected = -1;
const kept = {}; // the outline last seen on each surface
let view = {
  rows: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  focus: [0, 0, 0],
  scale: 1,
};

// --- vectors ---------------------------------------------------------------------------------------------------------

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const plus = (a, b, t = 1) => [a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]];
const times = (a, t) => [a[0] * t, a[1] * t, a[2] * t];
const norm = (a) => Math.sqrt(dot(a, a));
const unit = (a) => times(a, 1 / norm(a));
const at = (array, i) => [array[3 * i], array[3 * i + 1], array[3 * i + 2]];
const count = () => outline.corners.length / 3;
const cornerAt = (i) => at(outline.corners, (i + count()) % count());

const hasNormals = () => outline.kind === "embedded";
const cornerNormal = (i) => (hasNormals() ? at(outline.normals, (i + count()) % count()) : normalAt(cornerAt(i)));

function meanNormal() {
  let sum = [0, 0, 0];
  for (let i = 0; i < count(); i++) sum = plus(sum, times(cornerNormal(i), 1 / (norm(cornerNormal(i)) || 1)));
  return norm(sum) > 1e-6 * count() ? unit(sum) : [0, 0, 1];
}

// Mean of the corners, and the distance of the farthest from it.
function extentOf() {
  let middle = [0, 0, 0],
    reach = 0;
  for (let i = 0; i < count(); i++) middle = plus(middle, cornerAt(i), 1 / count());
  for (let i = 0; i < count(); i++) reach = Math.max(reach, norm(plus(cornerAt(i), middle, -1)));
  return { middle, reach: reach || 1 };
}

// Outer normal (not unit) of the surface, where that is known.
function normalAt(x) {
  if (outline.kind === "plane") return [0, 0, 1];
  if (outline.kind === "sphere") return x;
  if (outline.kind === "ellipsoid") return [0, 1, 2].map((k) => x[k] / outline.shape[k] ** 2);
  const ratio = outline.shape[0] / Math.hypot(x[0], x[1]);
  return [x[0] * (1 - ratio), x[1] * (1 - ratio), x[2]];
}

function surfacePoint(u, v) {
  // radians: longitude, latitude; on the torus round the axis, round the tube
  const s = outline.shape;
  if (outline.kind === "torus") {
    const across = s[0] + s[1] * Math.cos(v);
    return [across * Math.cos(u), across * Math.sin(u), s[1] * Math.sin(v)];
  }
  const axis = outline.kind === "ellipsoid" ? s : [1, 1, 1];
  return [axis[0] * Math.cos(v) * Math.cos(u), axis[1] * Math.cos(v) * Math.sin(u), axis[2] * Math.sin(v)];
}

const bodySize = () =>
  outline.kind === "torus"
    ? outline.shape[0] + outline.shape[1]
    : outline.kind === "ellipsoid"
      ? Math.max(...outline.shape)
      : outline.kind === "sphere"
        ? 1
        : extentOf().reach;

// --- the eye ---------------------------------------------------------------------------------------------------------

const coarse = matchMedia("(pointer: coarse)"),
  phone = matchMedia("(max-width: 700px)"); // as in page.css
const stage = $("stage"),
  canvas = $("canvas"),
  front = canvas.getContext("2d");
let pen = front; // what is drawn with: the canvas, or a copy of the body
let width = 1,
  height = 1;

function lookFrom(eye) {
  const toEye = unit(eye);
  const side = cross(Math.abs(toEye[2]) < 0.999 ? [0, 0, 1] : [0, 1, 0], toEye);
  const right = unit(side);
  return [right, cross(toEye, right), toEye];
}

function straighten(rows) {
  const eye = unit(rows[2]),
    right = unit(plus(rows[0], eye, -dot(rows[0], eye)));
  return [right, cross(eye, right), eye];
}

function toScreen(x) {
  const d = plus(x, view.focus, -1);
  return [width / 2 + view.scale * dot(d, view.rows[0]), height / 2 - view.scale * dot(d, view.rows[1])];
}

// The direction of a tangent vector on the screen.
const toScreenWay = (v) => [view.scale * dot(v, view.rows[0]), -view.scale * dot(v, view.rows[1])];

// Turns everything by angles about the screen's axes.
function rotate(across, down) {
  let [right, up, eye] = view.rows;
  [right, eye] = [
    plus(times(right, Math.cos(across)), eye, Math.sin(across)),
    plus(times(eye, Math.cos(across)), right, -Math.sin(across)),
  ];
  [up, eye] = [
    plus(times(up, Math.cos(down)), eye, -Math.sin(down)),
    plus(times(eye, Math.cos(down)), up, Math.sin(down)),
  ];
  view.rows = straighten([right, up, eye]);
  moves();
}

function zoom(factor, x = width / 2, y = height / 2) {
  const fit = viewOfAll().scale,
    body = (0.3 * Math.min(width, height)) / bodySize();
  const scale = Math.min(Math.max(200 * body, 20 * fit), Math.max(Math.min(body, fit / 4), view.scale * factor));
  if (outline.kind === "plane") {
    // what is under the pointer stays there
    const share = 1 / view.scale - 1 / scale;
    view.focus = [view.focus[0] + (x - width / 2) * share, view.focus[1] - (y - height / 2) * share, 0];
  }
  view.scale = scale;
  moves();
  draw();
}

// A view that shows the whole outline: with the whole body, unless it is small on it.
function viewOfAll() {
  const room = Math.min(width, height - 40),
    { middle, reach } = extentOf();
  if (outline.kind === "plane")
    return {
      rows: [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ],
      focus: middle,
      scale: (0.36 * room) / reach,
    };
  if (hasNormals()) return { rows: lookFrom(meanNormal()), focus: middle, scale: (0.4 * room) / reach };
  const size = bodySize(),
    on = engine.project(outline, middle) || cornerAt(0);
  const normal = unit(normalAt(on));
  // small on the body, or too small on the screen for fingers
  const small = reach < (outline.kind === "sphere" ? 0.45 : 0.22) * size || (0.46 * room * reach) / size < 56;
  const eye =
    outline.kind === "torus" && !small ? plus(times(normal, 0.8), [0, 0, 1], 0.7) : plus(normal, [0.16, -0.1, 0.16]);
  const rows = lookFrom(eye);
  if (!small) return { rows, focus: [0, 0, 0], scale: (0.46 * room) / size };
  const range = [0, 1].map((k) => {
    // of the outline on the screen
    const all = Array.from({ length: count() }, (_, i) => dot(cornerAt(i), rows[k]));
    return [Math.min(...all), Math.max(...all)];
  });
  const [x, y] = range.map(([a, b]) => (a + b) / 2),
    extent = Math.max(...range.map(([a, b]) => b - a));
  const focus = plus(plus(times(rows[0], x), rows[1], y), rows[2], dot(on, rows[2]));
  return { rows, focus, scale: (0.62 * room) / extent };
}

// Goes to a view, in a third of a second unless motion is not wanted.
let moving = 0;
function goTo(next) {
  cancelAnimationFrame(moving);
  const from = view,
    start = performance.now();
  if (matchMedia("(prefers-reduced-motion: reduce)").matches || document.hidden) {
    view = next;
    draw();
    return;
  }
  const step = (now) => {
    const t = Math.min(1, Math.max(0, (now - start) / 330)),
      s = t * t * (3 - 2 * t);
    const mix = (a, b) => plus(times(a, 1 - s), b, s);
    const eye = mix(from.rows[2], next.rows[2]);
    moves();
    view =
      t === 1 || norm(eye) < 0.05
        ? next
        : {
            rows: straighten([mix(from.rows[0], next.rows[0]), [0, 0, 0], eye]),
            focus: mix(from.focus, next.focus),
            scale: from.scale ** (1 - s) * next.scale ** s,
          };
    draw();
    if (t < 1) moving = requestAnimationFrame(step);
  };
  moving = requestAnimationFrame(step);
}

const torusValue = (x) => (Math.hypot(x[0], x[1]) - outline.shape[0]) ** 2 + x[2] ** 2 - outline.shape[1] ** 2;

// The point of the surface that is seen at a place of the screen; beside the body, the nearest on its rim. Where only
// corners and normals are known, the point of the tangent plane at the corner i.
function under(px, py, i = 0) {
  const right = (px - width / 2) / view.scale + dot(view.focus, view.rows[0]);
  const up = (height / 2 - py) / view.scale + dot(view.focus, view.rows[1]);
  const eye = view.rows[2],
    start = plus(times(view.rows[0], right), view.rows[1], up);
  if (outline.kind === "plane") return [start[0], start[1], 0];
  if (hasNormals()) {
    const n = unit(cornerNormal(i)),
      off = plus(start, cornerAt(i), -1),
      slope = dot(n, eye);
    if (Math.abs(slope) > 0.2) return plus(start, eye, -dot(off, n) / slope);
    const aside = plus(off, eye, -dot(off, eye)); // seen from the side: as far as the pointer goes
    return plus(cornerAt(i), plus(aside, n, -dot(aside, n)));
  }
  if (outline.kind === "torus") {
    const size = bodySize(),
      steps = 240;
    let best = 0,
      least = Infinity,
      z = size,
      step = (2 * size) / steps;
    for (let i = 0; i <= steps; i++, z -= step) {
      const value = torusValue(plus(start, eye, z));
      if (value < least) [least, best] = [value, z];
      if (value > 0) continue;
      for (let low = z, high = z + step, k = 0; k < 50; k++) {
        z = (low + high) / 2;
        if (torusValue(plus(start, eye, z)) > 0) high = z;
        else low = z;
      }
      best = z;
      break;
    }
    return engine.project(outline, plus(start, eye, best));
  }
  const axis = outline.kind === "ellipsoid" ? outline.shape : [1, 1, 1];
  const s = start.map((x, k) => x / axis[k]),
    d = eye.map((x, k) => x / axis[k]);
  const a = dot(d, d),
    b = dot(s, d),
    c = dot(s, s) - 1,
    root = b * b - a * c;
  const hit = plus(s, d, (-b + Math.sqrt(Math.max(0, root))) / a);
  return engine.project(
    outline,
    unit(hit).map((x, k) => x * axis[k]),
  );
}

const isCornerSeen = (i) => isSeen(cornerAt(i), cornerNormal(i));

// Is a point of the surface seen, or is the body before it?
function isSeen(x, normal = normalAt(x)) {
  if (outline.kind === "plane") return true;
  if (dot(normal, view.rows[2]) <= 0) return false;
  if (outline.kind !== "torus") return true;
  const [x0, y0, z0] = plus(x, unit(normal), 0.004),
    [dx, dy, dz] = view.rows[2];
  const [wide, tube] = outline.shape,
    step = 0.15 * tube,
    far = 2 * (wide + tube);
  for (let t = step; t < far; t += step) {
    const across = Math.sqrt((x0 + t * dx) ** 2 + (y0 + t * dy) ** 2) - wide,
      up = z0 + t * dz;
    if (across * across + up * up < tube * tube) return false;
    if (up * dz > 0 && Math.abs(up) > tube) return true; // above it all
  }
  return true;
}

// --- drawing ---------------------------------------------------------------------------------------------------------

let color = {};
function readColors() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["paper", "card", "ink", "soft", "line", "grid", "corrected", "classical", "trouble"])
    color[name] = style.getPropertyValue("--" + name).trim();
  color.dark = matchMedia("(prefers-color-scheme: dark)").matches;
}

const edgeColor = (i) => `hsl(${(215 + (360 * i) / count()) % 360} ${color.dark ? "65% 66%" : "62% 42%"})`;

function polyline(points) {
  pen.beginPath();
  points.forEach((p, i) => (i ? pen.lineTo(p[0], p[1]) : pen.moveTo(p[0], p[1])));
}

function arrow(from, way, style, thick, head = 3.2) {
  const size = Math.hypot(way[0], way[1]);
  if (size < 1) return;
  const [ux, uy] = [way[0] / size, way[1] / size],
    h = Math.min(head * thick, 0.6 * size);
  const tip = [from[0] + way[0], from[1] + way[1]];
  pen.strokeStyle = pen.fillStyle = style;
  pen.lineWidth = thick;
  polyline([from, [tip[0] - ux * h * 0.8, tip[1] - uy * h * 0.8]]);
  pen.stroke();
  polyline([
    tip,
    [tip[0] - ux * h - uy * h * 0.5, tip[1] - uy * h + ux * h * 0.5],
    [tip[0] - ux * h + uy * h * 0.5, tip[1] - uy * h - ux * h * 0.5],
  ]);
  pen.fill();
}

// A line of the surface, where it is seen.
function gridLine(point, from, to, steps) {
  let down = false;
  pen.beginPath();
  for (let i = 0; i <= steps; i++) {
    const x = point(from + ((to - from) * i) / steps);
    const seen = isSeen(x);
    if (seen) {
      const [px, py] = toScreen(x);
      if (down) pen.lineTo(px, py);
      else pen.moveTo(px, py);
    }
    down = seen;
  }
  pen.stroke();
}

// Degrees between lines so that they stand some 40 pixels apart.
function gridSpacing(radius) {
  for (const degrees of [1, 2, 5, 10]) if (((degrees * Math.PI) / 180) * radius * view.scale > 34) return degrees;
  return 15;
}

function drawGrid() {
  const torus = outline.kind === "torus",
    whole = norm(view.focus) < 1e-9;
  const spacing = (gridSpacing(torus ? outline.shape[0] : Math.min(...outline.shape)) * Math.PI) / 180;
  pen.lineWidth = 1;
  pen.strokeStyle = color.dark ? "rgba(255,255,255,0.13)" : "rgba(30,40,60,0.13)";
  if (whole || torus) {
    const u = Math.max(spacing, Math.PI / 18),
      v = torus ? Math.PI / 6 : u,
      top = torus ? Math.PI : Math.PI / 2;
    for (let a = -Math.PI; a < Math.PI - 1e-9; a += torus ? Math.PI / 12 : u)
      gridLine((t) => surfacePoint(a, t), torus ? -top : -top + u, torus ? top : top - u, 60);
    for (let b = torus ? -top : -top + v; b < top - 1e-9; b += v)
      gridLine((t) => surfacePoint(t, b), -Math.PI, Math.PI, 96);
    return;
  }
  // near the focus only: these lines are narrow
  const axis = outline.shape,
    f = view.focus;
  const u = Math.atan2(f[1] / axis[1], f[0] / axis[0]),
    v = Math.asin(Math.max(-1, Math.min(1, f[2] / axis[2])));
  const lines = 14,
    ring = (x) => Math.round(x / spacing) * spacing;
  const stretch = Math.min(8, 1 / Math.max(0.05, Math.cos(v)));
  for (let i = -lines; i <= lines; i++) {
    const a = ring(u) + i * spacing * Math.round(stretch),
      b = ring(v) + i * spacing;
    gridLine(
      (t) => surfacePoint(a, t),
      Math.max(-Math.PI / 2, v - lines * spacing),
      Math.min(Math.PI / 2, v + lines * spacing),
      40,
    );
    if (Math.abs(b) < Math.PI / 2)
      gridLine((t) => surfacePoint(t, b), u - lines * stretch * spacing, u + lines * stretch * spacing, 60);
  }
}

function drawPlane() {
  let spacing = 10 ** Math.floor(Math.log10(60 / view.scale));
  while (spacing * view.scale < 30) spacing *= 2;
  pen.lineWidth = 1;
  pen.strokeStyle = color.grid;
  const [x, y] = view.focus,
    w = width / 2 / view.scale,
    h = height / 2 / view.scale;
  pen.beginPath();
  const from = [Math.ceil((x - w) / spacing), Math.ceil((y - h) / spacing)];
  for (let i = 0; i * spacing <= 2 * w; i++) {
    const [px] = toScreen([(from[0] + i) * spacing, 0, 0]);
    pen.moveTo(px, 0);
    pen.lineTo(px, height);
  }
  for (let i = 0; i * spacing <= 2 * h; i++) {
    const [, py] = toScreen([0, (from[1] + i) * spacing, 0]);
    pen.moveTo(0, py);
    pen.lineTo(width, py);
  }
  pen.stroke();
}

const shade = (light) => {
  // 0 to 1
  const [low, high] = color.dark
    ? [
        [30, 36, 46],
        [84, 94, 110],
      ]
    : [
        [176, 188, 204],
        [247, 249, 251],
      ];
  const t = Math.min(1, Math.max(0, light));
  return `rgb(${low.map((c, k) => Math.round(c + t * (high[k] - c))).join(" ")})`;
};

// A sphere is a disk with a gradient; an ellipsoid is the same disk, stretched as its projection is: the map from the
// unit sphere to the screen has two rows, whose ellipse has the axes of the eigenvectors of their products.
function drawBall() {
  const axis = outline.kind === "ellipsoid" ? outline.shape : [1, 1, 1];
  const a = view.rows[0].map((x, k) => x * axis[k]),
    b = view.rows[1].map((x, k) => x * axis[k]);
  const aa = dot(a, a),
    ab = dot(a, b),
    bb = dot(b, b);
  const mean = (aa + bb) / 2,
    off = Math.hypot((aa - bb) / 2, ab),
    angle = Math.atan2(2 * ab, aa - bb) / 2;
  const [cx, cy] = toScreen([0, 0, 0]);
  const turn = -angle;
  pen.save();
  pen.translate(cx, cy);
  pen.rotate(turn);
  pen.scale(view.scale * Math.sqrt(mean + off), view.scale * Math.sqrt(Math.max(mean - off, 1e-9)));
  const lx = -0.38 * Math.cos(turn) - 0.42 * Math.sin(turn),
    ly = 0.38 * Math.sin(turn) - 0.42 * Math.cos(turn);
  const gradient = pen.createRadialGradient(lx, ly, 0.02, lx * 0.5, ly * 0.5, 1.28);
  for (let t = 0; t <= 1; t += 0.125) gradient.addColorStop(t, shade(1 - 0.92 * t ** 1.7));
  pen.fillStyle = gradient;
  pen.beginPath();
  pen.arc(0, 0, 1, 0, 2 * Math.PI);
  pen.fill();
  pen.restore();
}

// The torus: its facets that face the eye, the far ones first.
function drawTorus() {
  const [N, M] = busy ? [84, 36] : [150, 66],
    light = unit(plus(plus(times(view.rows[0], -0.45), view.rows[1], 0.55), view.rows[2], 0.75));
  const facets = [],
    ring = [];
  for (let i = 0; i <= N; i++)
    for (let j = 0; j <= M; j++) ring.push(surfacePoint((i / N) * 2 * Math.PI, (j / M) * 2 * Math.PI));
  const screen = ring.map(toScreen);
  for (let i = 0; i < N; i++) {
    for (let j = 0; j < M; j++) {
      const u = ((i + 0.5) / N) * 2 * Math.PI,
        v = ((j + 0.5) / M) * 2 * Math.PI;
      const normal = [Math.cos(v) * Math.cos(u), Math.cos(v) * Math.sin(u), Math.sin(v)];
      if (dot(normal, view.rows[2]) < -0.08) continue;
      const k = i * (M + 1) + j;
      facets.push([dot(ring[k], view.rows[2]), k, 0.12 + 0.88 * Math.max(0, dot(normal, light)) ** 0.8]);
    }
  }
  facets.sort((a, b) => a[0] - b[0]);
  pen.lineWidth = 1;
  pen.lineJoin = "round";
  for (const [, k, bright] of facets) {
    pen.fillStyle = pen.strokeStyle = shade(bright);
    polyline([screen[k], screen[k + 1], screen[k + M + 2], screen[k + M + 1]]);
    pen.closePath();
    pen.fill();
    pen.stroke();
  }
}

// While the view moves, the torus has fewer facets.
let busy = false,
  quiet = 0;
function moves() {
  busy = true;
  clearTimeout(quiet);
  quiet = setTimeout(() => {
    busy = false;
    draw();
  }, 200);
}

// The body does not change while a corner is dragged: it is drawn once, on a canvas of its own.
const body = document.createElement("canvas");
let bodyIs = "";
function drawBody() {
  const now = JSON.stringify([outline.kind, outline.shape, view, width, height, color.dark, devicePixelRatio, busy]);
  if (now !== bodyIs) {
    bodyIs = now;
    body.width = canvas.width;
    body.height = canvas.height;
    penTo(body.getContext("2d"));
    if (outline.kind === "plane") drawPlane();
    else if (!hasNormals()) {
      if (outline.kind === "torus") drawTorus();
      else drawBall();
      drawGrid();
    }
    penTo(front);
  }
  pen.drawImage(body, 0, 0, width, height);
}

function penTo(next) {
  pen = next;
  next.setTransform(canvas.width / width, 0, 0, canvas.height / height, 0, 0);
}

function drawOutline() {
  const n = found.edgeOf.length;
  const screen = [],
    seen = [];
  for (let i = 0; i < n; i++) {
    const x = at(found.point, i);
    screen.push(toScreen(x));
    seen.push(isSeen(x, at(found.normal, i)));
  }
  if (found.ok && (outline.kind !== "torus" || seen.every(Boolean))) {
    // inside; what lies behind the rim, to the rim
    const [cx, cy] = toScreen([0, 0, 0]);
    const rim = screen.map((p, i) => {
      if (seen[i] || outline.kind !== "sphere") return p;
      const r = Math.hypot(p[0] - cx, p[1] - cy) || 1;
      return [cx + ((p[0] - cx) * view.scale) / r, cy + ((p[1] - cy) * view.scale) / r];
    });
    if (outline.kind === "sphere" || seen.every(Boolean)) {
      polyline(rim);
      pen.closePath();
      pen.globalAlpha = color.dark ? 0.2 : 0.14;
      pen.fillStyle = color.corrected;
      pen.fill();
      pen.globalAlpha = 1;
    }
  }
  pen.lineCap = "round";
  pen.lineJoin = "round";
  for (const front of [false, true]) {
    for (let i = 0; i < n; i++) {
      const j = (i + 1) % n,
        e = found.edgeOf[i];
      if ((seen[i] && seen[j]) !== front) continue;
      const first = i === 0 || found.edgeOf[i - 1] !== e || (seen[i - 1] && seen[i]) !== front;
      if (first) {
        pen.beginPath();
        pen.moveTo(...screen[i]);
      }
      pen.lineTo(...screen[j]);
      const next = (j + 1) % n;
      if (j === 0 || found.edgeOf[j] !== e || (seen[j] && seen[next]) !== front) {
        const bad = !found.ok && (e === found.bad || e === found.other);
        pen.setLineDash(front ? [] : [2, 6]);
        pen.lineWidth = front ? (bad ? 5 : 3) : 1.5;
        pen.globalAlpha = front ? 1 : 0.55;
        pen.strokeStyle = bad ? color.trouble : found.ok ? edgeColor(e) : color.soft;
        pen.stroke();
      }
    }
  }
  pen.setLineDash([]);
  pen.globalAlpha = 1;
}

// Co-normals on the edges; all of them, carried to the base; the p directions in the middle.
function drawArrows() {
  const n = count(),
    many = n > 24,
    every = Math.ceil(n / 64), // co-normals that can be told apart
    size = Math.min(width, height);
  const place = toScreen(at(found.base, 0));
  for (let e = 0; e < n; e++) {
    const foot = [0, 3, 6].map((k) => Array.from(found.foot.subarray(9 * e + k, 9 * e + k + 3)));
    if (e % every) continue;
    if (!isSeen((!hasNormals() && engine.project(outline, foot[0])) || foot[0], foot[2])) continue;
    const way = toScreenWay(times(foot[1], ((many ? 0.03 : 0.07) * size) / view.scale));
    arrow(toScreen(foot[0]), way, edgeColor(e), many ? 1.5 : 2.5);
  }
  if (isSeen(at(found.base, 0), at(found.base, 3))) {
    const arrows = transport === "corrected" ? found.arrow : found.arrowClassical;
    const m = transport === "corrected" ? n : n + 1;
    let longest = 0;
    for (let e = 0; e < m; e++) longest = Math.max(longest, Math.hypot(arrows[2 * e], arrows[2 * e + 1]));
    pen.fillStyle = color.card;
    pen.strokeStyle = transport === "corrected" ? color.corrected : color.classical;
    for (let e = 0; e < m; e++) {
      const t = ((many ? 0.1 : 0.15) * size) / view.scale / longest;
      const way = toScreenWay(
        plus(times(at(found.base, 1), t * arrows[2 * e]), at(found.base, 2), t * arrows[2 * e + 1]),
      );
      arrow(place, way, edgeColor(e === n ? outline.base : e), many ? 1.2 : 2, 4);
    }
    pen.beginPath();
    pen.arc(place[0], place[1], 6, 0, 2 * Math.PI);
    pen.fillStyle = color.card;
    pen.strokeStyle = transport === "corrected" ? color.corrected : color.classical;
    pen.lineWidth = 2.5;
    pen.fill();
    pen.stroke();
  }
  const centre = at(found.centre, 0),
    normal = at(found.centre, 1),
    e1 = at(found.director, rank);
  if (norm(e1) < 0.5 || !isSeen(centre, normal) || found.mu[rank] < 1e-9) return;
  let reach = Infinity;
  for (let i = 0; i < found.edgeOf.length; i++) reach = Math.min(reach, norm(plus(at(found.point, i), centre, -1)));
  const e2 = cross(normal, e1),
    middle = toScreen(centre);
  reach = Math.max(reach * 0.8, (0.05 * size) / view.scale) * Math.sqrt(Math.min(1, found.mu[rank]));
  pen.lineCap = "round";
  for (const [thick, style] of [
    [8, color.card],
    [4, color.corrected],
  ]) {
    pen.lineWidth = thick;
    pen.strokeStyle = style;
    for (let k = 0; k < rank; k++) {
      const angle = (2 * Math.PI * k) / rank;
      const way = toScreenWay(plus(times(e1, reach * Math.cos(angle)), e2, reach * Math.sin(angle)));
      polyline([middle, [middle[0] + way[0], middle[1] + way[1]]]);
      pen.stroke();
    }
  }
}

// Which corners have handles: all of a few; of many only those that stand apart on the screen, the selected one and the
// one to blame.
const MANY = 12;
let handled = [];
function chooseHandles() {
  const n = count(),
    apart = coarse.matches ? 30 : 22,
    kept = [];
  handled = Array.from({ length: n }, (_, i) => {
    if (n <= MANY || i === selected) return true;
    if (!found.ok && found.other < 0 && found.bad === i) return true;
    const [x, y] = toScreen(cornerAt(i)),
      seen = isCornerSeen(i);
    if (kept.some((k) => k.seen === seen && Math.hypot(k.x - x, k.y - y) < apart)) return false;
    kept.push({ x, y, seen });
    return true;
  });
}

function drawHandles() {
  const box = $("corners"),
    n = count();
  chooseHandles();
  while (box.children.length > n) box.lastChild.remove();
  while (box.children.length < n) {
    const button = document.createElement("button");
    const i = box.children.length;
    button.type = "button";
    button.addEventListener("focus", () => select(i, false));
    button.addEventListener("click", () => select(i, false));
    box.append(button);
  }
  for (let i = 0; i < n; i++) {
    const button = box.children[i];
    button.hidden = !handled[i];
    if (!handled[i]) continue;
    const [px, py] = toScreen(cornerAt(i)),
      seen = isCornerSeen(i);
    button.style.transform = `translate(${px.toFixed(1)}px, ${py.toFixed(1)}px)`;
    button.className =
      (n > 24 ? "many " : "") +
      (seen ? "" : "behind ") +
      (!found.ok && found.other < 0 && found.bad === i ? "bad" : "");
    button.textContent = i + 1;
    button.setAttribute("aria-label", `Corner ${i + 1} of ${n}${seen ? "" : ", behind"}`);
  }
}

function draw() {
  if (!found) return;
  penTo(front);
  pen.clearRect(0, 0, width, height);
  drawBody();
  drawOutline();
  if (found.ok) drawArrows();
  drawHandles();
}

// --- numbers and words -----------------------------------------------------------------------------------------------

const three = (x) => x.toFixed(3);
const degrees = (x) => ((x * 180) / Math.PI).toFixed(1) + "\u00b0";

// What the outline is called. A polygon of n corners is no polygon of more. By classical transport it may be: arrows that
// turn by S in all, instead of 2 pi, look like those of n 2 pi / S corners. Above rank 6, values below HALF are the noise
// of many short edges. Of equals the first counts, for what is 3-fold is 6-fold, too.
const ROUND = 0.15,
  SLIGHT = 0.35,
  HALF = 0.5,
  ALMOST = 0.7,
  CLEAR = 0.9;
const cornersSeen = (turning) => Math.ceil((count() * 2 * Math.PI) / turning - 1e-9);

function mostOf(mu, corners = count()) {
  let best = 2;
  for (let p = 3; p <= Math.min(Math.max(corners, 6), RANK); p++)
    if (mu[p] > mu[best] + 0.005 && (p <= 6 || mu[p] > HALF)) best = p;
  return best;
}

const value = (mu, p) => `<i>mu<sub>${p}</sub> = ${mu[p].toFixed(2)}</i>`;

// The rank that decides, the words for it, and whether the outline is elongated besides.
function verdictOf(mu, corners) {
  const p = mostOf(mu, corners),
    long = p > 2 && mu[p] >= ROUND && mu[2] >= ROUND;
  const fold = FOLD[p] || `${p}-fold`,
    noun = p === 4 && long ? "a rectangle" : NOUN[p] || `a${p === 8 || p === 11 ? "n" : ""} ${p}-gon`;
  let said = noun;
  if (mu[p] < ROUND) said = "nearly round";
  else if (mu[p] < SLIGHT) said = "slightly " + fold;
  else if (p === 2) said = mu[p] < ALMOST ? "elongated" : "very elongated";
  else if (mu[p] < ALMOST) said = "somewhat " + fold;
  else if (mu[p] < CLEAR) said = "almost " + noun;
  return { p, said, long };
}

function writeBars() {
  const box = $("bars");
  if (!box.children.length) {
    box.innerHTML = [1, 0.5, 0]
      .map((y) => `<div class="scale" style="top:calc(10px + var(--high) * ${1 - y})"><span>${y}</span></div>`)
      .join("");
    for (let p = 1; p <= RANK; p++) {
      const button = document.createElement("button");
      button.type = "button";
      button.setAttribute("role", "radio");
      button.innerHTML =
        '<span class="columns"><i class="corrected"></i><i class="classical"></i></span>' +
        `<span class="rank">${p}</span>`;
      button.addEventListener("click", () => setRank(p));
      box.append(button);
    }
    box.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (!step) return;
      event.preventDefault();
      setRank(((rank - 1 + step + RANK) % RANK) + 1);
      box.querySelectorAll("button")[rank - 1].focus();
    });
  }
  box.classList.toggle("none", !found.ok);
  box.querySelectorAll("button").forEach((button, i) => {
    const p = i + 1,
      bars = button.querySelectorAll("i");
    bars[0].style.height = 100 * found.mu[p] + "%";
    bars[1].style.height = 100 * found.classical[p] + "%";
    button.setAttribute("aria-checked", p === rank);
    button.tabIndex = p === rank ? 0 : -1;
    button.setAttribute(
      "aria-label",
      found.ok
        ? `mu ${p}: corrected ${three(found.mu[p])}, classical ${three(found.classical[p])}`
        : `mu ${p}: not measured`,
    );
  });
  $("readout").innerHTML = !found.ok
    ? ""
    : `mu<sub>${rank}</sub> (${FOLD[rank] || rank + "-fold"}): <b>${three(found.mu[rank])}</b> corrected, ` +
      `<b>${three(found.classical[rank])}</b> classical`;
}

// A dial: angle 0, the co-normal of the base, is up; angles grow counter-clockwise.
function dial(arrows, m, theta, mu, gap) {
  const place = (angle, r) => [-r * Math.sin(angle), -r * Math.cos(angle)].map((x) => x.toFixed(2));
  const parts = [`<circle r="82" fill="none" stroke="var(--line)"/>`];
  let longest = 0;
  for (let e = 0; e < m; e++) longest = Math.max(longest, Math.hypot(arrows[2 * e], arrows[2 * e + 1]));
  if (Math.abs(gap) > 0.03) {
    // from where the base's arrow set out to where it comes back
    const [x1, y1] = place(0, 30),
      [x2, y2] = place(gap, 30);
    parts.push(
      `<path d="M${x1} ${y1}A30 30 0 ${Math.abs(gap) > Math.PI ? 1 : 0} ${gap > 0 ? 0 : 1} ${x2} ${y2}" fill="none" ` +
        'stroke="var(--classical)" stroke-width="2" stroke-dasharray="3 3"/>',
    );
  }
  const thin = count() > 24,
    lines = new Map(); // of very many arrows one path a colour, without heads: a drag shall not wait for the dials
  for (let e = 0; e < m; e++) {
    const size = Math.hypot(arrows[2 * e], arrows[2 * e + 1]),
      angle = Math.atan2(arrows[2 * e + 1], arrows[2 * e]);
    if (size < 1e-12 * longest) continue;
    const r = (72 * size) / longest,
      edge = e === count() ? outline.base : e,
      style = edgeColor(edge);
    if (count() > 128) {
      const shared = edgeColor(edge - (edge % Math.ceil(count() / 64)));
      lines.set(shared, `${lines.get(shared) || ""}M0 0L${place(angle, r).join(" ")}`);
      continue;
    }
    const h = Math.min(11, 0.6 * r),
      [bx, by] = place(angle, r - 0.8 * h),
      turn = (-angle * 180) / Math.PI;
    parts.push(
      `<path d="M0 0L${bx} ${by}" stroke="${style}" stroke-width="${thin ? 1.6 : 3.2}"/>`,
      `<path d="M0 ${-r}l${-0.42 * h} ${h}h${0.84 * h}z" fill="${style}" transform="rotate(${turn.toFixed(2)})"/>`,
    );
    const again = e === count() && Math.abs(gap) < 0.5; // beside its first half, the same number
    if (count() <= 12 && !again) {
      const [tx, ty] = place(angle + 14 / Math.max(20, r - 9), Math.max(22, r - 9));
      parts.push(
        `<text x="${tx}" y="${ty}" fill="${style}" font-size="13" font-weight="600" text-anchor="middle" ` +
          `dominant-baseline="central">${edge + 1}</text>`,
      );
    }
  }
  for (const [style, path] of lines) parts.push(`<path d="${path}" stroke="${style}" stroke-width="1.2"/>`);
  if (mu > 1e-9)
    for (let k = 0; k < rank; k++)
      parts.push(
        `<path d="M0 -84l-5 -11h10z" fill="currentColor" fill-opacity="${(0.25 + 0.75 * mu).toFixed(2)}" ` +
          `transform="rotate(${((-(theta + (2 * Math.PI * k) / rank) * 180) / Math.PI).toFixed(2)})"/>`,
      );
  return `<svg viewBox="-98 -98 196 196" aria-hidden="true">${parts.join("")}</svg>`;
}

function writeDials() {
  const n = count(),
    blank =
      '<svg viewBox="-98 -98 196 196" aria-hidden="true">' +
      '<circle r="82" fill="none" stroke="var(--line)" stroke-dasharray="4 6"/></svg>';
  $("base").textContent = outline.base + 1;
  for (const name of ["corrected", "classical"]) {
    $("dial-" + name).innerHTML = !found.ok
      ? blank
      : name === "corrected"
        ? dial(found.arrow, n, found.theta[rank], found.mu[rank], 0)
        : dial(
            found.arrowClassical,
            n + 1,
            found.thetaClassical[rank],
            found.classical[rank],
            found.turning - 2 * Math.PI,
          );
    $("under-" + name).innerHTML = !found.ok
      ? ""
      : `mu<sub>${rank}</sub> = ${three(name === "corrected" ? found.mu[rank] : found.classical[rank])}<br>` +
        (name === "corrected"
          ? "closes after one round"
          : Math.abs(found.curvature) < 1e-9
            ? "closes, too"
            : `off by ${degrees(found.curvature)} after one round`);
  }
}

function writeVerdict() {
  if (!found.ok) {
    $("verdict").textContent = "Not measured: " + found.sentence + ".";
    return;
  }
  const [one, other] = [verdictOf(found.mu), verdictOf(found.classical, cornersSeen(found.turning))];
  const same = one.said === other.said && Math.abs(found.mu[one.p] - found.classical[other.p]) < 0.01;
  $("verdict").innerHTML =
    `<span><em>This outline is </em><b class="corrected">${one.said}</b> (${value(found.mu, one.p)})` +
    (one.long ? `<em>, elongated (${value(found.mu, 2)})</em>` : "") +
    ".</span> <span>Classical<em> transport says</em>: " +
    (same ? "the same" : `<b class="classical">${other.said}</b> (${value(found.classical, other.p)})`) +
    ".</span>";
}

// What a refusal means here, in more words.
function hintFor(name) {
  const half = outline.kind === "plane" ? "" : " Or the outline encloses half of the body or more.";
  return (
    {
      clockwise: "Press Reverse." + half,
      crosses_itself: "The edges that cross are marked.",
      too_few_corners: "Add some, with the button below.",
      too_much_curvature: "At half a sphere, for example, an outline turns neither way.",
      coincident_corners: "Drag one of the two away.",
      too_long: "Remove some corners.",
      antipodal_corners: "Drag one of the two, or add a corner between them.",
      callback_failed: "No shortest line was found between two corners. Add a corner between them.",
      winds: "Drag an edge back over the hole or the tube.",
    }[name] || ""
  );
}

function writeTable() {
  const rows = [
    ["", "corrected", "classical", "direction", "direction, classical"].map((t) => `<th>${t}</th>`).join(""),
  ];
  const cell = (id, x, digits = 12) => `<td id="${id}" data-value="${x}">${x.toFixed(digits)}</td>`;
  if (found.ok) {
    for (let p = 1; p <= RANK; p++)
      rows.push(
        `<th>mu<sub>${p}</sub></th>` +
          cell("mu-" + p, found.mu[p]) +
          cell("classical-" + p, found.classical[p]) +
          `<td>${degrees(found.theta[p])}</td><td>${degrees(found.thetaClassical[p])}</td>`,
      );
    for (const [id, name, x] of [
      ["length", "length L", found.length],
      ["turning", "total turning S", found.turning],
      ["curvature", "enclosed curvature 2 &pi; &minus; S", found.curvature],
      ["condition", "condition number", found.condition],
    ])
      rows.push(`<th>${name}</th>` + cell(id, x));
    if (outline.kind === "plane" || outline.kind === "sphere") rows.push("<th>area</th>" + cell("area", found.area));
  } else {
    rows[0] = `<td>${found.sentence}</td>`;
  }
  $("table").innerHTML = rows.map((row) => `<tr>${row}</tr>`).join("");
}

function writeText() {
  $("command").textContent = commandOf(outline) + " outline.tsv";
  $("tsv").value = found.ok ? tableOf(outline, found) : "# " + found.sentence + "\n";
  $("link").value = here() + "#" + shapeText();
  // The address follows, from the first change on. Browsers that count such calls may refuse one: it is then late.
  if (!past.length && !future.length) return;
  try {
    history.replaceState(null, "", "#" + shapeText());
  } catch {}
}

// --- an outline as the fragment of an address --------------------------------------------------------------------------
// kind/edge/corner/corner/..., numbers with commas between them; ellipsoid and torus have their shape before the edge.
// The edge is the one that arrows are carried to, from 1. Nothing but such numbers is taken from an address.

const WIDTH = { plane: 2, sphere: 3, ellipsoid: 3, torus: 3, embedded: 6 };
const SIZES = { ellipsoid: 3, torus: 2 };
const A_NUMBER = /^-?\d{1,10}(\.\d{1,25})?(e-\d{1,3})?$/;
const LONGEST_FRAGMENT = 160000;

const here = () => document.URL.split("#")[0];
const mostCorners = (kind) => (SIZES[kind] ? MOST_ON_BODY : engine.most);

function shapeText() {
  const parts = [outline.kind];
  if (SIZES[outline.kind]) parts.push(outline.shape.slice(0, SIZES[outline.kind]).join());
  parts.push(outline.base + 1);
  for (let i = 0; i < count(); i++) {
    const x = cornerAt(i).concat(hasNormals() ? at(outline.normals, i) : []);
    parts.push(x.slice(0, WIDTH[outline.kind]).join());
  }
  return parts.join("/");
}

// Returns the outline, or a sentence that says what is wrong. No part of the text comes back in it.
function readShape(text) {
  if (text.length > LONGEST_FRAGMENT) return "The link is too long.";
  try {
    text = decodeURIComponent(text); // mail programs write %2C for a comma
  } catch {
    return "The link has a % that stands for nothing.";
  }
  const parts = text.split("/"),
    kind = parts.shift();
  if (!KINDS.includes(kind)) return "The link does not begin with a surface that this page knows.";
  const list = (part) => {
    const fields = (part || "").split(",");
    return fields.every((field) => A_NUMBER.test(field)) ? fields.map(Number) : [];
  };
  const shape = SIZES[kind] ? list(parts.shift()) : [1, 1, 1];
  if (kind === "torus") shape.push(0);
  const isSize = (x) => x >= 0.05 && x <= 20;
  if (
    shape.length !== 3 ||
    (kind === "torus" ? !(shape[0] > shape[1] && shape.slice(0, 2).every(isSize)) : !shape.every(isSize))
  )
    return "The shape of the surface in the link is out of range.";
  const base = /^\d{1,4}$/.test(parts[0]) ? Number(parts.shift()) - 1 : -1;
  if (parts.length < 3 || parts.length > mostCorners(kind))
    return `The link has not 3 to ${mostCorners(kind)} corners.`;
  if (!(base >= 0 && base < parts.length)) return "The link does not say the number of an edge.";
  const next = { kind, shape, base, corners: [] },
    most = SIZES[kind] || kind === "sphere" ? 1000 : 1e9;
  if (kind === "embedded") next.normals = [];
  for (const part of parts) {
    const x = list(part);
    if (x.length !== WIDTH[kind] || !x.every((c) => Math.abs(c) <= most))
      return `A corner in the link is not ${WIDTH[kind]} numbers from -${most} to ${most}.`;
    if (kind === "plane") x.push(0);
    const on = engine.project(next, x.slice(0, 3));
    if (!on) return "A corner in the link does not lie on the surface.";
    // its own digits, if it lies there already
    next.corners.push(...(norm(plus(on, x, -1)) < 1e-12 * (1 + norm(on)) ? x.slice(0, 3) : on));
    if (next.normals) next.normals.push(...x.slice(3));
  }
  return next;
}

function showShape(text) {
  const next = readShape(text);
  if (typeof next === "string") return next;
  show(next);
  return "";
}

const fragment = () => document.URL.split("#").slice(1).join("#");

// An address that names a place of the page is none of an outline.
function readAddress() {
  const text = fragment();
  if (text === "" || text === "numbers") return;
  const wrong = showShape(text);
  if (wrong) notify(wrong + " The outline here is another one.");
}

function notify(text) {
  $("notice").textContent = text;
  $("notice").hidden = !text;
}

// --- an outline from a table ---------------------------------------------------------------------------------------------

let loaded = []; // outlines of the last table

function showLoaded(i, remarks = []) {
  const { id, kind, corners, normals, fault } = loaded[i];
  if (fault) throw fault;
  const name = loaded.length > 1 ? `outline ${quote(id)}` : "the outline",
    n = corners.length / 3;
  if (n > mostCorners(kind))
    throw new TableError(
      `${name} has ${n} corners; this page takes up to ${mostCorners(kind)}, the command any number`,
    );
  const next = { kind, shape: [1, 1, 1], base: 0, corners, normals };
  if (kind === "sphere")
    next.corners = Array.from({ length: n }, (_, k) => engine.project(next, at(corners, k)) || [0, 0, 0]).flat();
  show(next);
  notify(remarks.join(" "));
}

// The attribute autofocus would have its say when the page is loaded, too.
function openDialog(dialog, focused) {
  $(dialog).showModal();
  $(focused).focus({ preventScroll: true });
}

// Loads a table or a link; opens the window with what is wrong, if anything is.
function load(text) {
  $("load-said").hidden = true;
  const line = text.length < LONGEST_FRAGMENT + 4096 ? text.trim() : "",
    link = /\s/.test(line) ? null : /(?:plane|sphere|ellipsoid|torus|embedded)\/.*$/.exec(line);
  let example = EXAMPLES.plane,
    wrong = "";
  try {
    if (link) wrong = showShape(link[0]);
    else {
      const table = readTable(text, $("load-surface").value);
      loaded = table.outlines;
      $("which").replaceChildren(...loaded.slice(0, 5000).map(({ id }, i) => new Option(id.slice(0, 40), i)));
      $("which").hidden = loaded.length < 2;
      const first = Math.max(
        0,
        loaded.findIndex(({ fault }) => !fault),
      );
      $("which").value = first;
      showLoaded(first, loaded.length > 1 ? [`${loaded.length} outlines were read.`, ...table.remarks] : []);
    }
  } catch (error) {
    if (!(error instanceof TableError)) throw error;
    [wrong, example] = [error.message, error.example];
  }
  if (!wrong) {
    $("load").close();
    return;
  }
  $("load-why").textContent = wrong;
  $("load-right").textContent = example;
  $("load-said").hidden = false;
  $("load-text").value = text.length > 100000 ? "" : text; // a field with megabytes is slow
  if (!$("load").open) openDialog("load", "load-text");
  $("load").scrollTop = 0;
}

let later = 0;
function refresh() {
  found = engine.measure(outline);
  kept[outline.kind] = outline;
  $("own").hidden = !kept.embedded;
  document.querySelector(`input[name="kind"][value="${outline.kind}"]`).checked = true;
  $("trouble").hidden = found.ok;
  if (!found.ok && $("trouble-text").textContent !== capital(found.sentence) + ".") {
    $("trouble-text").textContent = capital(found.sentence) + ".";
  }
  $("trouble-hint").textContent = found.ok ? "" : hintFor(found.name);
  if (found.ok) $("trouble-text").textContent = "";
  writeBars();
  writeDials();
  writeVerdict();
  writeBend();
  $("remove").disabled = count() <= 3;
  $("add").disabled = count() >= mostCorners(outline.kind);
  $("undo").disabled = !past.length;
  $("redo").disabled = !future.length;
  draw();
  clearTimeout(later); // tables and what is read aloud: when the hand rests
  later = setTimeout(rest, 120);
}

function rest() {
  clearTimeout(later);
  $("aloud").textContent = found.ok ? $("verdict").textContent : "";
  writeTable();
  writeText();
}

const capital = (s) => s[0].toUpperCase() + s.slice(1);

function setRank(p) {
  rank = p;
  writeBars();
  writeDials();
  draw();
}

// --- changes ---------------------------------------------------------------------------------------------------------

const past = [],
  future = [];
let gesture = null; // changes of one gesture are undone together

function change(next, name = null) {
  if (name === null || name !== gesture) {
    past.push(outline);
    if (past.length > 200) past.shift();
    future.length = 0;
  }
  gesture = name;
  outline = next;
  notify("");
  if (selected >= count()) selected = -1;
  refresh();
}

// Does any corner stand on the stage?
function isInView() {
  for (let i = 0; i < count(); i++) {
    const [x, y] = toScreen(cornerAt(i));
    if (x > 0 && y > 0 && x < width && y < height) return true;
  }
  return false;
}

function timeTravel(from, to) {
  if (!from.length) return;
  const kind = outline.kind;
  to.push(outline);
  outline = from.pop();
  gesture = null;
  refresh();
  if (outline.kind !== kind || !isInView()) goTo(viewOfAll());
}

function moveCorner(i, x, name) {
  if (!x) return;
  const corners = outline.corners.slice();
  for (let k = 0; k < 3; k++) corners[3 * i + k] = x[k];
  change({ ...outline, corners }, name);
}

function addCorner(edge, x) {
  if (!x || count() >= mostCorners(outline.kind)) return;
  const corners = outline.corners.slice(),
    normals = hasNormals() ? outline.normals.slice() : undefined;
  corners.splice(3 * edge + 3, 0, ...x);
  if (normals) normals.splice(3 * edge + 3, 0, ...plus(unit(cornerNormal(edge)), unit(cornerNormal(edge + 1))));
  change({ ...outline, corners, normals, base: outline.base > edge ? outline.base + 1 : outline.base });
  select(edge + 1);
}

function removeCorner(i) {
  if (i < 0 || count() <= 3) return;
  const corners = outline.corners.slice(),
    normals = hasNormals() ? outline.normals.slice() : undefined;
  corners.splice(3 * i, 3);
  if (normals) normals.splice(3 * i, 3);
  const n = corners.length / 3;
  change({
    ...outline,
    corners,
    normals,
    base: (outline.base >= i && outline.base > 0 ? outline.base - 1 : outline.base) % n,
  });
  select(Math.min(i, n - 1));
}

// Without a place of its own, a new corner goes to the middle of the edge behind the selected one.
function addInTheMiddle() {
  const edge = selected >= 0 ? selected : longestEdge();
  const points = [];
  for (let i = 0; i < found.edgeOf.length; i++) if (found.edgeOf[i] === edge) points.push(i);
  let x = plus(times(cornerAt(edge), 0.5), cornerAt(edge + 1), 0.5);
  if (edge !== outline.base && points.length > 1) x = at(found.point, points[points.length >> 1]);
  if (edge === outline.base && points.length > 1) x = at(found.point, 0);
  addCorner(edge, engine.project(outline, x));
}

function longestEdge(corners = outline.corners) {
  let best = 0,
    most = 0;
  const n = corners.length / 3;
  for (let e = 0; e < n; e++) {
    const size = norm(plus(at(corners, (e + 1) % n), at(corners, e), -1));
    if (size > most) [most, best] = [size, e];
  }
  return best;
}

function reversed(old) {
  const n = old.corners.length / 3,
    back = (array) => Array.from({ length: n }, (_, i) => at(array, n - 1 - i)).flat();
  const normals = old.normals && back(old.normals);
  return { ...old, corners: back(old.corners), normals, base: (2 * n - 2 - old.base) % n };
}

function select(i, focus = true) {
  const before = selected;
  selected = i;
  const button = $("corners").children[i];
  if (!button) return;
  if (count() > MANY && before !== i) drawHandles();
  if (focus) button.focus({ preventScroll: true });
  else if (!pointers.size && !isCornerSeen(i))
    // reached by key, behind: bring it to the front
    goTo({ ...view, rows: lookFrom(plus(unit(cornerNormal(i)), [0, 0, outline.kind === "torus" ? 0.9 : 0.1])) });
}

// --- outlines to begin with ------------------------------------------------------------------------------------------

function show(next, p = 0) {
  selected = -1;
  change(next);
  if (p || found.ok) setRank(p || mostOf(found.mu));
  goTo(viewOfAll());
  // on a phone the result stands above the drawing: both shall be seen
  const top = $("numbers").getBoundingClientRect().top,
    bottom = stage.getBoundingClientRect().bottom;
  if (phone.matches && (top < 0 || bottom > innerHeight)) $("numbers").scrollIntoView({ block: "start" });
}

const fromDegrees = (list) => {
  const corners = [];
  for (let i = 0; i < list.length; i += 2) corners.push(...fromLonLat(list[i], list[i + 1]));
  return corners;
};
const fromLongest = (next) => ({ ...next, base: longestEdge(next.corners) });
const onSphere = (corners) => ({ kind: "sphere", shape: DEFAULT_SHAPE.sphere, base: 0, corners });

function regular(kind, n, shape = DEFAULT_SHAPE[kind]) {
  const next = { kind, shape, base: 0, corners: [] };
  const centre = engine.project(
    next,
    { plane: [0, 0, 0], sphere: fromLonLat(30, 35), ellipsoid: [0.8, -0.5, 0.6], torus: [1.1, -0.5, 0.4] }[kind],
  );
  next.corners = engine.regular(next, centre, n, kind === "torus" ? 0.42 : 0.62, 0.4);
  return next;
}

const PRESETS = {
  octant: () => show(onSphere([1, 0, 0, 0, 1, 0, 0, 0, 1]), 3),
  regular: () =>
    show(regular(hasNormals() ? "sphere" : outline.kind, Number($("sides").value)), Number($("sides").value)),
  h3: () => show(onSphere(fromDegrees(presets.h3)), 5),
  cell: () => {
    // micrometres; the half-axes of its ellipsoid are 110, 50 and 40
    const next = { kind: "ellipsoid", shape: [2.2, 1, 0.8], base: 0, corners: [] };
    for (let i = 0; i < presets.cell.length; i += 3)
      next.corners.push(
        ...engine.project(
          next,
          presets.cell.slice(i, i + 3).map((x) => x / 50),
        ),
      );
    show(next, 6);
  },
};

// An uneven pentagon to begin with, on surfaces not seen yet.
function firstOn(kind) {
  const next = regular(kind, 5);
  const centre = at(next.corners, 0),
    pull = [0.25, -0.18, 0.1, 0, -0.3];
  for (let i = 0; i < 5; i++) {
    const x = plus(at(next.corners, i), centre, pull[i] * 0.5);
    const on = engine.project(next, plus(x, at(next.corners, (i + 2) % 5), 0.06));
    for (let k = 0; k < 3; k++) next.corners[3 * i + k] = on[k];
  }
  return next;
}

// The third axis of the ellipsoid, or the tube of the torus.
const BEND = { ellipsoid: ["Height", 2, 0.4, 2], torus: ["Tube", 1, 0.15, 0.8] };
function writeBend() {
  const bend = BEND[outline.kind];
  $("bend").hidden = !bend;
  if (!bend) return;
  $("bend-name").textContent = bend[0];
  $("bend-value").min = bend[2];
  $("bend-value").max = bend[3];
  $("bend-value").value = outline.shape[bend[1]];
}

function setBend(value) {
  const old = outline.shape,
    shape = old.slice(),
    [, k] = BEND[outline.kind];
  shape[k] = value;
  const next = { ...outline, shape, corners: [] };
  for (let i = 0; i < count(); i++) {
    let x = cornerAt(i);
    if (outline.kind === "ellipsoid") x[2] *= shape[2] / old[2];
    else {
      const across = Math.hypot(x[0], x[1]),
        wide = old[0] + ((across - old[0]) * shape[1]) / old[1];
      x = [(x[0] / across) * wide, (x[1] / across) * wide, (x[2] * shape[1]) / old[1]];
    }
    next.corners.push(...engine.project(next, x));
  }
  change(next, "bend");
}

// --- hands -----------------------------------------------------------------------------------------------------------

const pointers = new Map();
let drag = null; // { corner } or { turn } or { pinch }
let hold = 0,
  lastTap = { time: 0, x: 0, y: 0 };

const placeOf = (event) => {
  const box = stage.getBoundingClientRect();
  return [event.clientX - box.left - stage.clientLeft, event.clientY - box.top - stage.clientTop];
};

function cornerNear([x, y], reach) {
  let best = -1,
    least = reach;
  for (const seen of [true, false]) {
    // those in front first
    for (let i = 0; i < count(); i++) {
      if (!handled[i] || isCornerSeen(i) !== seen) continue;
      const [px, py] = toScreen(cornerAt(i)),
        d = Math.hypot(px - x, py - y);
      if (d < least) [least, best] = [d, i];
    }
    if (best >= 0) return best;
    least = reach / 2;
  }
  return best;
}

function edgeNear([x, y], reach) {
  let best = -1,
    least = reach;
  const n = found.edgeOf.length;
  for (let i = 0; i < n; i++) {
    if (!isSeen(at(found.point, i), at(found.normal, i))) continue;
    const [ax, ay] = toScreen(at(found.point, i)),
      [bx, by] = toScreen(at(found.point, (i + 1) % n));
    const dx = bx - ax,
      dy = by - ay,
      t = Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
    const d = Math.hypot(ax + t * dx - x, ay + t * dy - y);
    if (d < least) [least, best] = [d, found.edgeOf[i]];
  }
  return best;
}

const reachOf = (event) => (event.pointerType === "mouse" ? 14 : 26);

// Double click, double tap, or a long press: a corner goes, or a line gets one.
function addOrRemove(place, reach) {
  const i = cornerNear(place, reach);
  if (i >= 0) {
    removeCorner(i);
    return;
  }
  const edge = edgeNear(place, reach * 1.3);
  if (edge >= 0) addCorner(edge, under(...place, edge));
}

stage.addEventListener("pointerdown", (event) => {
  if (event.target.closest(".view") || (event.pointerType === "mouse" && event.button !== 0)) return;
  event.preventDefault();
  stage.setPointerCapture(event.pointerId);
  cancelAnimationFrame(moving);
  const place = placeOf(event);
  pointers.set(event.pointerId, place);
  clearTimeout(hold);
  if (pointers.size === 2) {
    drag = { pinch: true };
    return;
  }
  const i = cornerNear(place, reachOf(event));
  if (i >= 0) {
    const [px, py] = toScreen(cornerAt(i));
    drag = {
      corner: i,
      off: [px - place[0], py - place[1]],
      start: place,
      moved: false,
      name: "drag" + event.timeStamp,
    };
    select(i);
  } else {
    drag = { turn: true, start: place, moved: false };
    selected = -1;
    if (document.activeElement && stage.contains(document.activeElement)) document.activeElement.blur();
  }
  if (event.pointerType !== "mouse") {
    hold = setTimeout(() => {
      if (!drag || drag.moved || pointers.size !== 1) return;
      drag = null;
      lastTap.time = 0;
      addOrRemove(place, 26);
    }, 550);
  }
});

stage.addEventListener("pointermove", (event) => {
  const place = placeOf(event),
    before = pointers.get(event.pointerId);
  if (!before) {
    stage.classList.toggle("over", cornerNear(place, reachOf(event)) >= 0);
    return;
  }
  if (drag && drag.pinch && pointers.size === 2) {
    const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
    const apart = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
    pointers.set(event.pointerId, place);
    zoom(apart(place) / Math.max(1, apart(before)), (place[0] + other[0]) / 2, (place[1] + other[1]) / 2);
    return;
  }
  pointers.set(event.pointerId, place);
  if (!drag || drag.pinch) return;
  if (
    !drag.moved &&
    Math.hypot(place[0] - drag.start[0], place[1] - drag.start[1]) < (event.pointerType === "mouse" ? 2 : 6)
  )
    return;
  drag.moved = true;
  clearTimeout(hold);
  stage.classList.add("dragging");
  if (drag.turn) {
    const dx = place[0] - before[0],
      dy = place[1] - before[1];
    if (outline.kind === "plane") view.focus = [view.focus[0] - dx / view.scale, view.focus[1] + dy / view.scale, 0];
    else {
      const speed = 1 / Math.min(view.scale * bodySize(), 0.6 * Math.min(width, height));
      rotate(-dx * speed, dy * speed);
    }
    draw();
  } else {
    moveCorner(drag.corner, under(place[0] + drag.off[0], place[1] + drag.off[1], drag.corner), drag.name);
  }
});

function letGo(event) {
  if (!pointers.delete(event.pointerId)) return;
  clearTimeout(hold);
  stage.classList.remove("dragging");
  const tapped = drag && !drag.moved && !drag.pinch && event.type === "pointerup";
  if (tapped) {
    const [x, y] = drag.start;
    if (event.timeStamp - lastTap.time < 400 && Math.hypot(x - lastTap.x, y - lastTap.y) < 24) {
      addOrRemove(drag.start, reachOf(event));
      lastTap.time = 0;
    } else {
      lastTap = { time: event.timeStamp, x, y };
    }
  }
  if (!pointers.size) drag = null;
  gesture = null;
}
stage.addEventListener("pointerup", letGo);
stage.addEventListener("pointercancel", letGo);
stage.addEventListener("contextmenu", (event) => event.preventDefault());
stage.addEventListener(
  "wheel",
  (event) => {
    event.preventDefault();
    zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...placeOf(event));
  },
  { passive: false },
);

// --- keys ------------------------------------------------------------------------------------------------------------

document.addEventListener("keydown", (event) => {
  if (document.querySelector("dialog[open]")) return;
  const target = event.target,
    typing = target.matches("textarea, select, input[type=range]");
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if ((event.ctrlKey || event.metaKey) && !event.altKey && !typing) {
    if (key === "z" || key === "y") {
      event.preventDefault();
      if (key === "y" || event.shiftKey) timeTravel(future, past);
      else timeTravel(past, future);
    }
    return;
  }
  if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
  const i = [...$("corners").children].indexOf(target);
  const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[key];
  if (way && i >= 0) {
    event.preventDefault();
    const step = event.shiftKey ? 1 : 8,
      [px, py] = toScreen(cornerAt(i));
    if (isCornerSeen(i)) moveCorner(i, under(px + step * way[0], py + step * way[1], i), "key" + i);
    return;
  }
  const next = { PageDown: 1, PageUp: -1 }[key];
  if (next && i >= 0) {
    event.preventDefault();
    select((i + next + count()) % count());
    return;
  }
  const turn = { a: [-1, 0], d: [1, 0], w: [0, -1], s: [0, 1] }[key];
  if (turn) {
    event.preventDefault();
    if (outline.kind === "plane") view.focus = plus(view.focus, [turn[0], -turn[1], 0], 24 / view.scale);
    else rotate(turn[0] * 0.12, -turn[1] * 0.12);
    draw();
  } else if (key === "+" || key === "=") zoom(1.25);
  else if (key === "-") zoom(0.8);
  else if (key === "0") goTo(viewOfAll());
  else if (key === "?") openDialog("help", "help-title");
  else if ((key === "Delete" || key === "Backspace") && i >= 0) {
    event.preventDefault();
    removeCorner(i);
  } else if (key === "Insert" || (key === "n" && i >= 0)) {
    event.preventDefault();
    addInTheMiddle();
  } else if (key === "Escape" && i >= 0) target.blur();
});

// --- buttons ---------------------------------------------------------------------------------------------------------

for (const input of document.querySelectorAll('input[name="kind"]'))
  input.addEventListener("change", () => show(kept[input.value] || firstOn(input.value)));
for (const button of document.querySelectorAll("[data-preset]"))
  button.addEventListener("click", () => PRESETS[button.dataset.preset]());
$("country").addEventListener("change", (event) => {
  const name = event.target.value;
  event.target.value = "";
  if (name) show(fromLongest(onSphere(fromDegrees(presets.countries[name]))));
});
$("sides").addEventListener("change", () => PRESETS.regular());
$("bend-value").addEventListener("input", (event) => setBend(Number(event.target.value)));
$("bend-value").addEventListener("change", () => {
  gesture = null;
});
$("add").addEventListener("click", addInTheMiddle);
$("remove").addEventListener("click", () => removeCorner(selected >= 0 ? selected : count() - 1));
$("turn").addEventListener("click", () => change(reversed(outline)));
$("undo").addEventListener("click", () => timeTravel(past, future));
$("redo").addEventListener("click", () => timeTravel(future, past));
$("closer").addEventListener("click", () => zoom(1.3));
$("farther").addEventListener("click", () => zoom(1 / 1.3));
$("fit").addEventListener("click", () => goTo(viewOfAll()));
$("base-less").addEventListener("click", () =>
  change({ ...outline, base: (outline.base + count() - 1) % count() }, "base"),
);
$("base-more").addEventListener("click", () => change({ ...outline, base: (outline.base + 1) % count() }, "base"));
for (const input of document.querySelectorAll('input[name="transport"]'))
  input.addEventListener("change", () => {
    transport = input.value;
    draw();
  });
for (const button of document.querySelectorAll("[data-copy]")) {
  button.addEventListener("click", async () => {
    const field = $(button.dataset.copy),
      name = button.textContent;
    let done = true;
    try {
      await navigator.clipboard.writeText(field.value);
    } catch {
      field.select(); // where the clipboard is closed to pages from disk
      done = document.execCommand("copy");
    }
    button.textContent = done ? "Copied" : "Press Ctrl+C";
    setTimeout(() => {
      button.textContent = name;
    }, 1500);
  });
}
$("open-help").addEventListener("click", () => openDialog("help", "help-title"));
$("open-load").addEventListener("click", () => {
  $("load-said").hidden = true;
  openDialog("load", "load-text");
});
for (const button of document.querySelectorAll("[data-close]"))
  button.addEventListener("click", () => button.closest("dialog").close());
$("load-do").addEventListener("click", () => load($("load-text").value));
$("load-example").addEventListener("click", () => {
  $("load-text").value = EXAMPLES.plane;
});
$("which").addEventListener("change", () => {
  try {
    showLoaded(Number($("which").value));
  } catch (error) {
    if (!(error instanceof TableError)) throw error;
    notify(error.message);
  }
});
document.addEventListener("paste", (event) => {
  if (event.target.closest && event.target.closest("textarea, dialog")) return;
  const text = event.clipboardData.getData("text/plain");
  if (text) load(text);
});
document.addEventListener("dragover", (event) => event.preventDefault());
document.addEventListener("drop", async (event) => {
  event.preventDefault();
  const [file] = event.dataTransfer.files;
  if (file) load(file.size > MOST_TEXT ? " ".repeat(MOST_TEXT + 1) : await file.text());
});
window.addEventListener("hashchange", readAddress);

for (let p = 3; p <= 12; p++) $("sides").add(new Option(p, p, p === 6, p === 6));
for (const name of Object.keys(presets.countries)) $("country").add(new Option(name, name));

function resize() {
  const box = stage.getBoundingClientRect();
  const [w, h] = [stage.clientWidth || box.width, stage.clientHeight || box.height],
    old = Math.min(width, height);
  width = w;
  height = h;
  canvas.width = Math.round(w * devicePixelRatio);
  canvas.height = Math.round(h * devicePixelRatio);
  if (old > 1) view.scale *= Math.min(width, height) / old;
  draw();
}

async function start() {
  try {
    engine = await startEngine(Uint8Array.from(atob($("wasm").textContent), (c) => c.charCodeAt(0)));
  } catch (error) {
    $("trouble").hidden = false;
    $("trouble-text").textContent = "This browser cannot run WebAssembly from a file: " + error.message;
    return;
  }
  readColors();
  resize();
  outline = onSphere([1, 0, 0, 0, 1, 0, 0, 0, 1]);
  view = viewOfAll();
  refresh();
  readAddress();
  rest();
  new ResizeObserver(resize).observe(stage);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    readColors();
    refresh();
  });
}
start();
