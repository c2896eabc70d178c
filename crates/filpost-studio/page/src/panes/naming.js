// Names in a FIL file: where one is defined and used, another name for it; and the layout of the file.
import { ask as askDialog, askText, tell } from "../dialogs.js";
import { by, el } from "../dom.js";
import { applyEdits, isFil } from "../files.js";

export function startNaming(files, editing, ask, { open }) {
  const bar = by("naming");

  /** Asks about the name at the cursor. */
  const request = (what, more = {}) => {
    const { name, text, position } = editing.place();
    return ask({ do: what, ...editing.asked("fil", name, text), ...position, ...more });
  };

  const go = ({ file, range: [line, from] }) => {
    if (files.has(file)) open(file, line + 1, from);
    else tell("Not shown", `It is in ${file}, which is no file of this folder.`);
  };

  async function define() {
    const [place] = (await request("definition")) ?? [];
    if (place) go(place);
    else tell("No definition", "The cursor is at no name that a file of the post defines.");
  }

  async function uses() {
    const places = (await request("references")) ?? [];
    places.sort((a, b) => a.file.localeCompare(b.file) || a.range[0] - b.range[0] || a.range[1] - b.range[1]);
    if (!places.length) return tell("No uses", "The cursor is at no name of the script.");
    const chosen = await askDialog(`Used in ${places.length} place${places.length === 1 ? "" : "s"}`, (close) => [
      el("ul", { class: "list" }, ...places.map((place) => {
        const { file, range: [line] } = place;
        const text = (files.text(file)?.split("\n")[line] ?? "").trim();
        return el("li", {}, el("button", { type: "button", class: "finding", onclick: () => close(place) },
          el("span", { class: "where" }, `${file}:${line + 1}`), el("code", {}, text)));
      })),
    ]);
    if (chosen) go(chosen);
  }

  async function rename() {
    const word = editing.word();
    const name = word && await askText("Rename", `New name of ${word}`, word, "Rename");
    if (!name || name === word) return;
    const { edits, why } = await request("rename", { new: name });
    if (!edits) tell("Not renamed", why);
    else applyEdits(files, edits);
  }

  async function format() {
    const { name } = editing.place(), { text, why } = await request("format");
    if (text === undefined) tell("Not formatted", `A text with errors keeps its layout: ${why}`);
    else files.set(name, text);
  }

  const acts = [["Definition", "F12", define], ["Uses", "Shift-F12", uses], ["Rename…", "F2", rename], ["Format", "Shift-Alt-F", format]];
  const run = (act) => act().catch((error) => tell("No answer", error.message));
  bar.append(...acts.map(([title, key, act]) => el("button", { type: "button", title: key, onclick: () => run(act) }, title)));
  document.addEventListener("keydown", (event) => {
    if (!isFil(editing.current ?? "") || !by("editors").contains(event.target)) return;
    const pressed = `${event.shiftKey ? "Shift-" : ""}${event.altKey ? "Alt-" : ""}${event.key.toUpperCase()}`;
    const found = acts.find(([, key]) => key.toUpperCase() === pressed.toUpperCase());
    if (!found || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    run(found[2]);
  });
  editing.chosen.on((name) => (bar.hidden = !isFil(name)));
}
