// Questions in a dialog of the page.
import { by, el } from "./dom.js";

const dialog = () => by("dialog");

/** Shows a dialog with a title; `fill(close)` gives its children. What `close` gets is what comes back. */
export function ask(title, fill) {
  return new Promise((resolve) => {
    const box = dialog();
    let answer = null;
    const close = (value) => {
      answer = value;
      box.close();
    };
    const x = el("button", { type: "button", class: "close", "aria-label": "Close", onclick: () => close(null) }, "×");
    box.replaceChildren(
      el("div", { class: "head" }, el("h2", { id: "dialog-title" }, title), x),
      ...fill(close),
    );
    box.onclose = () => resolve(answer);
    box.showModal();
  });
}

/** Tells something that can only be taken note of. */
export function tell(title, text) {
  return ask(title, (close) => [
    el("p", {}, text),
    el("div", { class: "buttons" }, el("button", { type: "button", class: "primary", onclick: () => close(null) }, "Close")),
  ]);
}

/** Asks before something that can't be taken back. */
export function confirm(title, text, action) {
  return ask(title, (close) => [
    el("p", {}, text),
    el(
      "div",
      { class: "buttons" },
      el("button", { type: "button", onclick: () => close(false) }, "Cancel"),
      el("button", { type: "button", class: "primary", onclick: () => close(true) }, action),
    ),
  ]);
}

/** Asks for a text. */
export function askText(title, label, value, action) {
  return ask(title, (close) => {
    const input = el("input", { type: "text", value, required: true, spellcheck: false });
    const form = el(
      "form",
      { method: "dialog", onsubmit: (event) => { event.preventDefault(); close(input.value.trim()); } },
      el("label", {}, label, input),
      el(
        "div",
        { class: "buttons" },
        el("button", { type: "button", onclick: () => close(null) }, "Cancel"),
        el("button", { type: "submit", class: "primary" }, action),
      ),
    );
    queueMicrotask(() => input.select());
    return [form];
  });
}
