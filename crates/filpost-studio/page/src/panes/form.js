// The machine as a form: each setting with its text, its default, its choices, and what differs from the base.
import { by, counted, debounced, el } from "../dom.js";
import { MACHINE } from "../posting.js";
import { changedLines } from "./program.js";
import { COMMON, SECTIONS } from "./settings.js";

/** What the list shows. */
const VIEWS = [
  ["common", "What shops change"],
  ["own", "Set here"],
  ["differs", "Differs from the default machine"],
  ["acting", "All that act"],
  ["all", "All, also those without effect"],
];

/** Most other values that are tried. */
const MOST_TRIED = 4;

export class Form {
  constructor(files, posting, ask, { open, openForm, showLines }) {
    Object.assign(this, { openForm, showLines });
    this.files = files;
    this.posting = posting;
    this.ask = ask;
    this.openText = open;
    this.box = el("div", { class: "form" });
    this.problem = el("p", { class: "problem", role: "alert", hidden: true });
    this.find = el("input", { type: "search", placeholder: "coolant, G43, seqno …", "aria-label": "Find a setting", oninput: debounced(120, () => this.show()) });
    this.view = el("select", { "aria-label": "Which settings", onchange: () => this.show() },
      ...VIEWS.map(([value, title]) => el("option", { value }, title)));
    this.base = el("select", { "aria-label": "Base", onchange: () => this.set("base", JSON.stringify(this.base.value)) });
    this.list = el("div", { class: "settings" });
    this.box.append(
      el("div", { class: "form-head" }, el("label", {}, "Base ", this.base), this.find, this.view),
      this.problem,
      this.list,
    );
    this.made = null;
    /** Why the last value was not taken, in a sentence; empty where it was. */
    this.refused = "";
    /** The setting whose lines were looked for last, and what was found. */
    this.touched = {};
    const later = debounced(200, () => this.load());
    files.changed.on((name, by) => {
      if (by === "save") return;
      this.touched = {};
      if (name === MACHINE || name.endsWith(".fil")) later();
    });
    files.listed.on(later);
  }

  /** Reads the settings anew. */
  async load() {
    const text = this.files.text(MACHINE);
    if (text === null) {
      // The settings of a machine that is gone are not to be changed.
      this.made = null;
      this.list.replaceChildren();
      return;
    }
    this.ready ??= await this.ask({ do: "ready" });
    const answer = await this.ask({ do: "form", text, fil: this.posting.scripts().fil });
    if (text !== this.files.text(MACHINE)) return;
    const wrong = answer.errors?.[0];
    this.say(wrong ? `The text of ${MACHINE} can't be read: ${wrong.message}` : this.refused);
    this.box.classList.toggle("stale", Boolean(wrong));
    if (wrong) return;
    this.made = answer;
    this.show();
  }

  /** Says what is wrong; an empty text for nothing. */
  say(text) {
    this.problem.hidden = !text;
    this.problem.textContent = text;
  }

  show() {
    if (!this.made) return;
    // What somebody is typing is not taken away: the list is made anew when that is done.
    const typing = document.activeElement;
    if (this.list.contains(typing) && typing.dataset.shown !== undefined && typing.dataset.shown !== typing.value) {
      // Not within the event: it also comes while an element is taken out.
      typing.onblur = () => setTimeout(() => this.show());
      return;
    }
    const { base, settings, options, blocks } = this.made;
    const names = this.ready.map(({ name }) => name);
    this.base.replaceChildren(
      ...(names.includes(base) ? [] : [el("option", { value: base ?? "" }, base ?? "none: the default machine")]),
      ...names.map((name) => el("option", { value: name }, name)),
    );
    this.base.value = base ?? "";
    const groups = new Map();
    if (options.length) groups.set("options", []);
    for (const name of SECTIONS.keys()) groups.set(name, []);
    const add = (group, row) => groups.has(group) ? groups.get(group).push(row) : groups.set(group, [row]);
    for (const option of options.filter((each) => this.wantsOption(each))) add("options", this.optionRow(option));
    for (const setting of settings.filter((each) => this.wants(each))) add(setting.key.split(".")[0], this.settingRow(setting));
    for (const list of blocks.filter((each) => this.wantsBlocks(each))) add("blocks", this.blocksRow(list));
    const keepsFocus = focusIn(this.list);
    this.list.replaceChildren(...[...groups].filter(([, rows]) => rows.length).map(([group, rows]) => {
      const title = { options: "Options of the post", blocks: "Blocks of your own" }[group] ?? SECTIONS.get(group) ?? group;
      return el("section", {}, el("h3", {}, title), ...rows);
    }));
    if (!this.list.childElementCount) this.list.append(el("p", { class: "quiet" }, "No setting is like that."));
    keepsFocus();
  }

