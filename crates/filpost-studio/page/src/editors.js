// The editors: their findings, hovers, proposals and marked lines.
import { autocompletion } from "@codemirror/autocomplete";
import { setDiagnostics } from "@codemirror/lint";
import { Annotation, Compartment, EditorState, RangeSet, StateEffect, StateField } from "@codemirror/state";
import { Decoration, EditorView, gutter, GutterMarker, hoverTooltip, keymap } from "@codemirror/view";
import { basicSetup } from "codemirror";
import { beside } from "./beside.js";
import { el, prose } from "./dom.js";
import { languageOf, wordColours } from "./languages.js";
import { isDark, themed } from "./theme.js";

const mark = StateEffect.define();
const freshen = StateEffect.define();
const stand = StateEffect.define();
const setStops = StateEffect.define();
const miss = StateEffect.define();

/** A change that did not come from the editor's user. */
const fromOutside = Annotation.define();

/** Whether an editor is dark. */
const darkness = new Compartment();
const darkNow = () => EditorView.darkTheme.of(isDark());

/** What all editors have: the usual keys and marks, and the colours of a kind of text. */
const common = (kind) => [basicSetup, darkness.of(darkNow()), wordColours, languageOf(kind), marked];

/** An editor that follows when the page becomes dark or light. */
function shaded(view) {
  themed.on(() => view.dispatch({ effects: darkness.reconfigure(darkNow()) }));
  return view;
}

/** Lines of a class, set by an effect with the positions of their starts. */
function linesOf(name, wanted) {
  return StateField.define({
    create: () => Decoration.none,
    update(lines, transaction) {
      lines = lines.map(transaction.changes);
      for (const effect of transaction.effects) {
        if (effect.is(wanted)) {
          const line = Decoration.line({ class: name });
          lines = Decoration.set(effect.value.map((at) => line.range(at)));
        }
      }
      return lines;
    },
    provide: (field) => EditorView.decorations.from(field),
  });
}

/** Lines that are marked: those that belong to what is pointed at elsewhere. */
const marked = linesOf("marked", mark);

/** Lines that the last change has made. */
const fresh = linesOf("fresh", freshen);

/** The line where a run stands that is debugged. */
const standing = linesOf("standing", stand);

/** Lines that no case has run. */
const missed = linesOf("missed", miss);

/** Shows which lines no case has run, counted from 1. */
export function showMissed(view, lines) {
  const { doc } = view.state;
  view.dispatch({ effects: miss.of(lines.filter((line) => line <= doc.lines).map((line) => doc.line(line).from)) });
}

/** Shows where a run stands, a line counted from 1; null for nowhere. */
export function showStanding(view, line) {
  const { doc } = view.state;
  view.dispatch({ effects: stand.of(line && line <= doc.lines ? [doc.line(line).from] : []) });
}

class StopMarker extends GutterMarker {
  toDOM() {
    const dot = el("span", { class: "stop" }, "●");
    dot.title = "The run stops here";
    return dot;
  }
}
const stopMarker = new StopMarker();

/** Lines with breakpoints; they move with the text. */
const stops = StateField.define({
  create: () => RangeSet.empty,
  update(set, { changes, effects, state }) {
    set = set.map(changes);
    for (const effect of effects) {
      if (!effect.is(setStops)) continue;
      const lines = effect.value.filter((line) => line <= state.doc.lines).sort((a, b) => a - b);
      set = RangeSet.of(lines.map((line) => stopMarker.range(state.doc.line(line).from)));
    }
    return set;
  },
});

function stopLines(state) {
  const lines = new Set();
  for (const cursor = state.field(stops).iter(); cursor.value; cursor.next()) lines.add(state.doc.lineAt(cursor.from).number);
  return [...lines];
}

/** Shows which lines have breakpoints, counted from 1. */
export function showStops(view, lines) {
  view.dispatch({ effects: setStops.of([...lines]) });
}

function toggleStop(view, at) {
  const line = view.state.doc.lineAt(at).number;
  const lines = stopLines(view.state);
  showStops(view, lines.includes(line) ? lines.filter((each) => each !== line) : [...lines, line]);
  return true;
}

