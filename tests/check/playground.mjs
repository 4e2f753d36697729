// playground.mjs PAGE NATIVE SURFMINK: does the WebAssembly in docs/playground.html compute what C computes? Random
// outlines on each surface, good and bad, are held, to 1e-12, against
//   NATIVE     tests/check/playground.c, compiled from the same source with the libm of this machine: everything
//   SURFMINK   the command, which reads the tables that the page hands out: statuses, L, S, area, mu of both transports
// In node, without a browser.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";

const [page, native, surfmink] = process.argv.slice(2);
const html = readFileSync(page, "utf8");
const wasm = Buffer.from(/id="wasm">([^<]*)</.exec(html)[1], "base64");
const engine = readFileSync(new URL("../../examples/playground/engine.js", import.meta.url), "utf8");
if (!html.includes(engine)) throw Error("the page has another engine.js");
const { startEngine, tableOf, commandOf, KINDS } = new Function(
  engine + "; return { startEngine, tableOf, commandOf, KINDS };",
)();
if (WebAssembly.Module.imports(new WebAssembly.Module(wasm)).length) throw Error("the module imports something");
const run = await startEngine(wasm);

let passed = 0,
  failed = 0;
function check(name, ok, said = "") {
  if (ok) passed++;
  else if (failed++ < 20) console.log("FAILED " + name, said);
}
const far = (a, b) => Math.abs(a - b) / Math.max(1, Math.abs(b));

let seed = 20240229; // mulberry32
function random() {
  seed = (seed + 0x6d2b79f5) | 0;
  let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
  t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
  return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
}
const between = (a, b) => a + (b - a) * random();

const SHAPES = {
  plane: [[1, 1, 1]],
  sphere: [[1, 1, 1]],
  ellipsoid: [
    [1.5, 1.2, 0.9],
    [2.2, 1, 0.8],
    [1, 1, 0.4],
    [1, 1, 1],
  ],
  torus: [
    [1, 0.45, 0],
    [1, 0.2, 0],
    [1, 0.75, 0],
  ],
  embedded: [[1, 1, 1]],
};

// A regular polygon anywhere, its corners pushed about; now and then clockwise, or two of its corners exchanged, or the
// same, or opposite.
function randomOutline(kind, i) {
  if (kind === "embedded") return withNormals(randomOutline("ellipsoid", i));
  const shape = SHAPES[kind][i % SHAPES[kind].length];
  const outline = { kind, shape, base: 0, corners: [] };
  const n = 3 + Math.floor(random() ** 2 * 12),
    push = random() < 0.2 ? 0 : between(0, 0.5);
  const widest = kind === "torus" ? Math.min(0.9, 1.5 * shape[1]) : kind === "ellipsoid" ? 0.8 : 1.5;
  const size = random() < 0.3 ? 10 ** between(-4, -1) : between(0.1, widest);
  let centre = null;
  while (!centre) centre = run.project(outline, [between(-1, 1), between(-1, 1), between(-1, 1)]);
  const round = run.regular(outline, centre, n, size, between(0, 6));
  for (let k = 0; k < n; k++) {
    const x = [0, 1, 2].map((j) => round[3 * k + j] + (push * size * between(-1, 1)) / Math.sqrt(n));
    outline.corners.push(...run.project(outline, x));
  }
  const corner = (k) => outline.corners.slice(3 * k, 3 * k + 3);
  const put = (k, x) =>
    x.forEach((v, j) => {
      outline.corners[3 * k + j] = v;
    });
  const fate = random(),
    [a, b] = [corner(0), corner(1)];
  if (fate < 0.04) for (let k = 0; k < n; k++) put(k, round.slice(3 * (n - 1 - k), 3 * (n - k)));
  else if (fate < 0.08) {
    put(0, b);
    put(1, a);
  } else if (fate < 0.1) put(1, a);
  else if (fate < 0.12 && kind !== "torus")
    put(
      1,
      a.map((v) => -v),
    );
  outline.base = Math.floor(random() * n);
  return outline;
}

// The corners of an ellipsoid, stretched and moved away, with normals of any length that are a little off.
function withNormals(outline) {
  const size = 10 ** between(-3, 6),
    normals = outline.corners.map((x, k) => (x / outline.shape[k % 3] ** 2) * 3 + between(-0.1, 0.1));
  const corners = outline.corners.map((x, k) => x * size + 2 * size * (k % 3));
  return { ...outline, kind: "embedded", shape: [1, 1, 1], corners, normals };
}

