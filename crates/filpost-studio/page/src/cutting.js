// Stock cut by the program: what a setup file, the case or the machine gives, what is left, and what went wrong.
import { debounced, signal } from "./dom.js";
import { folderOf, isMesh, joined } from "./files.js";
import { MACHINE } from "./posting.js";

/** Longest program that is simulated by itself, characters. */
const MOST_CUT = 400_000;

const SETUP = "stock.toml";

const NONE = { name: null, isCase: false, own: {}, below: {}, keys: {}, meshes: [] };

export class Cutting {
  constructor(files, posting, ask) {
    Object.assign(this, { files, posting, ask });
    /** The answer to the last simulation; null where there is none. */
    this.report = null;
    /** Why it can't be simulated, in a sentence. */
    this.trouble = "";
    this.isRunning = false;
    this.asked = 0;
    this.changed = signal();
    /** What is cut: see `found`. */
    this.setup = NONE;
    this.later = debounced(500, () => this.run());
    posting.done.on(() => this.stale());
    files.changed.on((name, by) => by !== "save" && (name === this.file() || this.setup.meshes.includes(name)) && this.stale());
    files.listed.on(() => this.look());
  }

  /** The setup file of the part: next to it, or at the top. */
  file() {
    const beside = this.newFile();
    return this.files.has(beside) ? beside : this.files.has(SETUP) ? SETUP : null;
  }

  /** Where a new setup file goes. */
  newFile() {
    return joined(folderOf(this.posting.part ?? ""), SETUP);
  }

  get isLarge() {
    return (this.posting.answer?.nc?.length ?? 0) > MOST_CUT;
  }

  /** What was found belongs to another text now. */
  async stale() {
    this.report = null;
    this.trouble = "";
    this.asked += 1;
    await this.look();
    if (this.setup.keys.stock && this.posting.answer?.nc && !this.isLarge) this.later();
  }

  /** Reads the setup anew. */
  async look() {
    const looked = (this.looked = (this.looked ?? 0) + 1);
    const setup = await this.found().catch((error) => ({ ...NONE, name: this.file(), trouble: error.message }));
    if (looked !== this.looked) return;
    this.setup = setup;
    this.trouble = setup.trouble ?? this.trouble;
    this.changed.tell();
  }

  /**
   * As `filpost simulate` finds it: stock.toml next to the part, else `[simulate]` of its case, else stock.toml at the
   * top; below that `[simulate]` of the machine, key by key. `own` are the keys of the file `name`, `below` those of the
   * machine, `keys` all together, `meshes` the paths of the STL files.
   */
  async found() {
    const { recipe } = this.posting, beside = this.newFile();
    const isCase = !this.files.has(beside) && Boolean(recipe?.simulate);
    const name = isCase ? recipe.name : this.file();
    const own = isCase ? recipe.simulate : name ? await this.toml(name) : {};
    const machine = this.files.has(MACHINE) ? await this.toml(MACHINE).catch(() => ({})) : {};
    const below = machine.simulate ?? {};
    const paths = ({ stock, part }, file) => [stock, part].filter((each) => isMesh(each ?? "")).map((each) => joined(folderOf(file), each));
    return {
      name, isCase, own, below, keys: { ...below, ...own, tools: { ...below.tools, ...own.tools } },
      meshes: [...new Set([...paths(own, name ?? ""), ...paths(below, MACHINE)])].filter((each) => this.files.has(each)),
    };
  }

  /** The keys of a TOML file. */
  async toml(name) {
    const { case: keys, why } = await this.ask({ do: "case", text: await this.files.read(name) });
    if (!keys) throw new Error(`${name}: ${why}`);
    return keys;
  }

  /** The shapes of the tools that the setup gives, for the view: mm and degrees. Turning inserts have none. */
  async shapes() {
    const { keys: { tools = {} } } = await this.found().catch(() => NONE);
    return Object.entries(tools).map(([number, text]) => shapeOf(Number(number), String(text))).filter(Boolean);
  }

