// The files of the post.
import { by, el } from "../dom.js";
import { baseOf, folderOf } from "../files.js";

/** Shows the files; `open` gets the name of one that is chosen. */
export function startTree(files, { open, remove }) {
  const tree = by("tree");

  function show() {
    const names = files.names();
    const folders = new Map();
    for (const name of names) {
      const folder = folderOf(name);
      if (!folders.has(folder)) folders.set(folder, []);
      folders.get(folder).push(name);
    }
    const sorted = [...folders].sort(([a], [b]) => a.localeCompare(b, "en"));
    tree.replaceChildren(...sorted.map(([folder, own]) => {
      const list = own.map((name) => item(name));
      return folder === ""
        ? el("li", {}, el("ul", {}, ...list))
        : el("li", {}, el("span", { class: "folder" }, folder), el("ul", {}, ...list));
    }));
    mark();
  }

  function item(name) {
    return el(
      "li",
      { class: "file" },
      el("button", { type: "button", class: "name", title: name, onclick: () => open(name) }, baseOf(name)),
      el("button", { type: "button", class: "remove", "aria-label": `Remove ${name}`, title: "Remove", onclick: () => remove(name) }, "×"),
    );
  }

  function mark(chosen = tree.dataset.chosen) {
    if (chosen !== undefined) tree.dataset.chosen = chosen;
    for (const button of tree.querySelectorAll(".name")) {
      const name = button.title;
      button.classList.toggle("dirty", files.isDirty(name));
      if (name === chosen) button.setAttribute("aria-current", "true");
      else button.removeAttribute("aria-current");
    }
  }

  files.listed.on(show);
  files.changed.on(() => mark());
  return { mark };
}
