// h3_cells.mjs - the 5,882 cells of resolution 2 of Uber's H3 grid, as a table for surfmink.
//
//   npm install h3-js@4.5.0 && node h3_cells.mjs > h3_res2.tsv
//
// Longitude and latitude are printed with the digits that give back the same double (at most 17).
// Why an even resolution: there no cell edge crosses an edge of H3's icosahedron, so h3-js adds no
// extra corners, and the pentagons really have five.

import { getRes0Cells, cellToChildren, cellToBoundary } from "h3-js";

const resolution = 2;
const cells = getRes0Cells().flatMap((base) => cellToChildren(base, resolution)).sort();

const lines = [
  "# Uber H3 grid, all cells of resolution 2; made with h3-js 4.5.0 (Apache-2.0) by h3_cells.mjs",
  "# degrees, great-circle edges, corners counter-clockwise seen from outside, first corner not repeated",
  "cell\tlon\tlat",
];
for (const cell of cells) {
  for (const [lat, lon] of cellToBoundary(cell)) lines.push(`${cell}\t${lon}\t${lat}`);
}
process.stdout.write(lines.join("\n") + "\n");
