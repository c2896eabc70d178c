// The beginning: a ready post to start from, an option file, or files of one's own.
import { ask as askDialog, confirm, tell } from "./dialogs.js";
import { by, el } from "./dom.js";
import { baseOf, isMesh } from "./files.js";
import { MACHINE } from "./posting.js";

const LATHE = /lathe|mill-turn/;
const FIVE_AXES = /5x|trunnion|tables|head/;

/** Families of ready posts in the list, by their names. */
const FAMILIES = [
  ["Mills", (name) => !LATHE.test(name) && !FIVE_AXES.test(name)],
  ["Lathes and mill-turn machines", (name) => LATHE.test(name)],
  ["Five axes", (name) => !LATHE.test(name) && FIVE_AXES.test(name)],
];

/** Shows the choices; `true` comes back where the folder has a post then. */
export async function startPost({ files, ask, examples, takeExample }) {
  const posts = await ask({ do: "ready" });
  const chosen = await askDialog("Start a post", (close) => [
    el("p", {}, "Begin from a ready post that is near to your machine. Its settings stay its own; you write down what differs."),
    el("label", { class: "filter" }, "Find ", el("input", {
      type: "search", placeholder: "fanuc, lathe, 5x …", oninput: (event) => filter(event.target.value),
    })),
    el("div", { class: "posts" }, ...FAMILIES.map(([title, isOf]) => {
      const own = posts.filter(({ name }) => isOf(name));
      return el("section", {}, el("h3", {}, title), ...own.map((post) => card(post, close)));
    }), examples?.length ? el("section", {}, el("h3", {}, "Examples"), ...examples.map((example) => {
      return el("button", { type: "button", class: "card", onclick: () => close({ example }) }, el("b", {}, example.title));
    })) : null),
    el(
      "div",
      { class: "buttons" },
      el("button", { type: "button", onclick: () => close({ option: true }) }, "Import an option file…"),
    ),
  ]);
  if (!chosen) return false;
  if (chosen.example) return takeExample(chosen.example);
  if (chosen.option) return importOptionFile(files, ask);
  if (files.has(MACHINE) && !(await confirm("Replace the post?", `${MACHINE} and post.fil of this folder become those of ${chosen.post}. Nothing is saved until you save.`, "Replace"))) {
    return false;
  }
  const { files: made } = await ask({ do: "new", name: files.folder || "my-post", base: chosen.post });
  for (const { name, text } of made) files.set(name, text);
  return true;
}

function card({ name, machine }, close) {
  const title = /^name\s*=\s*"([^"]*)"/m.exec(machine)?.[1] ?? "";
  return el("button", { type: "button", class: "card", onclick: () => close({ post: name }) }, el("b", {}, name), el("span", {}, title));
}

function filter(text) {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  for (const card of by("dialog").querySelectorAll(".card")) {
    card.hidden = !words.every((word) => card.textContent.toLowerCase().includes(word));
  }
}

/** Files that the user chooses, as `{name, text}`; those that are no texts are left out. */
export function chooseFiles(accept = "") {
  return new Promise((resolve) => {
    const chooser = by("chooser");
    chooser.accept = accept;
    chooser.value = "";
    chooser.onchange = async () => resolve(await readAll(chooser.files));
    chooser.oncancel = () => resolve([]);
    chooser.click();
  });
}

/** Reads files of the browser, in UTF-8 or else Windows' Latin. */
export async function readAll(list) {
  const read = await Promise.all([...list].map(async (file) => {
    const bytes = await file.arrayBuffer();
    const name = baseOf(file.name);
    return { name, text: isMesh(name) ? charactersOf(new Uint8Array(bytes)) : decode(bytes) };
  }));
  return read.filter(({ text }) => text !== null);
}

/** A character for each byte. */
function charactersOf(bytes) {
  const pieces = [];
  for (let at = 0; at < bytes.length; at += 8192) pieces.push(String.fromCharCode(...bytes.subarray(at, at + 8192)));
  return pieces.join("");
}

function decode(bytes) {
  if (new Uint8Array(bytes).includes(0)) return null;
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("windows-1252").decode(bytes);
  }
}

async function importOptionFile(files, ask) {
  const [file] = await chooseFiles();
  if (!file) return false;
  const answer = await ask({ do: "import", ...file });
  if (answer.errors) {
    await tell("Not imported", answer.errors.map(({ code, message }) => `${code}: ${message}`).join("\n"));
    return false;
  }
  files.set(MACHINE, answer.machine);
  return true;
}