  /** Shows a setting in the form, whatever the list shows now. */
  async showSetting(key) {
    await this.openForm();
    this.find.value = key;
    this.view.value = "all";
    this.show();
    by(`set-${key}`)?.focus();
  }

  /** True for a text that has all words that are looked for. */
  matches(text) {
    const words = this.find.value.toLowerCase().split(/\s+/).filter(Boolean);
    return words.every((word) => text.toLowerCase().includes(word));
  }

  wants(setting) {
    const { key, meaning, own, acts, value, choices } = setting;
    if (!this.matches(`${key} ${meaning} ${choices.map(([, text]) => text).join(" ")} ${SECTIONS.get(key.split(".")[0]) ?? ""}`)) return false;
    const isOwn = own !== null;
    switch (this.view.value) {
      case "own": return isOwn;
      case "differs": return acts && value !== setting.default;
      case "acting": return acts || isOwn;
      case "all": return true;
      default: return isOwn || (acts && (COMMON.has(key) || this.find.value.trim() !== ""));
    }
  }

  wantsOption({ name, help, own }) {
    return this.matches(`${name} ${help} options`) && (this.view.value !== "own" || own !== null);
  }

  wantsBlocks({ key, own, value }) {
    if (!this.matches(`${key} blocks of your own`)) return false;
    return { own: own !== null, differs: value.length > 0, common: own !== null || value.length > 0 || this.find.value.trim() !== "" }[this.view.value] ?? true;
  }

  row(key, { label, help, control, isOwn, notes, quiet, others }) {
    const id = `set-${key}`;
    control.id = id;
    const keep = () => (control.dataset.shown = control.value);
    keep();
    control.addEventListener("change", keep);
    const said = el("span", { "aria-live": "polite", id: `touched-${key}` }, this.touched.key === key ? this.touched.text : null);
    return el(
      "div",
      { class: `setting${isOwn ? " own" : ""}${quiet ? " idle" : ""}` },
      el("label", { for: id }, el("code", {}, label), el("span", {}, help)),
      el("span", { class: "control" }, control, isOwn
        ? el("button", { type: "button", class: "reset", title: `Take ${label} out of machine.toml`, "aria-label": `Reset ${label}`, onclick: () => this.set(key, null) }, "↺")
        : null, quiet ? null : el("button", {
        type: "button", class: "touches", title: "Mark the lines of the program that depend on it", "aria-label": `Lines of ${label}`,
        onclick: () => this.touch(key, others),
      }, "≡")),
      el("span", { class: "notes" }, ...notes.filter(Boolean).map((note) => el("span", {}, note)), said),
    );
  }

  /** Finds the lines of the program that depend on a setting: those that are otherwise with another value. */
  async touch(key, others) {
    const request = this.posting.request(), { lines } = this.posting;
    // The list may be made anew before the answer is there.
    const say = (text) => {
      this.touched = { key, text };
      by(`touched-${key}`)?.replaceChildren(text);
    };
    if (!request || !this.posting.answer?.nc) {
      say("there is no program");
      return;
    }
    say("…");
    let refused = 0;
    for (const value of others.slice(0, MOST_TRIED)) {
      const answer = await this.ask({ ...request, set: [...(request.set ?? []), `${key}=${value}`] }).catch(() => ({}));
      if (answer.nc === undefined) {
        refused += 1;
        continue;
      }
      const other = answer.nc.replaceAll("\r\n", "\n").split("\n");
      const { made, gone } = changedLines(other, lines);
      if (!made.length && !gone) continue;
      say(`${counted(made.length, "line")} (${value} gives other ones)`);
      this.showLines(made);
      return;
    }
    this.showLines([]);
    say(refused && refused >= Math.min(others.length, MOST_TRIED)
      ? "other values are refused with this part" : "no line of this part");
  }

  settingRow(setting) {
    const { key, meaning, unit, choices, value, base, own, acts } = setting;
    const shown = (number) => {
      if (number === null) return "none";
      const choice = choices.find(([each]) => each === number);
      return choice ? `${number} (${choice[1]})` : said(number, unit);
    };
    const isOwn = own !== null;
    return this.row(key, {
      label: key,
      help: meaning,
      control: this.settingControl(setting),
      isOwn,
      quiet: !acts,
      others: otherValues(setting),
      notes: [
        isOwn && value !== base ? `base ${shown(base)}` : null,
        base !== setting.default || isOwn ? `default ${shown(setting.default)}` : null,
        UNITS[unit] ?? (unit === "-" || unit === "choice" || unit === "flag" ? null : unit),
        acts ? null : "the post does not act on it",
      ],
    });
  }

