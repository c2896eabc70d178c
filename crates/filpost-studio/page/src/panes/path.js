// The path of the program in three dimensions, over that of a second one. The view is loaded when its
// tab is opened for the first time.
import { bodyOf } from "../cutting.js";
import { tell } from "../dialogs.js";
import { by, el, signal } from "../dom.js";
import { isCl } from "../files.js";

/** Files that may be NC programs. */
const isProgram = (name) => /\.(nc|tap|cnc|mpf|spf|h|ngc|eia|min|iso|din|prg)$/i.test(name);

function load() {
  return new Promise((resolve, reject) => {
    const script = el("script", { src: "view.js" });
    script.addEventListener("load", () => resolve(globalThis.filpostView));
    script.addEventListener("error", () => reject(new Error("view.js can't be loaded")));
    document.head.append(script);
  });
}

export class PathPane {
  constructor(files, posting, cutting, ask) {
    Object.assign(this, { files, posting, cutting, ask });
    this.view = null;
    this.asked = 0;
    this.isStale = true;
    /** A motion was clicked: its line. */
    this.picked = signal();
    this.second = el("select", { id: "second", "aria-label": "Second program" });
    this.second.addEventListener("change", () => this.showSecond());
    posting.done.on(() => {
      this.isStale = true;
      if (this.isOpen) this.open();
    });
    files.listed.on(() => this.listSecond());
    cutting.changed.on(() => this.showStock());
    this.listSecond();
  }

  get isOpen() {
    return !by("panel-path").hidden;
  }

  /** Shows the program as it is now; the first time loads the view before. */
  async open() {
    try {
      await (this.ready ??= this.start());
      if (this.isStale) await this.show();
    } catch (error) {
      tell("The path can't be shown", error.message);
    }
  }

  async start() {
    const { createView, readProgram, bytesOf } = await load();
    this.read = (answer) => readProgram(bytesOf(answer.columns));
    this.view = createView(by("view"), {
      onPick: (line, of) => of === "program" && this.picked.tell(line),
      textOf: (line) => this.posting.lines[line - 1] ?? "",
      tools: [el("label", {}, "over ", this.second)],
    });
    await this.showSecond();
    this.showStock();
  }

  /** Shows what is left of the stock. */
  showStock() {
    const { report } = this.cutting;
    this.view?.setStock(report ? bodyOf(report) : null);
    if (report && !this.isStale) this.showTools();
  }

  /** The path of a text as the answer to a request for it; throws where there is none. */
  async columns(texts) {
    const machine = this.posting.machine();
    if (!machine) throw new Error("there is no machine");
    const { columns, errors, misuse } = await this.ask({ do: "columns", machine, ...this.posting.tuning(), ...texts });
    if (columns) return this.read({ columns });
    throw new Error(misuse ?? errors.map(({ code, message, places: [place] }) => `${place?.line ? `line ${place.line}: ` : ""}${code} ${message}`).join("\n"));
  }

  async show() {
    this.isStale = false;
    const { answer, part } = this.posting, number = ++this.asked;
    const cl = (part && this.files.text(part)) ?? "";
    const program = answer?.nc === undefined ? null : await this.columns({ nc: answer.nc, cl, cl_name: part }).catch(() => null);
    if (number !== this.asked) return;
    this.view.setProgram(program);
    await this.showTools();
  }

  /** Shows tools as the setup file of the stock gives them, in place of those of the CL file. */
  async showTools() {
    const shapes = await this.cutting.shapes();
    if (shapes.length) this.view?.setTools(shapes);
  }

  listSecond() {
    const chosen = this.second.value, names = this.files.names().filter((name) => isProgram(name) || isCl(name));
    this.second.replaceChildren(el("option", { value: "" }, "no second program"), ...names.map((name) => el("option", { value: name }, name)));
    if (names.includes(chosen)) this.second.value = chosen;
  }

  /** Lays the chosen program, or the path of a CL file, under the program. */
  async showSecond() {
    const name = this.second.value;
    let second = null;
    try {
      if (name) {
        await this.files.read(name);
        const text = this.files.text(name);
        second = await this.columns(isCl(name) ? { cl: text, cl_name: name } : { nc: text });
        second.title = name;
      }
    } catch (error) {
      this.second.value = "";
      tell(`${name} can't be shown`, error.message);
    }
    this.view?.setSecond(second);
  }

  /** Marks the motions of a line. */
  select(line) {
    if (this.isOpen && this.view) this.view.select(line);
  }
}
