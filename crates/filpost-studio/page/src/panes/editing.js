// The open files, each in a tab with an editor of its own.
import { showBeside } from "../beside.js";
import { by, debounced, el, prose, signal } from "../dom.js";
import { editor, goTo, markdown, markLines, position, setText, showFindings, showMissed, showStanding, showStops } from "../editors.js";
import { baseOf, isCl, isFil, kindOf } from "../files.js";
import { MACHINE } from "../posting.js";

const LANGUAGES = { cl: "cl", fil: "fil", machine: "machine" };

export class Editing {
  constructor(files, posting, debugging, ask) {
    Object.assign(this, { files, posting, debugging, ask });
    /** By name: `{name, tab, box, view}`. */
    this.open = new Map();
    this.current = null;
    /** Number of the last time that the word at the cursor was asked for. */
    this.told = 0;
    /** Lines that no case has run, by file. */
    this.missed = new Map();
    /** The cursor is in a line: file and line. */
    this.pointed = signal();
    this.chosen = signal();
    const lookBeside = debounced(300, () => this.showBeside());
    this.chosen.on(lookBeside);
    files.changed.on((name) => (isFil(name) || name === MACHINE) && lookBeside());
    this.tellWord = debounced(120, (name) => this.showWord(name));
    by("open-tabs").addEventListener("keydown", (event) => this.key(event));
    files.changed.on((name, who) => this.follow(name, who));
    debugging.moved.on((name) => this.showStops(name));
    files.listed.on(() => {
      for (const name of this.open.keys()) if (!files.has(name) && this.open.get(name).view) this.close(name);
    });
  }

  /** A pane that is no file, such as the form of the machine. */
  addPane(id, title, box) {
    this.add(id, title, box, null, false);
  }

  add(name, title, box, view, closes) {
    const number = this.open.size + Math.random().toString(36).slice(2);
    box.id = `editor-${number}`;
    const tab = el("button", {
      type: "button", role: "tab", id: `open-${number}`, title: name, tabIndex: -1,
      "aria-controls": box.id, onclick: () => this.show(name),
    }, title);
    box.setAttribute("role", "tabpanel");
    box.setAttribute("aria-labelledby", tab.id);
    box.hidden = true;
    const holder = el("span", { class: "tab", role: "presentation" }, tab);
    if (closes) {
      // For the pointer alone: the key Delete closes the tab.
      holder.append(el("button", {
        type: "button", class: "close", "aria-hidden": "true", title: "Close (Delete)", tabIndex: -1,
        onclick: () => this.close(name),
      }, "×"));
    }
    by("open-tabs").append(holder);
    by("editors").append(box);
    this.open.set(name, { name, tab, holder, box, view });
  }

  /** Opens a file, or shows it where it is open, at a line where one is given. */
  async show(name, line = null, units = 0) {
    if (!this.open.has(name)) {
      const text = await this.files.read(name);
      if (!this.open.has(name)) this.addFile(name, text);
    }
    for (const file of this.open.values()) {
      const is = file.name === name;
      file.box.hidden = !is;
      file.tab.setAttribute("aria-selected", String(is));
      file.tab.tabIndex = is ? 0 : -1;
    }
    this.current = name;
    const { view, tab } = this.open.get(name);
    tab.scrollIntoView({ block: "nearest", inline: "nearest" });
    by("word").hidden = !view;
    if (!view) by("word").replaceChildren();
    if (view) {
      // An editor that was hidden does not know its size.
      view.requestMeasure();
      if (line !== null) {
        goTo(view, line, units);
        view.focus();
      }
      this.tellWord(name);
    }
    this.chosen.tell(name);
  }

  addFile(name, text) {
    const kind = kindOf(name);
    const language = LANGUAGES[kind];
    const box = el("div", { class: "editor" });
    const asked = language && ((edited) => this.asked(language, name, edited));
    const view = editor(box, {
      name, text, kind, ask: this.ask, file: asked,
      changed: (edited) => {
        this.files.set(name, edited, view);
        this.tellWord(name);
      },
      pointed: (line) => {
        this.pointed.tell(name, line);
        this.tellWord(name);
      },
      stopped: (isCl(name) || isFil(name)) && ((lines) => this.debugging.setLines(name, lines)),
    });
    this.add(name, baseOf(name), box, view, true);
    this.label(name);
    this.showStops(name);
    if (this.missed.has(name)) showMissed(view, this.missed.get(name));
  }

  /** The language that a file is asked about; nothing for other texts. */
  languageOf(name) {
    return name ? LANGUAGES[kindOf(name)] : undefined;
  }

  /** The place of the cursor, as requests name it: the file, its text and the position. */
  place() {
    const { name, view } = this.open.get(this.current);
    const { doc, selection } = view.state;
    return { name, text: doc.toString(), position: position(doc, selection.main.head) };
  }

  /** The word at the cursor; null for none. */
  word() {
    const { state } = this.open.get(this.current).view;
    const word = state.wordAt(state.selection.main.head);
    return word && state.sliceDoc(word.from, word.to);
  }

  /** What is selected in the file that is shown, else the word at the cursor; null for none. */
  selected() {
    const { state } = this.open.get(this.current)?.view ?? {};
    const { from, to } = state?.selection.main ?? {};
    return from === to ? state && this.word() : state.doc.lineAt(from).to >= to ? state.sliceDoc(from, to) : null;
  }

