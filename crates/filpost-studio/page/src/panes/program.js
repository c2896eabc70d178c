// The NC program, and what made the block that is pointed at.
import { by, el, signal } from "../dom.js";
import { goTo, markLines, reader, setText } from "../editors.js";

export class Program {
  constructor(files, posting, { open }) {
    this.files = files;
    this.posting = posting;
    this.open = open;
    /** The cursor is in a line of the program. */
    this.pointed = signal();
    this.view = reader(by("nc"), {
      label: "NC program", kind: "nc",
      origin: (line) => this.told(line),
      pointed: (line) => this.point(line),
    });
    posting.done.on(() => this.show());
  }

  show() {
    setText(this.view, this.posting.lines.join("\n"));
    by("cause").replaceChildren(this.posting.answer?.nc
      ? el("p", { class: "quiet" }, "Click a block to see the CL record and the FIL lines that made it.")
      : "");
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
    markLines(this.view, [], false);
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
    this.pointed.tell(line, places);
  }

  /** Shows a line of the program. */
  goTo(line) {
    goTo(this.view, line);
  }

  /** Marks the blocks of a line of a CL or FIL file. */
  markMadeBy(name, line) {
    markLines(this.view, this.posting.madeBy(name, line));
  }
}