  settingControl({ key, unit, choices, value, own }) {
    if (choices.length) {
      const flag = choices.every(([, text]) => text === "yes" || text === "no");
      const known = choices.some(([each]) => each === value);
      const none = el("option", { value: "none" }, value === null ? "none" : known ? "none" : said(value, unit));
      const select = el(
        "select",
        { onchange: () => this.set(key, select.value === "none" ? '"none"' : select.value) },
        ...choices.map(([number, text]) => el("option", { value: flag ? String(text === "yes") : String(number) }, flag ? text : `${number}  ${text}`)),
        ...(known ? [] : [none]),
      );
      const current = choices.find(([each]) => each === value);
      select.value = current ? (flag ? String(current[1] === "yes") : String(current[0])) : "none";
      return select;
    }
    const text = own !== null ? own.replace(/^["'](.*)["']$/, "$1") : value === null ? "none" : said(value, unit);
    const input = el("input", { type: "text", value: text, spellcheck: false, onchange: () => this.set(key, literal(input.value.trim(), unit)) });
    return input;
  }

  optionRow({ name, kind, values, choices, value, help, own, group, ...option }) {
    const key = `options.${name}`;
    const write = (text) => this.set(key, kind === "integer" ? text : kind === "bool" ? String(text === "yes") : JSON.stringify(text));
    let control;
    if (choices.length) {
      control = el("select", { onchange: () => write(control.value) }, ...choices.map((each) => el("option", { value: each }, each)));
      control.value = value;
    } else {
      control = el("input", { type: "text", value, title: values, onchange: () => write(control.value.trim()) });
    }
    return this.row(key, {
      label: name, help, control, isOwn: own !== null,
      others: choices.length ? choices.filter((each) => each !== value).map((each) => kind === "bool" ? String(each === "yes") : JSON.stringify(each))
        : kind === "text" ? ['"OTHER"'] : [String(Number(value) + 1)],
      notes: [own !== null || option.default !== value ? `default ${option.default || "empty"}` : null, choices.length ? null : values],
    });
  }

  blocksRow({ key, value, base, own }) {
    const control = el("textarea", {
      rows: Math.max(2, value.length + 1), value: value.join("\n"), spellcheck: false,
      onchange: () => this.set(key, `[${control.value.split("\n").filter((line) => line.trim()).map((line) => JSON.stringify(line.trim())).join(", ")}]`),
    });
    return this.row(key, {
      others: value.length ? ["[]"] : ['["(A BLOCK)"]'],
      label: key, help: "One block in each line, written as it is here.", control, isOwn: own !== null,
      notes: [own !== null && base.length ? `base ${base.join(" / ")}` : null],
    });
  }

  /** Changes machine.toml; says why not, or nothing. */
  async set(key, value) {
    const text = this.files.text(MACHINE);
    const answer = await this.ask({ do: "set", text, key, value: value ?? undefined });
    this.refused = answer.text === undefined ? `${key} is not set: ${answer.why ?? answer.misuse}` : "";
    this.say(this.refused);
    if (!this.refused) this.files.set(MACHINE, answer.text);
    return this.refused;
  }
}

/** Gives the focus back to the field of the same name in a list that is made anew, with what was chosen in it. */
function focusIn(list) {
  const { id, selectionStart: from, selectionEnd: to } = document.activeElement;
  if (!id || !list.contains(document.activeElement)) return () => {};
  return () => {
    const field = by(id);
    field?.focus();
    if (typeof from === "number") field?.setSelectionRange?.(from, to);
  };
}

const UNITS = { code: "number of a G or M code", mm: "mm", deg: "degrees", rpm: "rpm", s: "seconds", "mm/min": "mm/min", letter: "a letter", char: "a character", count: "a whole number" };

/** Values that a setting may have instead, as TOML writes them: what is near comes first. */
function otherValues({ unit, choices, value, base, default: usual }) {
  if (choices.length) {
    const flag = choices.every(([, text]) => text === "yes" || text === "no");
    return choices.filter(([each]) => each !== value).map(([each, text]) => flag ? String(text === "yes") : String(each));
  }
  if (unit === "letter") return ["A", "E", "Q", "V"].filter((letter) => letter !== said(value, unit)).map((letter) => JSON.stringify(letter));
  const known = [base, usual].filter((each) => each !== null && each !== value).map(String);
  if (value === null) return [...known, "1", "10", "100"];
  return unit === "char" ? known : [...known, String(value + 1), String(value * 2), String(value / 2), '"none"'];
}

/** A value as people write it. */
function said(number, unit) {
  if (unit === "letter" && number >= 1 && number <= 26) return String.fromCharCode(64 + number);
  if (unit === "char" && number > 32 && number < 127) return String.fromCharCode(number);
  return String(number);
}

/** What somebody typed as TOML writes it. */
function literal(text, unit) {
  if (/^[-+]?\d+(\.\d+)?$/.test(text) && unit !== "char") return text;
  if (/^[-+]?(\d+\.|\.\d+)$/.test(text)) return String(Number(text));
  return JSON.stringify(text);
}
