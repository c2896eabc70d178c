// The outline of the file that is shown: tools and operations of a CL file, sections and macros of FIL, tables of a machine.
import { by, debounced, el } from "../dom.js";

/** Longest text that has an outline, characters. */
const LONGEST = 8_000_000;

/** Most entries that are listed. */
const MOST = 400;

export function startOutline(files, posting, editing, ask, { open }) {
  const list = by("outline");
  let asked = 0;

  async function show() {
    const name = editing.current, number = ++asked;
    await posting.idle();
    if (number !== asked) return;
    const language = editing.languageOf(name), text = files.text(name);
    const isShown = Boolean(language) && text !== null && text.length <= LONGEST;
    const entries = isShown ? await ask({ do: "outline", ...editing.asked(language, name, text) }).catch(() => []) : [];
    if (number !== asked) return;
    let left = MOST;
    const items = (of) => of.filter(() => left-- > 0).map(({ name: title, line, children }) => el("li", {},
      el("button", { type: "button", class: "name", title, onclick: () => open(name, line + 1) }, title),
      children.length ? el("ul", {}, ...items(children)) : null));
    list.replaceChildren(...items(Array.isArray(entries) ? entries : []));
    by("outline-head").hidden = !list.childElementCount;
    if (left < 0) list.append(el("li", { class: "quiet" }, "… and more"));
  }

  const later = debounced(500, show);
  editing.chosen.on(show);
  files.changed.on((name, by) => by !== "save" && name === editing.current && later());
}
