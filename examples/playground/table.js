// table.js - a table that somebody pasted: text -> outlines. The rules are those of the command, whose
// examples/command/table.h and columns.h state them; the checks run this file in node, too, beside the command.
"use strict";

const COLUMN_NAMES = {
  k: ["k", "vertexindex", "vertexpartindex"],
  x: ["x", "col", "column", "axis1", "positionx"],
  y: ["y", "positiony"],
  z: ["z", "positionz"],
  nx: ["nx", "normalx"],
  ny: ["ny", "normaly"],
  nz: ["nz", "normalz"],
  lon: ["lon", "longitude", "lng", "long", "ra"],
  lat: ["lat", "latitude", "dec"],
  row: ["row", "axis0"],
};
const words = (list) => new Set(list.split(" "));
const ID_WORDS = words(
  "cell cells id ids label labels track frame t time timepoint ring part name file filename image roi object outline " +
    "polygon contour region country plate face loop tissue sample slice stack series group feature fid gid uid index " +
    "shape segment particle nucleus grain",
);
const MEASURED_WORDS = words(
  "area mean perimeter length volume std sd min max median intensity type value radius angle distance score width " +
    "height color colour level",
);
const LAYOUTS = {
  plane: ["x", "y"],
  lonlat: ["lon", "lat"],
  sphere: ["x", "y", "z"],
  embedded: ["x", "y", "z", "nx", "ny", "nz"],
};
const EXAMPLES = {
  plane: "x,y\n0,0\n4,0\n4,2\n0,2\n",
  lonlat: "lon,lat\n10,0\n30,0\n20,15\n",
  sphere: "x,y,z\n1,0,0\n0,1,0\n0,0,1\n",
  embedded: "x,y,z,nx,ny,nz\n2,0,0,1,0,0\n0,2,0,0,1,0\n0,0,2,0,0,1\n",
};
const MOST_TEXT = 1 << 23;

// What is wrong with a table, and an example of one that is right.
class TableError extends Error {
  constructor(text, line = 0, layout = "plane") {
    super(line ? `Line ${line}: ${text}.` : `${text}.`);
    this.example = EXAMPLES[layout];
  }
}

// A field for a message.
const quote = (field) => `'${field.length > 40 ? field.slice(0, 40) + "\u2026" : field}'`;

// --- lines -> fields -------------------------------------------------------------------------------------------------

function separatorOf(line) {
  const bare = line.replace(/"[^"]*"?/g, "");
  return ["\t", ";", ","].find((c) => bare.includes(c)) || " ";
}

// Fields may be quoted; between tabs and blanks only if the closing quote is in sight.
function fieldsOf(line, separator, number) {
  const fields = [],
    gap = separator === " " ? /[ \t\v\f]/ : { test: (c) => c === separator };
  let rest = separator === " " ? line.trim() : line;
  for (;;) {
    rest = separator === "\t" ? rest.replace(/^ +/, "") : rest.replace(/^[ \t\v\f]+/, "");
    const quoted = /^"((?:[^"]|"")*)"/.exec(rest);
    const strict = separator === "," || separator === ";";
    if (rest[0] === '"' && strict && !quoted) throw new TableError("a quote is not closed", number);
    const follows = quoted ? rest[quoted[0].length] : undefined;
    if (quoted && (strict || follows === undefined || gap.test(follows) || follows === " ")) {
      fields.push(quoted[1].replaceAll('""', '"'));
      rest = rest.slice(quoted[0].length);
      while (rest && !gap.test(rest[0])) rest = rest.slice(1);
    } else {
      let end = 0;
      while (end < rest.length && !gap.test(rest[end])) end++;
      fields.push(rest.slice(0, end).trim());
      rest = rest.slice(end);
    }
    if (!rest) return fields;
    rest = rest.slice(1);
  }
}

// The number in a field, NaN and infinity among them; undefined if there is none. A comma is a decimal point where it
// separates no fields.
function numberIn(field, separator) {
  let text = field;
  if ((separator === "\t" || separator === ";") && /^[^,.]*,[^,.]*$/.test(field)) text = field.replace(",", ".");
  if (/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text)) return Number(text);
  if (/^[+-]?nan$/i.test(text)) return NaN;
  return /^[+-]?inf(inity)?$/i.test(text) ? Infinity : undefined;
}

// --- the line that names the columns ---------------------------------------------------------------------------------

