// What stands beside the text of a script: hints behind numbers, and what can be folded.
import { foldEffect, foldService, unfoldEffect } from "@codemirror/language";
import { StateEffect, StateField } from "@codemirror/state";
import { Decoration, EditorView, WidgetType } from "@codemirror/view";
import { el } from "./dom.js";

const take = StateEffect.define();

class Hint extends WidgetType {
  constructor(text) {
    super();
    this.text = text;
  }

  eq(other) {
    return other.text === this.text;
  }

  toDOM() {
    return el("span", { class: "beside" }, this.text);
  }
}

const hints = StateField.define({
  create: () => Decoration.none,
  update(shown, { changes, effects, state: { doc } }) {
    const effect = effects.find((each) => each.is(take));
    if (!effect) return shown.map(changes);
    return Decoration.set(effect.value.hints.map(([line, character, text]) =>
      Decoration.widget({ widget: new Hint(text), side: 1 }).range(doc.line(line + 1).from + character)));
  },
  provide: (field) => EditorView.decorations.from(field),
});

/** Ranges by the start of their first line. */
const folds = StateField.define({
  create: () => new Map(),
  update(known, { changes, effects, state: { doc } }) {
    const effect = effects.find((each) => each.is(take));
    if (effect) return new Map(effect.value.folds.map(([first, last]) => [doc.line(first + 1).from, doc.line(last + 1).to]));
    return changes.empty ? known : new Map([...known].map(([from, to]) => [changes.mapPos(from, 1), changes.mapPos(to)]));
  },
});

export const beside = [hints, folds, foldService.of((state, from, lineEnd) => {
  const to = state.field(folds).get(from);
  return to > lineEnd ? { from: lineEnd, to } : null;
})];

/** Shows what the language tools say of a text, which is still that of the editor. */
export function showBeside(view, found) {
  view.dispatch({ effects: take.of(found) });
  // The arrows of the folds are only drawn anew where something has been folded.
  const range = { from: 0, to: Math.min(1, view.state.doc.length) };
  if (!range.to) return;
  view.dispatch({ effects: foldEffect.of(range) });
  view.dispatch({ effects: unfoldEffect.of(range) });
}
