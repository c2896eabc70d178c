// The NC program, and what made the block that is pointed at.
import { by, counted, debounced, el, signal } from "../dom.js";
import { NC } from "../debugging.js";
import { goTo, markLines, reader, setLines, setText, showFresh, showStanding, showStops } from "../editors.js";

export class Program {
  constructor(files, posting, debugging, ask, { open }) {
    Object.assign(this, { files, posting, ask, open });
    /** The words of the block that is pointed at, with what is behind each; and the letter of the block that is. */
    this.words = [];
    this.letter = 0;
    this.lookBehind = debounced(100, () => this.readWords());
    /** The cursor is in a line of the program. */
    this.pointed = signal();
    this.view = reader(by("nc"), {
      label: "NC program", kind: "nc",
      origin: (line) => this.told(line),
      pointed: (line, at) => this.point(line, at - this.view.state.doc.line(line).from),
      stopped: (lines) => debugging.setLines(NC, lines),
    });
    debugging.moved.on((file) => file === NC && showStops(this.view, debugging.linesOf(NC)));
    posting.done.on(() => this.show());
  }

  show() {
    const { answer, part, lines, change } = this.posting;
    if (answer?.nc && this.last?.part === part && this.shown === lines) {
      // The same program again: the block that is pointed at stays, what made it may stand elsewhere.
      this.words = [];
      if (this.line) this.point(this.line, this.letter);
      return;
    }
    this.line = null;
    this.words = [];
    by("words").replaceChildren();
    markLines(this.view, [], false);
    if (change && change.before === this.shown) setLines(this.view, change);
    else setText(this.view, lines.join("\n"));
    this.shown = lines;
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

  point(line, letter) {
    if (line !== this.line) this.words = [];
    Object.assign(this, { line, letter });
    markLines(this.view, [], false);
    this.showCause();
    this.lookBehind();
  }

  /** Asks what is behind each word of the block that is pointed at. */
  async readWords() {
    const { line, posting } = this, request = posting.request();
    if (this.words.length || !line || !request || posting.isLarge() || !posting.answer?.nc) return;
    const { answer } = posting, said = await this.ask({ ...request, do: "behind", nc_line: line }).catch(() => null);
    if (this.line !== line || posting.answer !== answer) return;
    this.words = said?.words ?? [];
    this.showCause();
  }

  /** Shows what made the block that is pointed at, and the word of it. */
  showCause() {
    const { line, words } = this, { part } = this.posting;
    // The number of a block is due to nothing of its own: with it the block is meant.
    const here = words.find(({ from, to, text }) => this.letter >= from && this.letter < to && !/^N?\d+$/.test(text));
    by("words").replaceChildren(...words.map((word) => el("button", {
      type: "button", "aria-pressed": String(word === here), onclick: () => this.point(line, word.from),
    }, word.text || "-")));
    const byMachine = here && !here.record && !here.fil.length;
    const places = here ? [...(here.line ? [[part, here.line]] : []), ...here.fil] : this.places(line);
    const record = here?.record ?? this.posting.origin(line)?.record;
    // A word of a record counts as POSTF(7,n) does.
    const of = record ? ` record ${record}${here?.word && !here.by_fil ? `, word ${here.word}` : ""}` : "";
    by("cause").replaceChildren(
      ...(byMachine ? [el("p", { class: "quiet" }, `${here.text} comes from the settings of the machine.`)] : []),
      ...places.map(([name, at], index) => {
        const text = (this.files.text(name)?.split("\n")[at - 1] ?? "").trim();
        return el(
          "button",
          { type: "button", onclick: () => this.open(name, at) },
          el("b", {}, `${name}:${at}`),
          index === 0 && of ? el("span", { class: "quiet" }, of) : "",
          el("code", {}, text),
        );
      }),
    );
    this.pointed.tell(line, places);
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