for (const kind of KINDS) {
  const outlines = Array.from({ length: 200 }, (_, i) => randomOutline(kind, i));
  const found = outlines.map((outline) => run.measure(outline));
  const seen = {};
  for (const f of found) seen[f.name] = (seen[f.name] || 0) + 1;
  check(`${kind}: most outlines are measured, some refused`, seen.ok >= 130 && Object.keys(seen).length >= 3, seen);

  // the same source, natively
  const input = outlines.map((o) =>
    [KINDS.indexOf(o.kind), o.base, ...o.shape, o.corners.length / 3, ...o.corners, ...(o.normals || [])].join(" "),
  );
  const lines = execFileSync(native, { input: input.join("\n") + "\n", maxBuffer: 1e9, encoding: "utf8" })
    .trim()
    .split("\n");
  check(`${kind}: a line for each`, lines.length === outlines.length, lines.length);
  const angles = ["theta", "thetaClassical", "director"]; // noise where mu is: compared times mu
  lines.forEach((line, i) => {
    const f = found[i],
      word = line.split(" "),
      number = word.slice(1).map(Number);
    const where = `${kind} ${i}: `;
    check(where + "status", word[0] === f.name, [word[0], f.name]);
    let at = 0;
    for (const key of [
      "bad",
      "other",
      "mu",
      "classical",
      "theta",
      "thetaClassical",
      "area",
      "length",
      "turning",
      "curvature",
      "condition",
      "base",
      "centre",
      "director",
      "arrow",
      "arrowClassical",
      "foot",
    ]) {
      const got = typeof f[key] === "number" ? [f[key]] : f[key];
      let worst = 0;
      got.forEach((x, k) => {
        const p = key === "director" ? Math.floor(k / 3) : k;
        let weight = 1;
        if (angles.includes(key)) weight = Math.min(1, (key === "thetaClassical" ? f.classical : f.mu)[p]);
        let d = far(x, number[at + k]);
        if (key.startsWith("theta") && p > 0) {
          // pi / p and -pi / p are the same direction
          const turn = (2 * Math.PI) / p,
            w = Math.abs(x - number[at + k]);
          d = Math.min(w, Math.abs(turn - w));
        }
        if (key === "director" && p > 0 && d > 1e-9) d = directorOff(f, p, x, number.slice(at + 3 * p, at + 3 * p + 3));
        worst = Math.max(worst, d * weight || 0);
        if (Number.isNaN(x)) worst = Infinity;
      });
      check(where + key, worst <= 1e-12 * (key === "condition" ? f.condition : 1), worst);
      at += got.length;
    }
    check(where + "points", number[at] === f.edgeOf.length, [number[at], f.edgeOf.length]);
    at++;
    for (const key of ["point", "normal"]) {
      let worst = 0;
      f[key].forEach((x, k) => {
        worst = Math.max(worst, far(x, number[at + k]));
      });
      check(where + key, worst <= 1e-12, worst);
      at += f[key].length;
    }
  });

  // the command, from the tables of the page
  const given = found.map((_, i) => i).filter((i) => found[i].measured.length);
  const tables = given.map((i) => tableOf(outlines[i], found[i]).split("\n").slice(1));
  const table = tables[0][0] + "\n" + tables.map((t) => t.slice(1).join("\n")).join("\n");
  for (const transport of ["corrected", "parallel"]) {
    const words = commandOf(outlines[0]).split(" ").slice(1);
    let said;
    try {
      said = execFileSync(surfmink, [...words, "--quiet", "--digits", "17", "--transport", transport], {
        input: table,
        encoding: "utf8",
        maxBuffer: 1e8,
      });
    } catch (error) {
      said = error.status === 2 ? error.stdout : ""; // some are refused
    }
    const [head, ...rows] = said
      .trimEnd()
      .split("\n")
      .map((row) => row.split("\t"));
    check(`${kind}, ${transport}: a row for each`, rows.length === given.length, [rows.length, given.length]);
    rows.forEach((row, r) => {
      const f = found[given[r]],
        where = `${kind} ${given[r]}, ${transport}: `;
      const value = Object.fromEntries(head.map((name, k) => [name, row[k]]));
      check(where + "status", value.status === f.name, [value.status, f.name]);
      if (!f.ok) return;
      let worst = Math.max(far(f.length, Number(value.L)), far(f.turning, Number(value.S)));
      if (kind === "plane" || kind === "sphere") worst = Math.max(worst, far(f.area, Number(value.area)));
      for (let p = 1; p <= 12; p++)
        worst = Math.max(
          worst,
          Math.abs((transport === "corrected" ? f.mu : f.classical)[p] - Number(value["mu_" + p])),
        );
      check(where + "numbers", worst <= 1e-12, worst);
    });
  }
}

// Of p directions one is as good as another.
function directorOff(f, p, x, want) {
  const e1 = Array.from(f.director.slice(3 * p, 3 * p + 3)),
    N = Array.from(f.centre.slice(3, 6));
  const e2 = [N[1] * e1[2] - N[2] * e1[1], N[2] * e1[0] - N[0] * e1[2], N[0] * e1[1] - N[1] * e1[0]];
  let best = Infinity;
  for (let k = 0; k < p; k++) {
    const a = (2 * Math.PI * k) / p;
    best = Math.min(
      best,
      Math.max(...[0, 1, 2].map((j) => Math.abs(Math.cos(a) * e1[j] + Math.sin(a) * e2[j] - want[j]))),
    );
  }
  return best;
}

console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
