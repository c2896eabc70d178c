// The NC program, and what made the block that is pointed at.
import { by, counted, el, signal } from "../dom.js";
import { NC } from "../debugging.js";
import { goTo, markLines, reader, setText, showFresh, showStanding, showStops } from "../editors.js";

export class Program {
  constructor(files, posting, debugging, { open }) {
    Object.assign(this, { files, posting, open });
    /** The cursor is in a line of the program. */
    this.pointed = signal();
    this.view = reader(by("nc"), {
      label: "NC program", kind: "nc",
      origin: (line) => this.told(line),
      pointed: (line) => this.point(line),
      stopped: (lines) => debugging.setLines(NC, lines),
    });
    debugging.moved.on((file) => file === NC && showStops(this.view, debugging.linesOf(NC)));
    posting.done.on(() => this.show());
  }

  show() {
    const { answer, part, lines } = this.posting;
    const text = lines.join("\n");
    if (answer?.nc && this.last?.part === part && this.view.state.doc.toString() === text) {
      // The same program again: the block that is pointed at stays, what made it may stand elsewhere.
      if (this.line) this.showCause(this.line);
      return;
    }
    this.line = null;
    markLines(this.view, [], false);
    setText(this.view, text);
    if (!answer?.nc) {
      showFresh(this.view, []);
      by("cause").replaceChildren();
      return;
    }
    // What a change touches is compared with the last program of the same part.
    const before = this.last?.part === part ? this.last.lines : lines;
    const { made, gone } = changedLines(before, lines);
    if (made.length || gone) this.touched = { made, gone };
    showFresh(this.view, this.last?.part === part ? this.touched?.made ?? [] : []);
    if (this.last?.part !== part) this.touched = null;
    this.last = { part, lines };
    by("cause").replaceChildren(el("p", { class: "quiet" }, this.touched
      ? `The last change: ${counted(this.touched.made.length, "line")} new or other (green)${this.touched.gone ? `, ${this.touched.gone} gone` : ""}.`
      : "Click a block to see the CL record and the FIL lines that made it."));
  }

  /** The places that made a line: `[file, line]` of each. */
  places(line) {
    const origin = this.posting.origin(line);
    return origin ? [[this.posting.part, origin.cl], ...origin.fil] : [];
  }

  text([name, line]) {
    const lines = this.files.text(name)?.split("\n") ?? [];
    return `${name}:${line}  ${(lines[line - 1] ?? "").trim()}`;
  }

  told(line) {
    return this.places(line).map((place) => this.text(place)).join("\n");
  }

  point(line) {
    this.line = line;
    markLines(this.view, [], false);
    this.showCause(line);
    this.pointed.tell(line, this.places(line));
  }

  showCause(line) {
    const places = this.places(line);
    const record = this.posting.origin(line)?.record;
    by("cause").replaceChildren(...places.map(([name, at], index) => {
      const text = (this.files.text(name)?.split("\n")[at - 1] ?? "").trim();
      return el(
        "button",
        { type: "button", onclick: () => this.open(name, at) },
        el("b", {}, `${name}:${at}`),
        index === 0 && record ? el("span", { class: "quiet" }, ` record ${record}`) : "",
        el("code", {}, text),
      );
    }));
  }

  /** Shows a line of the program. */
  goTo(line) {
    goTo(this.view, line);
  }

  /** Marks lines, and shows the first. */
  mark(lines) {
    markLines(this.view, lines);
  }

  /** Shows the last block that a run has written; null for none. */
  stand(line) {
    showStanding(this.view, line);
    if (line) goTo(this.view, line);
  }

  /** Marks the blocks of a line of a CL or FIL file. */
  markMadeBy(name, line) {
    markLines(this.view, this.posting.madeBy(name, line));
  }
}

/** Lines of a program that an earlier one lacks, by their places, and how many it has more. */
export function changedLines(before, after) {
  let from = 0;
  const shorter = Math.min(before.length, after.length);
  while (from < shorter && before[from] === after[from]) from += 1;
  let end = 0;
  while (end < shorter - from && before.at(-1 - end) === after.at(-1 - end)) end += 1;
  const old = before.slice(from, before.length - end);
  const left = new Map();
  for (const line of old) left.set(line, (left.get(line) ?? 0) + 1);
  const made = [];
  for (let at = from; at < after.length - end; at++) {
    const count = left.get(after[at]) ?? 0;
    if (count) left.set(after[at], count - 1);
    else made.push(at + 1);
  }
  const kept = after.length - end - from - made.length;
  return { made, gone: Math.max(0, old.length - kept - made.length) };
}
