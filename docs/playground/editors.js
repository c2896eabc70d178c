// The editors: one of each text, their findings, hovers, proposals and marked lines.
import { autocompletion } from "@codemirror/autocomplete";
import { setDiagnostics } from "@codemirror/lint";
import { EditorState, StateEffect, StateField } from "@codemirror/state";
import { Decoration, EditorView, hoverTooltip } from "@codemirror/view";
import { basicSetup } from "codemirror";

const mark = StateEffect.define();

/** Lines that are marked: those that made the NC line that is pointed at. */
const marked = StateField.define({
  create: () => Decoration.none,
  update(lines, transaction) {
    lines = lines.map(transaction.changes);
    for (const effect of transaction.effects) {
      if (effect.is(mark)) {
        const line = Decoration.line({ class: "marked" });
        lines = Decoration.set(effect.value.map((at) => line.range(at)));
      }
    }
    return lines;
  },
  provide: (field) => EditorView.decorations.from(field),
});

/** The position of a line, counted from 1, and of UTF-16 units in it. */
function place(doc, line, units = 0) {
  const at = doc.line(Math.min(Math.max(line, 1), doc.lines));
  return Math.min(at.from + units, at.to);
}

/** Marks lines, counted from 1, and shows the first. */
export function markLines(view, lines) {
  const { doc } = view.state;
  const starts = [...new Set(lines.filter((line) => line >= 1 && line <= doc.lines))];
  starts.sort((a, b) => a - b);
  const effects = [mark.of(starts.map((line) => place(doc, line)))];
  if (starts.length) {
    effects.push(EditorView.scrollIntoView(place(doc, starts[0]), { y: "center" }));
  }
  view.dispatch({ effects });
}

/** Shows findings `{line, from, to, toLine, severity, message, code}`; lines count from 1. */
export function showFindings(view, findings) {
  const { doc } = view.state;
  const found = findings.map(({ line, from, toLine, to, severity, message, code }) => {
    let begin = place(doc, line, from);
    const end = Math.max(begin, place(doc, toLine ?? line, to));
    // The end of a line has no character that could be marked: the last one is.
    if (begin === end) begin = Math.max(doc.lineAt(begin).from, begin - 1);
    return { from: begin, to: end, severity, message: `${code}: ${message}` };
  });
  found.sort((a, b) => a.from - b.from);
  view.dispatch(setDiagnostics(view.state, found));
}

/** Markdown of the hovers: paragraphs, fenced text and `words`; as elements, never as HTML. */
function shown(markdown) {
  const dom = document.createElement("div");
  dom.className = "hover";
  markdown.split("```").forEach((part, index) => {
    if (index % 2) {
      const text = document.createElement("pre");
      text.textContent = part.replace(/^\w*\n/, "").trimEnd();
      dom.append(text);
      return;
    }
    for (const paragraph of part.split(/\n\s*\n/).filter((text) => text.trim())) {
      const text = document.createElement("p");
      paragraph.trim().split("`").forEach((piece, at) => {
        const element = document.createElement(at % 2 ? "code" : "span");
        element.textContent = piece.replaceAll("**", "");
        text.append(element);
      });
      dom.append(text);
    }
  });
  return dom;
}

function position(doc, at) {
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
    return { pos: from, end: to, create: () => ({ dom: shown(answer.markdown) }) };
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

/** An editor of a text in `parent`. `file(text)` names it for requests of the worker. */
export function editor(parent, { text, language, ask, file, changed }) {
  const extensions = [
    basicSetup,
    language,
    marked,
    hovers(ask, file),
    autocompletion({ override: [proposals(ask, file)] }),
    EditorView.updateListener.of((update) => update.docChanged && changed()),
  ];
  return new EditorView({ parent, state: EditorState.create({ doc: text, extensions }) });
}

/** The NC program: what made a line stands beside the pointer, and is told to `pointed`. */
export function program(parent, { language, origin, pointed }) {
  const tips = hoverTooltip((view, at) => {
    const line = view.state.doc.lineAt(at);
    const text = origin(line.number);
    if (!text) return null;
    pointed(line.number);
    return { pos: line.from, end: line.to, create: () => ({ dom: shown("```\n" + text + "```") }) };
  });
  const chosen = EditorView.updateListener.of((update) => {
    if (!update.selectionSet || update.docChanged) return;
    const { doc, selection } = update.state;
    // What is dispatched within an update waits until it is over.
    queueMicrotask(() => pointed(doc.lineAt(selection.main.head).number));
  });
  const extensions = [basicSetup, language, tips, chosen, EditorState.readOnly.of(true)];
  return new EditorView({ parent, state: EditorState.create({ extensions }) });
}

export function setText(view, text) {
  view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });
}