// `X (um)`, `x [um]` and `X` are all x.
const simple = (name) =>
  name
    .split(/[([]/)[0]
    .toLowerCase()
    .replace(/[^a-z0-9\u0080-\uffff]/g, "");

// Words end at what is no letter, and before a capital: track_id, cellID.
const hasWord = (name, list) =>
  name
    .replace(/([a-z])([A-Z])/g, "$1 $2")
    .toLowerCase()
    .split(/[^a-z]+/)
    .some((word) => list.has(word));

function columnsOf(names, line) {
  const place = {};
  for (const [column, [usual]] of Object.entries(COLUMN_NAMES))
    names.forEach((name, i) => {
      if (simple(name) !== usual || name === "K") return;
      if (place[column] !== undefined) throw new TableError(`two columns are named '${column}'`, line);
      place[column] = i;
    });
  const hasXY = () => place.x !== undefined && place.y !== undefined;
  if (hasXY()) delete place.row;
  const known = (i) => Object.values(place).includes(i);
  names.forEach((name, i) => {
    for (const [column, [, ...others]] of Object.entries(COLUMN_NAMES)) {
      if (["lon", "lat", "row"].includes(column) && hasXY()) continue;
      if (place[column] === undefined && !known(i) && others.includes(simple(name))) place[column] = i;
    }
  });
  if (place.row !== undefined && place.y === undefined) place.y = place.row;
  let ids = [...names.keys()].filter(
    (i) => !known(i) && hasWord(names[i], ID_WORDS) && !hasWord(names[i], MEASURED_WORDS),
  );
  if (!ids.length)
    ids = [...names.keys()].filter((i) => !known(i) && names[i] && !hasWord(names[i], MEASURED_WORDS)).slice(0, 1);
  return { place, ids, unnamed: !ids.length && names[0] === "" };
}

function layoutOf({ place }, names, surface, line) {
  const some = (...columns) => columns.some((column) => place[column] !== undefined);
  const lonlat = some("lon", "lat");
  let layout = surface === "sphere" ? (lonlat ? "lonlat" : "sphere") : surface;
  if (!layout) {
    if (lonlat && some("x", "y")) throw new TableError("columns lon lat and x y: choose the surface", line);
    if (!lonlat && !some("x", "y"))
      throw new TableError(
        `this line should name the columns: x y, lon lat, x y z, or x y z nx ny nz. Here it is ${quote(names.join(" "))}`,
        line,
      );
    layout = lonlat ? "lonlat" : place.z === undefined ? "plane" : "embedded";
    if (layout === "embedded" && !some("nx", "ny", "nz"))
      throw new TableError("columns nx ny nz are missing, the outer normals; or choose sphere or plane", line, layout);
  }
  const missing = LAYOUTS[layout].find((column) => place[column] === undefined);
  if (missing) throw new TableError(`no column '${missing}'; the columns are ${quote(names.join(" "))}`, line, layout);
  return layout;
}

// --- corners ---------------------------------------------------------------------------------------------------------

// In the order of k, without the first corner where it comes again at the end.
function finish(outline) {
  let rows = outline.rows;
  const equal = (a, b) => a.x.every((value, i) => value === b.x[i]);
  const first = rows[0],
    last = rows[rows.length - 1];
  if (rows.length > 1 && equal(first, last) && first.k === last.k) rows.pop();
  if (first.k !== undefined) {
    rows = rows.slice().sort((a, b) => a.k - b.k);
    const twice = rows.find((row, i) => !Number.isInteger(row.k) || (i > 0 && row.k === rows[i - 1].k));
    if (twice) outline.fault = new TableError("k is not whole, or the same twice in this outline", twice.line);
  }
  while (rows.length > 1 && equal(rows[0], rows[rows.length - 1])) rows.pop();
  const again = rows.findIndex((row, i) => i >= 3 && i + 1 < rows.length && equal(row, rows[0]));
  if (again > 0 && !outline.fault)
    outline.fault = new TableError(
      "the first corner comes again here, and the outline goes on: a hole or another part under the same id",
      rows[again].line,
    );
  outline.corners = rows.flatMap((row) => row.x.slice(0, 3));
  if (outline.kind === "embedded") outline.normals = rows.flatMap((row) => row.x.slice(3));
  delete outline.rows;
}

// Longitude and latitude in degrees.
function fromLonLat(lon, lat) {
  const a = (lon * Math.PI) / 180,
    b = (lat * Math.PI) / 180;
  return [Math.cos(b) * Math.cos(a), Math.cos(b) * Math.sin(a), Math.sin(b)];
}

// The numbers of a line as x y z, or x y z nx ny nz.
function pointOf(layout, value, down) {
  if (layout === "lonlat") return fromLonLat(...value);
  if (layout === "plane") return [value[0], down * value[1], 0];
  if (layout === "sphere") return value;
  return value.map((v, i) => (i === 1 || i === 4 ? down * v : v));
}

// Lines of x,y,x,y,... without names: an outline each.
function readLines(lines, outlines) {
  lines.forEach((line, i) => {
    if (!line.trim() || line.trim()[0] === "#") return;
    const value = fieldsOf(line, ",", i + 1).map((field) => numberIn(field, ","));
    if (value.length % 2) throw new TableError(`${value.length} numbers are no pairs x,y`, i + 1);
    if (!value.every(Number.isFinite)) throw new TableError("a field is not a number", i + 1);
    const outline = { id: String(outlines.length), kind: "plane", line: i + 1, rows: [] };
    for (let k = 0; k < value.length; k += 2) outline.rows.push({ x: [value[k], value[k + 1], 0], line: i + 1 });
    outlines.push(outline);
  });
}

// text: the table. surface: "" as the columns say, "plane" or "sphere". Returns { outlines: [{ id, kind, corners, normals
// of kind embedded, line, fault }], remarks: [text] }, or throws a TableError. An outline with a fault is no outline.
function readTable(text, surface = "") {
  if (text.length > MOST_TEXT) throw new TableError("the table is longer than 8 MB; the command reads it");
  if (text.includes("\0")) throw new TableError("a zero byte: this is not plain text");
  if (/^\s*[{[]/.test(text)) throw new TableError("this is JSON; the page reads tables, the command GeoJSON, too");
  if (/^\s*(OFF|ply|solid|# vtk|v )/.test(text))
    throw new TableError("this is a mesh; the page reads tables, the command meshes, too");
  const lines = text.replace(/^\ufeff/, "").split(/\r\n|\n|\r/);
  const isBlank = (line) => !line.trim(),
    isComment = (line) => line.trim()[0] === "#";
  const outlines = [],
    remarks = [];
  const head = lines.findIndex((line) => !isBlank(line) && !isComment(line));
  if (head < 0) throw new TableError("there is no line that names the columns");
  const separator = separatorOf(lines[head]),
    names = fieldsOf(lines[head].trimEnd(), separator, head + 1);
  if (
    separator === "," &&
    names.length >= 6 &&
    surface !== "sphere" &&
    names.every((name) => numberIn(name, separator) !== undefined)
  ) {
    readLines(lines, outlines);
    remarks.push("Each line is an outline x,y,x,y,...");
    outlines.forEach(finish);
    return { outlines, remarks };
  }
  const columns = columnsOf(names, head + 1),
    layout = layoutOf(columns, names, surface, head + 1);
  const down = columns.place.row !== undefined && columns.place.row === columns.place.y ? -1 : 1;
  const used = [...LAYOUTS[layout], ...(columns.place.k === undefined ? [] : ["k"])];
  let current = null,
    count = 0,
    shift = 0,
    unnamed = columns.unnamed,
    decimal = "";
  const end = () => {
    current = null;
  };
  for (let i = head + 1; i < lines.length; i++) {
    const line = lines[i],
      number = i + 1;
    if (isComment(line)) continue;
    if (isBlank(line) || line.trim()[0] === ">") {
      if (!columns.ids.length) end();
      continue;
    }
    const fields = fieldsOf(line, separator, number);
    // row names of R have no name: fields are one place further on
    if (count === 0 && fields.length === names.length + 1 && line.trim()[0] === '"') shift = 1;
    if (fields.slice(names.length + shift).some(Boolean))
      throw new TableError(`${fields.length} fields, but ${names.length} columns are named`, number, layout);
    const value = used.map((column) => {
      const field = fields[columns.place[column] + shift];
      if (field === undefined) throw new TableError(`no field for column '${column}'`, number, layout);
      if (field === "") throw new TableError(`column '${column}' is empty`, number, layout);
      const x = numberIn(field, separator);
      if (x === undefined)
        throw new TableError(`${quote(field)} in column '${column}' is not a number`, number, layout);
      const point =
        separator === "," || separator === " " ? "" : field.includes(",") ? "," : field.includes(".") ? "." : "";
      if (point && decimal && point !== decimal)
        throw new TableError(`${quote(field)}: numbers before it have the other decimal point`, number, layout);
      decimal = decimal || point;
      return x;
    });
    const xs = value.slice(0, LAYOUTS[layout].length);
    if (!columns.ids.length && xs.every(Number.isNaN)) {
      end(); // a row of NaNs, as MATLAB has between outlines
      continue;
    }
    // a first column without a name is an id if the second row has the same in it as the first
    if (unnamed && count === 1) {
      if (fields[0] === outlines[0].first) {
        columns.ids = [0];
        outlines[0].id = fields[0];
      }
      unnamed = false;
    }
    const id = columns.ids.length ? columns.ids.map((c) => fields[c + shift] ?? "").join("/") : null;
    if (!current || (id !== null && id !== current.id)) {
      current = {
        id: id ?? String(outlines.length),
        kind: layout === "lonlat" ? "sphere" : layout,
        line: number,
        rows: [],
      };
      if (unnamed) current.first = fields[0];
      outlines.push(current);
    }
    if (!xs.every(Number.isFinite))
      current.fault = current.fault || new TableError("a number is not finite", number, layout);
    if (layout === "lonlat" && !(Math.abs(xs[1]) <= 90))
      current.fault = current.fault || new TableError("a latitude is not between -90 and 90", number, layout);
    current.rows.push({ x: pointOf(layout, xs, down), k: value[LAYOUTS[layout].length], line: number });
    count++;
  }
  if (!outlines.length) throw new TableError("there are no corners below the names of the columns", head + 1, layout);
  if (columns.ids.length) remarks.push(`Id: ${columns.ids.map((c) => names[c] || "the first column").join(", ")}.`);
  outlines.forEach(finish);
  return { outlines, remarks };
}
