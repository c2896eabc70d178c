// Posts the part anew after each change, and keeps the answer.
import { debounced, signal } from "./dom.js";
import { isFil } from "./files.js";

/** Longest CL text that is posted while somebody types, characters. */
const LARGE = 8_000_000;

/** Pause between a change and a run while changes follow each other, milliseconds. */
const PAUSE = 50;

/** A run that takes longer is shown as one, milliseconds. */
const LONG = 400;

export const MACHINE = "machine.toml";

export class Posting {
  constructor(files, backend) {
    this.files = files;
    this.watched = backend.watched;
    /** Name of the CL file. */
    this.part = null;
    /** What the case of the part says of posting: `fil` and `compat`, and keys of a request; null where it has no case. */
    this.recipe = null;
    /** Finds the recipe of a part. */
    this.recipeOf = async () => null;
    this.answer = null;
    /** The lines of the program; another list only where they are other ones. */
    this.lines = [];
    /** Which lines the last answer changed: those of `before`, and behind `line` of them `gone` ones went and `made` came. Null where that is not known. */
    this.change = null;
    this.origins = originsOf([]);
    this.isRunning = false;
    /** How much of the CL file the run has read, 0 to 1; null where that is not known. */
    this.share = null;
    /** The last run was stopped: the program is still that of the one before. */
    this.isStopped = false;
    this.asked = 0;
    this.done = signal();
    /** A run takes long, has come farther, or was stopped. */
    this.moved = signal();
    /** A change waits to be posted. */
    this.isPending = false;
    this.idlers = [];
    let last = 0;
    const later = debounced(PAUSE, () => this.isPending && this.run());
    // A first change is posted at once, when whoever made it is done.
    const now = debounced(0, () => this.isPending && this.run());
    files.changed.on((name, by) => {
      if (by === "save" || !this.reads(name)) return;
      if (this.isLarge()) return this.done.tell();
      const since = performance.now() - last;
      last += since;
      const isFirst = since > 2 * PAUSE && !this.isPending && !this.isRunning;
      this.isPending = true;
      if (isFirst) now();
      else later();
    });
  }

  /** Waits until the program is that of the texts: other questions about a long text come behind it. */
  idle() {
    return this.isPending || this.isRunning ? new Promise((resolve) => this.idlers.push(resolve)) : Promise.resolve();
  }

  /** A run has ended. */
  rest() {
    this.isRunning = false;
    if (!this.isPending) this.idlers.splice(0).forEach((resolve) => resolve());
  }

  /** True when the program depends on a file. */
  reads(name) {
    return name === MACHINE || name === this.part || name === this.recipe?.compat || name.endsWith("case.toml") || (isFil(name) && !name.startsWith("cases/"));
  }

  isLarge() {
    return (this.files.text(this.part)?.length ?? 0) > LARGE;
  }

  choose(part) {
    this.part = part;
    return this.run();
  }

  /** The FIL files of the post: those of the part's case, or post.fil, or all in the folder itself; and what they may include. */
  scripts() {
    const known = this.files.names().filter((name) => isFil(name) && this.files.text(name) !== null);
    const own = known.filter((name) => !name.includes("/") && /\.fil$/i.test(name));
    const ofCase = this.recipe?.fil?.filter((name) => known.includes(name));
    const fil = ofCase ?? (own.includes("post.fil") ? ["post.fil"] : own);
    const file = (name) => ({ name, text: this.files.text(name) });
    const includes = known.filter((name) => !fil.includes(name) && !name.startsWith("cases/"));
    return { fil: fil.map(file), includes: includes.map(file) };
  }

  /** The machine as a request names it; null where the folder has none. */
  machine() {
    const text = this.files.text(MACHINE);
    return text === null ? null : { name: MACHINE, text };
  }

  /** What the case of the part sets on the machine. */
  tuning() {
    const { set, options } = this.recipe?.keys ?? {};
    return { set, options };
  }