  /** Writes the setup file of the part anew. */
  write({ stock, part, grid, tools }) {
    const text = JSON.stringify;
    const lines = [
      stock ? `stock = ${text(stock)}` : null,
      part ? `part = ${text(part)}` : null,
      grid ? `grid = ${/^[\d.]+$/.test(grid) ? grid : text(grid)}` : null,
      "", "[tools]", ...Object.entries(tools).map(([number, size]) => `${number} = ${text(size)}`),
    ];
    this.files.set(this.file() ?? this.newFile(), `${lines.filter((line) => line !== null).join("\n")}\n`);
  }

  async run() {
    const nc = this.posting.answer?.nc, machine = this.posting.machine();
    const { name, isCase, keys, meshes } = this.setup;
    if (!keys.stock || nc === undefined || !machine) return;
    const number = ++this.asked, { part } = this.posting;
    this.isRunning = true;
    this.changed.tell();
    let report = null, trouble = "";
    try {
      const file = name && { name, text: await this.files.read(name) };
      const answer = await this.ask({
        do: "simulate", machine, ...this.posting.tuning(), nc, heights: true,
        setup: isCase ? null : file, case: isCase ? file : null,
        meshes: await Promise.all(meshes.map(async (each) => ({ name: each, text: await this.files.read(each) }))),
        cl: { name: part, text: this.files.text(part) },
      });
      if (answer.errors ?? answer.misuse) trouble = answer.misuse ?? answer.errors.map(({ code, message }) => `${code}: ${message}`).join("\n");
      else report = answer;
    } catch (error) {
      trouble = error.message;
    }
    if (number !== this.asked) return;
    Object.assign(this, { report, trouble, isRunning: false });
    this.changed.tell();
  }

  /** What was found, for the list of findings: each with its block, and the CL and FIL lines that made it. */
  findings() {
    return (this.report?.findings ?? []).map(({ code, severity, title, message, nc_line: line }) => {
      const origin = this.posting.origin(line);
      const made = origin ? [[this.posting.part, origin.cl], ...origin.fil] : [];
      return {
        source: "stock", severity, code, message: `${title}: ${message}`, hint: "", fixes: [], ncLine: line,
        file: this.posting.part, line: origin?.cl,
        places: [null, ...made.map(([file, at]) => ({ file, line: at, from: 0 }))],
      };
    });
  }
}

/** A tool as `D10 R0.5 A118 L50` describes it; null where it has no diameter. */
function shapeOf(number, text) {
  const unit = /in\s*$/i.test(text) ? 25.4 : 1;
  const value = (letter) => {
    const found = new RegExp(`${letter}\\s*([\\d.]+)`, "i").exec(text);
    return found ? Number(found[1]) : 0;
  };
  const point = value("A");
  if (!value("D")) return null;
  const holder = [...text.matchAll(/H\s*([\d.]+)\s*x\s*([\d.]+)/gi)].map(([, wide, long]) => [Number(wide) * unit, Number(long) * unit]);
  return {
    number, diameter: value("D") * unit, corner: value("R") * unit, bottom: point ? 90 - point / 2 : 0, length: value("L") * unit || null, holder,
  };
}

/** What is left of the stock as a body. */
export const bodyOf = (report) => (report.disks ? turned(report) : columns(report));

/** Sides of a turned body. */
const SIDES = 96;

