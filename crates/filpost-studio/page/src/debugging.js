// The debugger: where a run stops, and what there is to see there. The back end keeps no run: each step is
// asked for by the place before, and the same input does the same again.
import { signal } from "./dom.js";

/** Steps, as the back end calls them; `back` and `block back` go to places that the last answer has named. */
export const STEPS = ["run", "in", "over", "out", "record", "block", "back", "block back"];

/** How NC lines are named among the files with breakpoints. */
export const NC = "the NC program";

export class Debugging {
  constructor(files, posting, ask) {
    Object.assign(this, { files, posting, ask });
    /** Lines with breakpoints, by file. */
    this.lines = new Map();
    /** Conditions of lines, by `file:line`. */
    this.conditions = new Map();
    /** What else stops a run: `{name}`, such as `record CYCLE`, or `{watch}`. */
    this.others = [];
    /** Expressions whose values are shown. */
    this.watched = [];
    /** The last answer; null where nothing is debugged. */
    this.answer = null;
    this.isRunning = false;
    /** What the debugger can't do, in a sentence. */
    this.trouble = "";
    this.changed = signal();
    /** Breakpoints of lines are other ones: the file. */
    this.moved = signal();
    // Places belong to one input: another text has other ones.
    posting.done.on(() => this.answer && this.end("The post or the part has changed: start again."));
    files.listed.on(() => {
      for (const file of this.lines.keys()) if (file !== NC && !files.has(file)) this.lines.delete(file);
    });
  }

  get stopped() {
    return this.answer?.stopped ?? null;
  }

  linesOf(file) {
    return this.lines.get(file) ?? [];
  }

  /** Takes the lines of a file that have breakpoints. */
  setLines(file, lines) {
    if (lines.length) this.lines.set(file, lines);
    else this.lines.delete(file);
    for (const key of [...this.conditions.keys()]) {
      const [of, line] = split(key);
      if (of === file && !lines.includes(line)) this.conditions.delete(key);
    }
    this.changed.tell();
  }

  /** Takes a breakpoint away. */
  remove({ file, line, nc, name, watch }) {
    if (name ?? watch) this.others = this.others.filter((other) => other.name !== name || other.watch !== watch);
    else {
      const of = nc ? NC : file;
      this.setLines(of, this.linesOf(of).filter((each) => each !== (nc ?? line)));
      this.moved.tell(of);
    }
    this.changed.tell();
  }

  /** Adds what stops a run by its name, `record CYCLE`, or by a value that changes, `watch XX`. */
  add(text) {
    const watch = /^watch\s+(.+)$/i.exec(text)?.[1];
    this.others.push(watch ? { watch } : { name: text });
    this.changed.tell();
  }

  /** All breakpoints, as the back end takes them. */
  breakpoints() {
    const lines = [...this.lines].flatMap(([file, own]) => own.map((line) => {
      const condition = this.conditions.get(`${file}:${line}`);
      return { ...(file === NC ? { nc: line } : { file, line }), ...(condition ? { condition } : {}) };
    }));
    return [...lines, ...this.others];
  }

  setCondition({ file, line, nc }, condition) {
    this.conditions.set(`${nc ? NC : file}:${nc ?? line}`, condition);
  }

  /** Starts a run, or goes on. */
  async step(step) {
    if (this.isRunning) return;
    const stopped = this.stopped;
    const request = this.posting.request();
    if (!request) return this.end("There is no post or no part to run.");
    const back = { back: stopped?.back, "block back": stopped?.back_block }[step];
    if (back === null) return;
    const way = back ? { from: back, step: "here" } : { from: stopped?.here, step };
    this.isRunning = true;
    this.changed.tell();
    let answer, trouble = "";
    try {
      answer = await this.ask({ ...request, ...way, do: "debug", breakpoints: this.breakpoints(), watched: this.watched });
    } catch (error) {
      trouble = error.message;
    }
    this.isRunning = false;
    if (answer?.misuse ?? answer?.errors) trouble = answer.misuse ?? answer.errors[0].message;
    if (trouble) return this.end(trouble);
    this.answer = answer;
    this.trouble = "";
    this.changed.tell();
  }

  /** Shows the values again, with other expressions. */
  async look() {
    const here = this.stopped?.here;
    if (!here) return this.changed.tell();
    const answer = await this.ask({
      ...this.posting.request(), do: "debug", from: here, step: "here", breakpoints: [], watched: this.watched,
    }).catch(() => null);
    if (answer?.watched && this.stopped) this.answer.watched = answer.watched;
    this.changed.tell();
  }

  end(why = "") {
    this.answer = null;
    this.trouble = why;
    this.changed.tell();
  }
}

/** File and line of a key. */
function split(key) {
  const at = key.lastIndexOf(":");
  return [key.slice(0, at), Number(key.slice(at + 1))];
}
