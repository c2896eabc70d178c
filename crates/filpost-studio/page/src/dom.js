// Elements, made of texts and never of HTML.

/** An element with properties (or attributes, where the name has a dash) and children. */
export function el(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (name === "class") made.className = value;
    else if (name.includes("-") || name === "role" || name === "for") made.setAttribute(name, value);
    else made[name] = value;
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** A text as elements: words between ` are code, and marks of stress are left out. */
export function prose(text) {
  return text.split("`").map((piece, at) => {
    return at % 2 ? el("code", {}, piece) : el("span", {}, piece.replaceAll("**", "").replace(/\*(\S[^*]*)\*/g, "$1"));
  });
}

/** The element of an id. */
export const by = (id) => document.getElementById(id);

/** Calls a function when it has been asked for and then not again for some time, milliseconds. */
export function debounced(wait, act) {
  let timer = 0;
  return (...values) => {
    clearTimeout(timer);
    timer = setTimeout(() => act(...values), wait);
  };
}

/** Whoever wants to know, and who tells them. */
export function signal() {
  const listeners = [];
  return {
    on: (listener) => listeners.push(listener),
    tell: (...values) => listeners.forEach((listener) => listener(...values)),
  };
}

/** `1 block`, `2 blocks`. */
export const counted = (count, word) => `${count.toLocaleString("en")} ${word}${count === 1 ? "" : "s"}`;

/** Makes the buttons of a tab list act: a click or an arrow key chooses, and panels follow. */
export function tabs(list, chosen) {
  const buttons = () => [...list.querySelectorAll('[role="tab"]')];
  function choose(button) {
    for (const other of buttons()) {
      const is = other === button;
      other.setAttribute("aria-selected", String(is));
      other.tabIndex = is ? 0 : -1;
      const panel = by(other.getAttribute("aria-controls"));
      if (panel) panel.hidden = !is;
    }
    chosen?.(button.id);
  }
  list.addEventListener("click", (event) => {
    const button = event.target.closest('[role="tab"]');
    if (button) choose(button);
  });
  list.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const all = buttons().filter((button) => !button.hidden);
    const next = all[(all.indexOf(document.activeElement) + step + all.length) % all.length];
    next?.focus();
    if (next) choose(next);
  });
  return { choose: (id) => choose(by(id)) };
}