/** Disks about Z, each from an inner to an outer radius; disks of one size in a row are one. */
function turned({ disks, from, step }) {
  const quads = [];
  const ring = (radius0, z0, radius1, z1) => {
    const [dr, dz] = [radius1 - radius0, z1 - z0], length = Math.hypot(dr, dz) || 1;
    for (let side = 0; side < SIDES; side++) {
      const [a, b, middle] = [side, side + 1, side + 0.5].map((at) => (2 * Math.PI * at) / SIDES);
      const point = (angle, radius, z) => [radius * Math.cos(angle), radius * Math.sin(angle), z];
      quads.push([
        (Math.cos(middle) * dz) / length, (Math.sin(middle) * dz) / length, -dr / length,
        ...point(a, radius0, z0), ...point(b, radius0, z0), ...point(b, radius1, z1), ...point(a, radius1, z1),
      ]);
    }
  };
  let before = [0, 0];
  for (let first = 0; first <= disks.length; ) {
    const [inner, outer] = disks[first] ?? [0, 0];
    let end = first + 1;
    while (end < disks.length && disks[end][0] === inner && disks[end][1] === outer) end += 1;
    const z = from + first * step, behind = from + end * step;
    const has = outer > inner, had = before[1] > before[0];
    // Between neighbours the surface goes straight on; where there is nothing beside, a face closes it.
    if (has && had) {
      ring(before[1], z, outer, z);
      if (inner || before[0]) ring(inner, z, before[0], z);
    } else if (has) ring(inner, z, outer, z);
    else if (had) ring(before[1], z, before[0], z);
    if (has) {
      ring(outer, z, outer, behind);
      if (inner) ring(inner, behind, inner, z);
    }
    before = [inner, outer];
    first = end;
  }
  return arraysOf(quads);
}

/**
 * The top of each column, and walls where neighbours differ. Columns of one height in a row are one surface.
 */
function columns({ grid: { origin, step, columns: count, rows }, heights, lowest }) {
  const quads = [];
  const at = (column, row) => {
    if (column < 0 || row < 0 || column >= count || row >= rows) return lowest;
    return heights[row * count + column];
  };
  const x = (column) => origin[0] + column * step[0], y = (row) => origin[1] + row * step[1];
  for (let row = 0; row < rows; row++) {
    for (let from = 0; from < count; ) {
      const top = at(from, row);
      let to = from + 1;
      while (to < count && at(to, row) === top) to += 1;
      if (top > lowest) {
        quads.push([0, 0, 1, x(from), y(row), top, x(to), y(row), top, x(to), y(row + 1), top, x(from), y(row + 1), top]);
      }
      const before = at(from - 1, row);
      if (before !== top) wall(quads, [before < top ? -1 : 1, 0], x(from), y(row), x(from), y(row + 1), before, top);
      from = to;
    }
    const last = at(count - 1, row);
    if (last > lowest) wall(quads, [1, 0], x(count), y(row), x(count), y(row + 1), lowest, last);
  }
  for (let row = 0; row <= rows; row++) {
    for (let from = 0; from < count; ) {
      const front = at(from, row - 1), back = at(from, row);
      let to = from + 1;
      while (to < count && at(to, row - 1) === front && at(to, row) === back) to += 1;
      if (front !== back) wall(quads, [0, front < back ? -1 : 1], x(from), y(row), x(to), y(row), front, back);
      from = to;
    }
  }
  return arraysOf(quads);
}

function wall(quads, [nx, ny], x0, y0, x1, y1, one, other) {
  // Its corners go around counterclockwise, seen from outside.
  if (nx * (y1 - y0) - ny * (x1 - x0) < 0) [x0, y0, x1, y1] = [x1, y1, x0, y0];
  const low = Math.min(one, other), high = Math.max(one, other);
  quads.push([nx, ny, 0, x0, y0, low, x1, y1, low, x1, y1, high, x0, y0, high]);
}

function arraysOf(quads) {
  const positions = new Float32Array(quads.length * 12), normals = new Float32Array(quads.length * 12);
  const indices = new Uint32Array(quads.length * 6);
  quads.forEach((quad, number) => {
    for (let corner = 0; corner < 4; corner++) {
      for (let axis = 0; axis < 3; axis++) {
        positions[12 * number + 3 * corner + axis] = quad[3 + 3 * corner + axis];
        normals[12 * number + 3 * corner + axis] = quad[axis];
      }
    }
    indices.set([0, 1, 2, 0, 2, 3].map((corner) => 4 * number + corner), 6 * number);
  });
  return { positions, normals, indices };
}