  request() {
    const machine = this.machine();
    const cl = this.part && this.files.text(this.part);
    if (!machine || cl === null || cl === undefined) return null;
    const { keys, compat: name } = this.recipe ?? {}, text = name ? this.files.text(name) : null;
    const compat = text === null ? null : { name, text };
    return { do: "post", machine, cl, cl_name: this.part, ...this.scripts(), ...keys, ...(compat && { compat }) };
  }

  async run() {
    this.isPending = false;
    if (this.part && this.files.has(this.part)) await this.files.read(this.part);
    const number = ++this.asked;
    this.recipe = this.part ? await this.recipeOf(this.part) : null;
    const request = this.request();
    if (number !== this.asked) return;
    if (!request) return this.take(null, 0);
    this.work?.supersede();
    const begun = performance.now();
    const work = this.watched(request, (share) => this.tell(number, share), this.isLarge());
    Object.assign(this, { work, isRunning: true, isStopped: false, share: null });
    setTimeout(() => this.tell(number, this.share), LONG);
    const answer = await work.answer.catch((error) => ({ failure: error.message }));
    // A later run has been asked for: its answer is the one that counts.
    if (number !== this.asked) return;
    this.work = null;
    if (!this.isStopped) return this.take(answer, performance.now() - begun);
    this.rest();
    this.moved.tell();
  }

  tell(number, share) {
    if (number !== this.asked || !this.isRunning) return;
    this.share = share;
    this.moved.tell();
  }

  /** Stops the run. */
  stop() {
    if (!this.work) return;
    this.isStopped = true;
    this.work.stop();
  }

  take(answer, time) {
    this.takeLines(answer);
    this.answer = answer;
    this.time = time;
    this.origins = originsOf(answer?.origins ?? []);
    this.made = null;
    this.rest();
    this.done.tell();
  }

  takeLines(answer) {
    const { nc = "", change } = answer ?? {}, before = this.lines;
    this.change = null;
    if (!change || change.of !== this.answer?.nc) {
      if (nc !== this.answer?.nc) this.lines = linesOf(nc);
      return;
    }
    const gone = Math.min(change.gone, before.length - change.line), made = linesOf(change.text);
    // Whole lines end where the next one begins.
    if (change.line + gone < before.length) made.pop();
    if (!gone && !made.length) return;
    this.lines = before.slice(0, change.line).concat(made, before.slice(change.line + gone));
    this.change = { before, line: change.line, gone, made };
  }

  /** What made a line of the program: `{cl, record, fil: [[file, line]]}`; null for none. */
  origin(line) {
    const { cl, record, fil } = this.origins, at = line - 1;
    return at in cl ? { cl: cl[at], record: record[at], fil: fil.get(at) ?? [] } : null;
  }

  /** The lines of the program that a line of a file made. */
  madeBy(name, line) {
    this.made ??= this.index();
    return this.made.get(`${name}:${line}`) ?? [];
  }

  index() {
    const made = new Map();
    const add = (key, line) => {
      const lines = made.get(key);
      if (!lines) made.set(key, [line]);
      else if (lines.at(-1) !== line) lines.push(line);
    };
    const { cl, fil } = this.origins;
    cl.forEach((line, at) => add(`${this.part}:${line}`, at + 1));
    for (const [at, stack] of fil) for (const [file, line] of stack) add(`${file}:${line}`, at + 1);
    return made;
  }
}

const linesOf = (text) => text.replaceAll("\r\n", "\n").split("\n");

/** What made each line, as an answer says it: CL lines, records, and the FIL lines of those that have some. */
function originsOf(said) {
  const length = said.reduce((sum, origin) => sum + (typeof origin === "number" ? origin : 1), 0);
  const cl = new Uint32Array(length), record = new Uint32Array(length), fil = new Map();
  let at = 0;
  for (const origin of said) {
    if (typeof origin === "number") {
      // A row of lines, each of the next record on the next line.
      for (const end = at + origin; at < end; at++) [cl[at], record[at]] = [(cl[at - 1] ?? 0) + 1, (record[at - 1] ?? 0) + 1];
      continue;
    }
    [cl[at], record[at]] = origin;
    if (origin[2].length) fil.set(at, origin[2]);
    at += 1;
  }
  return { cl, record, fil };
}
