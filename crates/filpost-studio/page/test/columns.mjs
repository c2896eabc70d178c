// Columns of made-up programs, as the answer `columns` gives them.

const KINDS = { u8: Uint8Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array };

/** Columns of a path: `moves` gives each motion as stroke (0 rapid, 1 feed, 2 arc, 3 thread), line and its
 *  points after the first one; `force` rows as [from, tool, feed, speed]; the other fields of the head. */
export function makeColumns({ start, moves, force = [[0, 1, 500, 3000]], axes = [], rotary = [], ...head }) {
  const points = [...start], columns = { starts: [], ends: [], strokes: [], lines: [], seconds: [] };
  let clock = 0;
  for (const [stroke, line, ...way] of moves) {
    const first = points.length / 3 - 1;
    let size = 0;
    for (const point of way) {
      size += Math.hypot(...point.map((value, axis) => value - points[points.length - 3 + axis]));
      points.push(...point);
    }
    const feed = stroke === 0 ? 10000 : force.findLast(([from]) => from <= columns.lines.length)[2];
    clock += size / feed * 60;
    columns.starts.push(first);
    columns.ends.push(points.length / 3);
    columns.strokes.push(stroke);
    columns.lines.push(line);
    columns.seconds.push(clock);
  }
  const side = (axis, pick) => pick(...points.filter((_, at) => at % 3 === axis));
  const box = moves.length ? { min: [0, 1, 2].map((axis) => side(axis, Math.min)), max: [0, 1, 2].map((axis) => side(axis, Math.max)) } : { min: [0, 0, 0], max: [0, 0, 0] };
  const column = (name) => force.map((row) => row[name]);
  return pack({ title: "made up", base: [0, 0, 0], ...box, inch: false, lathe: false, diameter: false, rapid: 10000, tools: [], leftOut: [], chain: null, ...head }, {
    points: ["f32", points], starts: ["u32", columns.starts], ends: ["u32", columns.ends], strokes: ["u8", columns.strokes],
    lines: ["u32", columns.lines], seconds: ["f64", columns.seconds],
    forceFrom: ["u32", column(0)], tool: ["u32", column(1)], feedKind: ["u8", force.map(() => 1)], feed: ["f32", column(2)],
    speedKind: ["u8", force.map(() => 1)], speed: ["f32", column(3)], spindle: ["u8", force.map(() => 1)], fixture: ["u32", force.map(() => 55)],
    axesFrom: ["u32", axes.map(([from]) => from)], axes: ["f32", axes.flatMap(([, axis]) => axis)],
    rotaryFrom: ["u32", rotary.map(([from]) => from)], rotary: ["f32", rotary.flatMap(([, at]) => at)],
    changeFrom: ["u32", []], changeTool: ["u32", []], changeLine: ["u32", []], changeAt: ["f32", []],
  });
}

/** The bytes of a head and its columns, each a kind and its numbers. */
export function pack(head, columns) {
  const contents = {}, parts = [];
  let end = 0;
  for (const [name, [kind, numbers]] of Object.entries(columns)) {
    const list = KINDS[kind].from(numbers);
    end = Math.ceil(end / 8) * 8;
    contents[name] = [kind, end, list.length];
    parts.push([end, new Uint8Array(list.buffer)]);
    end += list.byteLength;
  }
  const text = JSON.stringify({ columns: contents, ...head }), long = new TextEncoder().encode(text).length;
  const written = new TextEncoder().encode(text + " ".repeat((8 - long % 8) % 8));
  const bytes = new Uint8Array(8 + written.length + end);
  bytes.set([70, 80, 86, 49]);
  new DataView(bytes.buffer).setUint32(4, written.length, true);
  bytes.set(written, 8);
  for (const [start, part] of parts) bytes.set(part, 8 + written.length + start);
  return bytes;
}

/** A program of many motions: rows to and fro over a hilly square. */
export function manyMotions(total) {
  const points = new Float32Array(3 * (total + 1)), whole = (work) => Uint32Array.from({ length: total }, (_, at) => work(at));
  const row = 1000, rows = Math.ceil(total / row);
  for (let at = 0; at <= total; at++) {
    const line = Math.floor(at / row), along = at % row, x = (line % 2 ? row - along : along) / row * 200 - 100, y = line / rows * 200 - 100;
    points.set([x, y, 15 * Math.sin(x / 20) * Math.cos(y / 25)], 3 * at);
  }
  const force = { forceFrom: ["u32", [0]], tool: ["u32", [1]], feedKind: ["u8", [1]], feed: ["f32", [2000]], speedKind: ["u8", [1]], speed: ["f32", [12000]], spindle: ["u8", [1]], fixture: ["u32", [55]] };
  const none = Object.fromEntries(["axesFrom", "rotaryFrom", "changeFrom", "changeTool", "changeLine"].map((name) => [name, ["u32", []]]));
  return pack({
    title: "many motions", base: [0, 0, 0], min: [-100, -100, -15], max: [100, 100, 15], inch: false, lathe: false, diameter: false, rapid: 10000,
    tools: [{ number: 1, diameter: 6, corner: 3, bottom: 0, length: 30 }], leftOut: [], chain: null,
  }, {
    points: ["f32", points], starts: ["u32", whole((at) => at)], ends: ["u32", whole((at) => at + 2)],
    strokes: ["u8", new Uint8Array(total).fill(1)], lines: ["u32", whole((at) => at + 1)],
    seconds: ["f64", Float64Array.from({ length: total }, (_, at) => (at + 1) * 0.01)], ...force, ...none,
    axes: ["f32", []], rotary: ["f32", []], changeAt: ["f32", []],
  });
}