/** Breakpoints beside the lines, by a click or by F9; `told` gets their lines. */
function breakpoints(told) {
  return [
    stops,
    standing,
    missed,
    gutter({
      class: "cm-stops",
      markers: (view) => view.state.field(stops),
      initialSpacer: () => stopMarker,
      domEventHandlers: { mousedown: (view, { from }) => toggleStop(view, from) },
    }),
    keymap.of([{ key: "F9", run: (view) => toggleStop(view, view.state.selection.main.head) }]),
    EditorView.updateListener.of(({ state, startState }) => {
      if (state.field(stops) !== startState.field(stops)) told(stopLines(state));
    }),
  ];
}

/** Shows which lines are new, counted from 1. */
export function showFresh(view, lines) {
  const { doc } = view.state;
  const starts = lines.filter((line) => line <= doc.lines).map((line) => doc.line(line).from);
  view.dispatch({ effects: freshen.of(starts) });
}

/** The position of a line, counted from 1, and of UTF-16 units in it. */
function place(doc, line, units = 0) {
  const at = doc.line(Math.min(Math.max(line, 1), doc.lines));
  return Math.min(at.from + units, at.to);
}

/** Marks lines, counted from 1, and shows the first where `show` is true. */
export function markLines(view, lines, show = true) {
  const { doc } = view.state;
  const starts = [...new Set(lines.filter((line) => line >= 1 && line <= doc.lines))];
  starts.sort((a, b) => a - b);
  const effects = [mark.of(starts.map((line) => place(doc, line)))];
  if (show && starts.length) {
    effects.push(EditorView.scrollIntoView(place(doc, starts[0]), { y: "center" }));
  }
  view.dispatch({ effects });
}

/** Puts the cursor to a place and shows it. */
export function goTo(view, line, units = 0) {
  const at = place(view.state.doc, line, units);
  view.dispatch({ selection: { anchor: at }, effects: EditorView.scrollIntoView(at, { y: "center" }) });
}

/** Shows findings `{line, from, to, toLine, severity, message, code}`; lines count from 1. */
export function showFindings(view, findings) {
  const { doc } = view.state;
  const found = findings.map(({ line, from, toLine, to, severity, message, code }) => {
    let begin = place(doc, line, from);
    const end = Math.max(begin, place(doc, toLine ?? line, to));
    // The end of a line has no character that could be marked: the last one is.
    if (begin === end) begin = Math.max(doc.lineAt(begin).from, begin - 1);
    return { from: begin, to: end, severity: ["error", "warning"].includes(severity) ? severity : "info", message: `${code}: ${message}` };
  });
  found.sort((a, b) => a.from - b.from);
  view.dispatch(setDiagnostics(view.state, found));
}

/** Markdown of the hovers: paragraphs, fenced text and `words`; as elements, never as HTML. */
export function markdown(text) {
  const made = el("div", { class: "hover" });
  text.split("```").forEach((part, index) => {
    if (index % 2) {
      made.append(el("pre", {}, part.replace(/^\w*\n/, "").trimEnd()));
      return;
    }
    for (const paragraph of part.split(/\n\s*\n/).filter((piece) => piece.trim())) {
      // Links lead to pages that are not here: their words stay.
      const plain = paragraph.trim().replace(/\[([^\]]*)\]\([^)]*\)/g, "$1").replace(/^#+ /gm, "");
      made.append(el("p", {}, ...prose(plain)));
    }
  });
  return made;
}

export function position(doc, at) {
  const line = doc.lineAt(at);
  return { line: line.number - 1, character: at - line.from };
}

const range = (doc, [line, from, toLine, to]) => ({
  from: place(doc, line + 1, from),
  to: place(doc, toLine + 1, to),
});

function hovers(ask, file) {
  return hoverTooltip(async (view, at) => {
    const { doc } = view.state;
    const request = { do: "hover", ...file(doc.toString()), ...position(doc, at) };
    const answer = await ask(request).catch(() => null);
    if (!answer?.markdown) return null;
    const { from, to } = range(doc, answer.range);
    return { pos: from, end: to, create: () => ({ dom: markdown(answer.markdown) }) };
  });
}

const KINDS = { keyword: "keyword", function: "function", macro: "function", setting: "property" };