  /** A text as requests of the language tools name it. */
  asked(language, name, text) {
    if (language !== "fil") return { language, name, text };
    const { fil, includes } = this.posting.scripts();
    const others = [...fil, ...includes].filter((file) => file.name !== name);
    return { language, name, text, machine: this.files.text(MACHINE) ?? undefined, includes: others };
  }

  close(name) {
    const file = this.open.get(name);
    file.view?.destroy();
    file.box.remove();
    file.holder.remove();
    this.open.delete(name);
    if (this.current === name) {
      const last = [...this.open.keys()].at(-1);
      if (last) this.show(last);
    }
  }

  follow(name, who) {
    const file = this.open.get(name);
    if (!file?.view) return;
    if (who !== file.view && who !== "save") {
      setText(file.view, this.files.text(name));
      if (name === this.current) this.tellWord(name);
    }
    this.label(name);
  }

  label(name) {
    const { tab } = this.open.get(name);
    tab.textContent = baseOf(name);
    tab.classList.toggle("dirty", this.files.isDirty(name));
  }

  /** Marks findings in the editors that are open. */
  showFindings(findings) {
    for (const { name, view } of this.open.values()) {
      if (view) showFindings(view, findings.filter(({ file, line }) => file === name && line));
    }
  }

  /** Marks lines of files: `[name, line]` of each. */
  mark(places) {
    for (const { name, view } of this.open.values()) {
      if (view) markLines(view, places.filter(([file]) => file === name).map(([, line]) => line));
    }
  }

  /** Shows the breakpoints of a file where it is open. */
  showStops(name) {
    const { view } = this.open.get(name) ?? {};
    if (view && this.debugging.linesOf(name).length + view.dom.querySelectorAll(".stop").length) showStops(view, this.debugging.linesOf(name));
  }

  /** Shows which lines of scripts no case has run. */
  showCovered(covered) {
    this.missed = new Map(covered.map(({ name, lines }) => [name, lines.filter(([, count]) => !count).map(([line]) => line)]));
    for (const { name, view } of this.open.values()) if (view && isFil(name)) showMissed(view, this.missed.get(name) ?? []);
  }

  /** Shows where a run stands, `[name, line]` of each file. */
  stand(places) {
    for (const { name, view } of this.open.values()) {
      if (view && (isCl(name) || isFil(name))) showStanding(view, places.find(([file]) => file === name)?.[1] ?? null);
    }
  }

  /** Tells what stands at the cursor: the record with its word numbers, or the FIL word. */
  async showWord(name) {
    const { view } = this.open.get(name) ?? {};
    const language = LANGUAGES[kindOf(name)];
    const box = by("word"), number = ++this.told;
    if (!view || name !== this.current) return;
    if (!language || !(isCl(name) || isFil(name) || name === MACHINE)) {
      box.replaceChildren();
      return;
    }
    await this.posting.idle();
    if (number !== this.told) return;
    const { doc, selection } = view.state, place = position(doc, selection.main.head);
    const text = isCl(name) ? doc.sliceString(0, statementEnd(doc, place.line + 1)) : doc.toString();
    const request = { do: "hover", ...this.asked(language, name, text), ...place };
    const answer = await this.ask(request).catch(() => null);
    const call = isFil(name) ? await this.ask({ ...request, do: "signature" }).catch(() => null) : null;
    // The cursor may be elsewhere by now.
    if (number !== this.told) return;
    box.replaceChildren(...[call?.label ? callShown(call) : null, answer?.markdown ? markdown(answer.markdown) : null].filter(Boolean));
  }

  /** Shows hints and folds of the script that is shown. */
  async showBeside() {
    const name = this.current, { view } = this.open.get(name) ?? {};
    if (!view || !isFil(name)) return;
    const { doc } = view.state;
    const found = await this.ask({ do: "beside", ...this.asked("fil", name, doc.toString()) }).catch(() => null);
    if (found?.hints && view.state.doc === doc) showBeside(view, found);
  }

  key(event) {
    if (event.key === "Delete" && this.open.get(this.current)?.view) {
      this.close(this.current);
      this.open.get(this.current)?.tab.focus();
      return;
    }
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const names = [...this.open.keys()];
    const next = names[(names.indexOf(this.current) + step + names.length) % names.length];
    this.show(next).then(() => this.open.get(next).tab.focus());
  }
}

/** Where the statement of a line ends, which may go on in the next ones. */
function statementEnd(doc, line) {
  while (line < doc.lines && /[^$]\$\s*$/.test(doc.line(line).text)) line += 1;
  return doc.line(line).to;
}

/** The call that is written, with the argument that is next. */
function callShown({ label, doc, parameters, active }) {
  const next = parameters[active] ?? "", at = next ? label.indexOf(next, label.search(/[(/]/) + 1) : -1;
  const form = at < 0 ? [label] : [label.slice(0, at), el("b", {}, next), label.slice(at + next.length)];
  return el("div", { class: "hover" }, el("p", {}, el("code", { class: "call" }, ...form)), doc ? el("p", { class: "quiet" }, ...prose(doc)) : null);
}
