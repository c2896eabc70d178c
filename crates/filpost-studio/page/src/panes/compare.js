// Our program beside a proven one: the expected of its case, or a file that is chosen.
import { by, counted, el } from "../dom.js";
import { isNc } from "../files.js";

export class Compare {
  constructor(files, posting, cases, ask, { openNc }) {
    this.files = files;
    this.posting = posting;
    this.cases = cases;
    this.ask = ask;
    this.openNc = openNc;
    this.other = null;
    by("against").addEventListener("change", () => this.run());
    posting.done.on(() => this.refresh());
    files.listed.on(() => this.refresh());
  }

  get isShown() {
    return !by("panel-compare").hidden;
  }

  /** Fills the list of programs, and compares where the pane is shown. */
  async refresh() {
    const part = this.posting.part;
    if (part !== this.part) {
      this.part = part;
      const of = part ? await this.cases.ofPart(part) : null;
      this.expected = of ? (await this.cases.expected(of))?.name ?? null : null;
      by("against").value = "";
    }
    const select = by("against");
    const before = select.value;
    const names = this.files.names().filter(isNc);
    select.replaceChildren(...names.map((name) => {
      return el("option", { value: name }, name === this.expected ? `${name} (expected of the case)` : name);
    }));
    select.value = names.includes(before) ? before : this.expected ?? names[0] ?? "";
    if (this.isShown) await this.run();
  }

  /** Compares our program with the one that is chosen. */
  async run() {
    const name = by("against").value;
    const said = by("compare-said");
    const list = by("differences");
    const nc = this.posting.answer?.nc;
    list.replaceChildren();
    this.other = null;
    if (!name || nc === undefined) {
      said.textContent = name ? "There is no program of ours." : "Add a proven program (.nc) to compare with.";
      return;
    }
    const text = await this.files.read(name);
    this.other = text;
    const answer = await this.ask({ do: "compare", machine: this.posting.machine(), ...this.posting.tuning(), nc, other: text }).catch((error) => ({ errors: [{ message: error.message }] }));
    if (this.posting.answer?.nc !== nc) return;
    if (answer.errors) {
      said.textContent = `They can't be compared: ${answer.errors[0].message}`;
      return;
    }
    const { differences } = answer;
    said.textContent = answer.equal ? "The programs say the same." : counted(differences.length, "difference");
    const theirs = text.replaceAll("\r\n", "\n").split("\n");
    list.replaceChildren(...differences.slice(0, 500).map(({ lines: [other, own], message }) => el(
      "li",
      {},
      el("button", { type: "button", class: "finding", onclick: () => own && this.openNc(own) }, message),
      other ? el("code", { class: "theirs" }, `− ${theirs[other - 1] ?? ""}`) : null,
      own ? el("code", { class: "ours" }, `+ ${this.posting.lines[own - 1] ?? ""}`) : null,
    )));
  }
}