function proposals(ask, file) {
  return async ({ state, pos, explicit }) => {
    const before = state.doc.lineAt(pos);
    const typed = state.doc.sliceString(before.from, pos);
    if (!explicit && !/[A-Za-z_]\w+$/.test(typed)) return null;
    const request = { do: "complete", ...file(state.doc.toString()), ...position(state.doc, pos) };
    const items = await ask(request).catch(() => []);
    if (!Array.isArray(items) || !items.length) return null;
    const { from } = range(state.doc, items[0].range);
    const options = items.map(({ label, detail, kind }) => {
      return { label, info: detail, type: KINDS[kind] ?? "variable" };
    });
    return { from, options };
  };
}

/** The name of a text for readers of the screen, which the keys reach. */
function labelled(name) {
  return EditorView.contentAttributes.of({ "aria-label": name, tabindex: "0" });
}

/** Tells the line of the cursor when it has moved. */
function cursor(told) {
  return EditorView.updateListener.of((update) => {
    if (!update.selectionSet || update.docChanged) return;
    const { doc, selection } = update.state;
    // What is dispatched within an update waits until it is over.
    queueMicrotask(() => told(doc.lineAt(selection.main.head).number, selection.main.head));
  });
}

/**
 * An editor of a text in `parent`. `file(text)` names it for requests of the language tools and is null for
 * texts that have none; `changed` gets what its user makes of it, `pointed` the line of the cursor, `stopped` the
 * lines with breakpoints, which only texts that are run have.
 */
export function editor(parent, { name, text, kind, readOnly, ask, file, changed, pointed, stopped }) {
  const extensions = [
    ...(stopped ? breakpoints(stopped) : []),
    common(kind),
    labelled(name),
    EditorState.readOnly.of(Boolean(readOnly)),
    EditorView.updateListener.of((update) => {
      const outside = update.transactions.some((each) => each.annotation(fromOutside));
      if (update.docChanged && !outside) changed(update.state.doc.toString());
    }),
    cursor(pointed),
  ];
  if (kind === "fil") extensions.push(beside);
  if (file) extensions.push(hovers(ask, file), autocompletion({ override: [proposals(ask, file)] }));
  return shaded(new EditorView({ parent, state: EditorState.create({ doc: text, extensions }) }));
}

/** A text that is read: `origin(line)` is told beside the pointer, `pointed` gets the line of the cursor, `stopped` the lines with breakpoints. */
export function reader(parent, { label, kind, origin, pointed, stopped }) {
  const tips = hoverTooltip((view, at) => {
    const line = view.state.doc.lineAt(at);
    const text = origin?.(line.number);
    if (!text) return null;
    return { pos: line.from, end: line.to, create: () => ({ dom: markdown("```\n" + text + "```") }) };
  });
  const extensions = [
    breakpoints(stopped),
    common(kind),
    fresh,
    tips,
    cursor(pointed),
    labelled(label),
    EditorState.readOnly.of(true),
  ];
  return shaded(new EditorView({ parent, state: EditorState.create({ extensions }) }));
}

/** Gives an editor another text; only what differs is changed, so that the cursor stays. */
export function setText(view, text) {
  const old = view.state.doc.toString();
  if (old === text) return;
  let from = 0;
  const shorter = Math.min(old.length, text.length);
  while (from < shorter && old[from] === text[from]) from += 1;
  let end = 0;
  while (end < shorter - from && old[old.length - 1 - end] === text[text.length - 1 - end]) end += 1;
  const changes = { from, to: old.length - end, insert: text.slice(from, text.length - end) };
  view.dispatch({ changes, annotations: fromOutside.of(true) });
}

/** Changes lines of a text: behind `line` of them `gone` ones go, and `made` come. */
export function setLines(view, { line, gone, made }) {
  const { doc } = view.state, isEnd = line + gone >= doc.lines;
  const from = doc.line(line + 1).from, to = isEnd ? doc.length : doc.line(line + gone + 1).from;
  const insert = isEnd ? made.join("\n") : made.map((each) => `${each}\n`).join("");
  view.dispatch({ changes: { from, to, insert }, annotations: fromOutside.of(true) });
}
