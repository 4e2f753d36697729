// engine.js - playground.wasm for JavaScript: corners in, everything that the page shows out. No page is needed: the
// checks run this file in node, too. The numbers and their order are those of `results` in playground.c.
"use strict";

const KINDS = ["plane", "sphere", "ellipsoid", "torus", "embedded"];
const RANK = 12;

async function startEngine(bytes) {
  const { instance } = await WebAssembly.instantiate(bytes);
  const wasm = instance.exports;
  const memory = wasm.memory.buffer; // never grows
  const room = wasm.playground_corners();
  const corner = new Float64Array(memory, wasm.playground_corner(), 3 * room);
  const given = new Float64Array(memory, wasm.playground_given(), 3 * room);
  const shape = new Float64Array(memory, wasm.playground_shape(), 3);

  const layout = {};
  let end = 0;
  for (const [name, size] of [
    ["bad", 1],
    ["other", 1],
    ["mu", RANK + 1],
    ["classical", RANK + 1],
    ["theta", RANK + 1],
    ["thetaClassical", RANK + 1],
    ["area", 1],
    ["length", 1],
    ["turning", 1],
    ["curvature", 1],
    ["condition", 1],
    ["base", 12],
    ["centre", 6],
    ["director", 3 * RANK + 3],
    ["arrow", 2 * room],
    ["arrowClassical", 2 * room + 2],
    ["foot", 9 * room],
  ]) {
    layout[name] = new Float64Array(memory, wasm.playground_result() + 8 * end, size);
    end += size;
  }

  const text = (at) => {
    const bytes = new Uint8Array(memory, at);
    return String.fromCharCode(...bytes.subarray(0, bytes.indexOf(0)));
  };

  const put = (outline) => {
    corner.set(outline.corners);
    if (outline.normals) given.set(outline.normals);
    shape.set(outline.shape);
    return [KINDS.indexOf(outline.kind), outline.corners.length / 3];
  };

  return {
    most: room,

    // outline: { kind, shape: [3 numbers], base, corners: [x, y, z, x, y, z, ...] }; z is 0 in the plane. Kind embedded
    // has normals: [x, y, z, ...], too, and no shape.
    measure(outline) {
      const [kind, n] = put(outline);
      const status = wasm.playground_measure(kind, n, outline.base);
      const found = {
        status,
        ok: status === 0,
        name: text(wasm.playground_status_name(status)),
        sentence: text(wasm.playground_strerror(status)),
      };
      for (const [name, array] of Object.entries(layout)) found[name] = array.length > 1 ? array.slice() : array[0];
      const points = wasm.playground_points(),
        count = wasm.playground_count();
      const stride = kind === 0 ? 2 : 3;
      found.point = new Float64Array(memory, wasm.playground_point(), 3 * points).slice();
      found.normal = new Float64Array(memory, wasm.playground_normal(), 3 * points).slice();
      found.edgeOf = new Int32Array(memory, wasm.playground_edge_of(), points).slice();
      found.measured = new Float64Array(memory, wasm.playground_measured(), stride * count).slice();
      return found;
    },

    // The point of the surface under (or next to) a point in space; null where there is none.
    project(outline, x) {
      const [kind] = put({ ...outline, corners: x });
      return wasm.playground_project(kind, 0) ? Array.from(corner.subarray(0, 3)) : null;
    },

    // n corners at a distance from a centre; null if the surface does not let them.
    regular(outline, centre, n, distance, angle) {
      const [kind] = put({ ...outline, corners: centre });
      return wasm.playground_regular(kind, n, distance, angle) ? null : Array.from(corner.subarray(0, 3 * n));
    },
  };
}

// The measured outline as a table that the command reads, and the command. JavaScript prints a double with as many
// digits as it takes to read the same double again.
function tableOf(outline, found) {
  const lines = [],
    chords = outline.kind !== "plane" && outline.kind !== "sphere";
  const stride = outline.kind === "plane" ? 2 : 3,
    n = found.measured.length / stride;
  lines.push("# " + commandOf(outline) + " outline.tsv");
  lines.push((outline.kind === "plane" ? "x y" : chords ? "x y z nx ny nz" : "x y z").replaceAll(" ", "\t"));
  for (let i = 0; i < n; i++) {
    const row = Array.from(found.measured.subarray(stride * i, stride * i + stride));
    if (chords) row.push(...found.normal.subarray(3 * i, 3 * i + 3));
    lines.push(row.join("\t"));
  }
  return lines.join("\n") + "\n";
}

function commandOf(outline) {
  const word = outline.kind === "plane" || outline.kind === "sphere" ? outline.kind : "embedded";
  return "surfmink --surface " + word + " --reverse never --max-rank " + RANK;
}
