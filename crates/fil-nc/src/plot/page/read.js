// What the page holds: a trace of the path, and one of what lies under it.

const element = (id) => document.getElementById(id);
const wait = element("wait");

/** Says what keeps the page from being shown. */
function fail(reason) {
  wait.hidden = false;
  wait.textContent = `This page can't be shown: ${reason}`;
}
window.addEventListener("error", (event) => fail(event.message));
window.addEventListener("unhandledrejection", (event) => fail(event.reason));
if (typeof DecompressionStream === "undefined")
  throw new Error("the browser is too old to unpack it (a Chrome, Firefox or Safari of 2023 can)");

const data = JSON.parse(element("data").textContent);

/** Bytes of what lies in the page deflated, in base 64. */
async function unpack(base64) {
  const text = atob(base64), packed = new Uint8Array(text.length);
  for (let at = 0; at < packed.length; at++) packed[at] = text.charCodeAt(at);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Columns of whole numbers, one after the other. Each number is the difference from the one
 *  above it, seven bits a byte, the lowest first; the lowest bit is the sign. */
async function columns({ rows, packed }, kinds) {
  const bytes = await unpack(packed);
  let at = 0;
  return kinds.map((Kind) => {
    const column = new Kind(rows);
    for (let row = 0, value = 0; row < rows; row++) {
      let number = 0, weight = 1, byte = bytes[at++];
      while (byte > 127) {
        number += (byte & 127) * weight;
        weight *= 128;
        byte = bytes[at++];
      }
      number += byte * weight;
      value += number % 2 ? -(number + 1) / 2 : number / 2;
      column[row] = value;
    }
    return column;
  });
}

/** The lines of a text, each made when it is asked for; the first is line 1. */
async function readLines(packed) {
  const bytes = await unpack(packed);
  let count = bytes.length ? 1 : 0;
  for (let at = 0; at + 1 < bytes.length; at++) if (bytes[at] === 10) count++;
  const ends = new Uint32Array(count + 1);
  for (let at = 0, line = 1; line <= count; at++)
    if (at >= bytes.length || bytes[at] === 10) ends[line++] = at + 1;
  const decoder = new TextDecoder();
  const get = (line) =>
    (line < 1 || line > count ? "" : decoder.decode(bytes.subarray(ends[line - 1], ends[line] - 1)));
  return { count, get };
}

/** A text with the numbers again for which signs stand, as they are where the motions of its lines
 *  end: 1, or 2 for one with a zero before its point. */
function withEnds(text, { lines, ends, total }, points, { origin, decimals }) {
  const last = new Uint32Array(text.count + 1);
  for (let piece = 0; piece < total; piece++) last[lines[piece]] = ends[piece] - 1;
  const spell = (count, sign) => {
    const digits = String(Math.abs(count)).padStart(decimals + 1, "0"), point = digits.length - decimals;
    const whole = digits.slice(0, point), fraction = digits.slice(point).replace(/0+$/, "");
    return `${count < 0 ? "-" : ""}${sign === "\x01" && whole === "0" && fraction ? "" : whole}.${fraction}`;
  };
  const get = (line) => text.get(line).replace(/([XYZ])([\x01\x02])/g, (_, letter, sign) => {
    const axis = "XYZ".indexOf(letter);
    return letter + spell(origin[axis] + points[axis][last[line]], sign);
  });
  return { count: text.count, get };
}

const readJson = async (packed) => JSON.parse(new TextDecoder().decode(await unpack(packed)));

/** Pieces that are looked at as one: those beside the canvas are passed over. */
const BLOCK = 256;

async function readTrace(packed) {
  const whole = Float64Array;
  const [[xs, ys, zs], [heads, lines], inForce, axes, changes, text, causes, source, stacks] = await Promise.all([
    columns(packed.points, [Int32Array, Int32Array, Int32Array]),
    columns(packed.pieces, [Uint32Array, Uint32Array]),
    columns(packed.inForce, [Uint32Array, whole, Uint8Array, whole, Uint8Array, whole, Uint8Array, whole, whole]),
    columns(packed.axes, [Uint32Array, Int32Array, Int32Array, Int32Array]),
    columns(packed.changes, [Uint32Array, Int32Array, Int32Array, Int32Array, whole, Uint32Array]),
    readLines(packed.text),
    columns(packed.causes, [Uint32Array, Uint32Array]),
    readLines(packed.source),
    readJson(packed.stacks),
  ]);
  const count = xs.length, steps = new Int32Array(3 * count);
  for (let index = 0, at = 0; index < count; index++) {
    steps[at++] = xs[index];
    steps[at++] = ys[index];
    steps[at++] = zs[index];
  }
  const total = heads.length;
  const trace = {
    steps, lines, shown: total, part: 0, total, mask: new Uint8Array(total).fill(1),
    starts: new Uint32Array(total), ends: new Uint32Array(total), strokes: new Uint8Array(total),
    inForce: named(["from", "tool", "feedKind", "feed", "speedKind", "speed", "spindle", "fixture", "limit"], inForce),
    axes: named(["from", "x", "y", "z"], axes),
    changes: named(["from", "x", "y", "z", "tool", "line"], changes),
    text, source, sourceName: packed.sourceName, stacks,
    causeLines: causes[0], causeStacks: causes[1], leftOut: packed.leftOut,
  };
  for (let piece = 0, end = 0; piece < total; piece++) {
    const head = heads[piece];
    trace.starts[piece] = head & 4 ? end - 1 : end;
    trace.strokes[piece] = head & 3;
    trace.ends[piece] = end = trace.starts[piece] + (head >>> 3);
  }
  if (packed.ends) trace.text = withEnds(text, trace, [xs, ys, zs], packed.ends);
  addBlocks(trace);
  return trace;
}

/** Columns under their names. */
const named = (names, list) => Object.fromEntries(names.map((name, at) => [name, list[at]]));

/** The box around the points of each block, and which strokes it has. */
function addBlocks(trace) {
  const { starts, ends, strokes, steps, total } = trace;
  const blocks = Math.ceil(total / BLOCK);
  trace.boxes = new Int32Array(6 * blocks);
  trace.kinds = new Uint8Array(blocks);
  for (let block = 0; block < blocks; block++) {
    const box = trace.boxes.subarray(6 * block, 6 * block + 6);
    box.fill(0x7fffffff, 0, 3);
    box.fill(-0x80000000, 3);
    const last = Math.min(total, (block + 1) * BLOCK);
    for (let piece = block * BLOCK; piece < last; piece++) {
      trace.kinds[block] |= 1 << strokes[piece];
      for (let index = 3 * starts[piece], stop = 3 * ends[piece]; index < stop; index += 3) {
        for (let axis = 0; axis < 3; axis++) {
          const step = steps[index + axis];
          if (step < box[axis]) box[axis] = step;
          if (step > box[axis + 3]) box[axis + 3] = step;
        }
      }
    }
  }
}

/** The row of a table that counts at a piece: the last one from it or before; -1 for none. */
function rowAt({ from }, piece) {
  let low = 0, high = from.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (from[middle] <= piece) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

const path = await readTrace(data.path);
let under = data.under ? await readTrace(data.under) : null;
if (data.sourceIsUnder) path.source = under.text;

/** The path of another page, on the grid of this one. */
async function readOther(text) {
  const page = new DOMParser().parseFromString(text, "text/html").getElementById("data");
  if (!page) throw new Error("it is no page of filpost plot; make one with filpost plot FILE -o FILE.html");
  const other = JSON.parse(page.textContent), trace = await readTrace(other.path);
  const share = other.step / data.step, from = other.min.map((value, axis) => (value - data.min[axis]) / data.step);
  for (let at = 0; at < trace.steps.length; at++) trace.steps[at] = Math.round(trace.steps[at] * share + from[at % 3]);
  addBlocks(trace);
  return trace;
}

// --- units --------------------------------------------------------------------

const DIGITS = data.unit.name === "inch" ? 1e4 : 1e3;
const round = (value) => String(Math.round(value * DIGITS) / DIGITS + 0);
/** A length of mm in the unit of the program. */
const length = (mm) => round(mm / data.unit.size);
/** A coordinate of a point of a trace, mm. */
const coordinate = (trace, point, axis) => data.min[axis] + trace.steps[3 * point + axis] * data.step;
const pointOf = (trace, point) => [0, 1, 2].map((axis) => coordinate(trace, point, axis));
/** A point as the program says it: on a lathe that counts diameters, one before or behind the
 *  spindle is a diameter and Z. */
function said([x, y, z]) {
  if (data.diameter && Math.abs(y) < data.step) return `\u2300${length(2 * x)} Z${length(z)}`;
  return `X${length(x)} Y${length(y)} Z${length(z)}`;
}
