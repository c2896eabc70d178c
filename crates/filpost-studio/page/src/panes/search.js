// Where a name is, in all files of the folder, the program and the settings of the machine.
import { by, counted, debounced, el, prose } from "../dom.js";
import { isMesh, kindOf } from "../files.js";

/** Most places that are listed, and most of one file. */
const MOST = 500, MOST_OF_FILE = 100;

/** Shortest text that is looked for. */
const SHORTEST = 2;

/** A name: the characters beside it are none of one. */
const NAME = /^[\w.]+$/;

/** The lines that have a text, `{line, text, from}`; of a name those where it stands alone, letters in any case. */
export function placesOf(text, wanted, isWhole, kind) {
  const escaped = wanted.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
  const pattern = new RegExp(isWhole ? `(?<![\\w.])${escaped}(?!\\w)` : escaped, "gi");
  const places = new Map();
  let line = 1, start = 0;
  for (const { index } of text.matchAll(pattern)) {
    for (let end = text.indexOf("\n", start); end >= 0 && end < index; end = text.indexOf("\n", start)) {
      line += 1;
      start = end + 1;
    }
    if (places.has(line)) continue;
    const end = text.indexOf("\n", index);
    places.set(line, { line, from: index - start, text: text.slice(start, end < 0 ? text.length : end) });
    if (places.size >= MOST_OF_FILE) break;
  }
  if (kind === "machine" || kind === "toml") {
    for (const place of keysOf(text, wanted)) if (!places.has(place.line)) places.set(place.line, place);
  }
  return [...places.values()].sort((a, b) => a.line - b.line);
}

/** The lines of a TOML text whose dotted key is the one that is wanted: the name of its table stands above it. */
function keysOf(text, wanted) {
  let table = "";
  return text.split("\n").flatMap((line, at) => {
    table = /^\s*\[([^\][]+)\]/.exec(line)?.[1].trim() ?? table;
    const key = /^\s*([\w.-]+)\s*=/.exec(line)?.[1];
    const is = key && table && `${table}.${key}`.toLowerCase() === wanted.toLowerCase();
    return is ? [{ line: at + 1, from: line.indexOf(key), text: line }] : [];
  });
}

/** What a line of FIL makes of a name: its definition, or a value. */
function roleOf(text, wanted, kind) {
  if (kind !== "fil") return null;
  const [, name, rest] = /^\s*(\w+)\s*=\s*(\w*)/.exec(text) ?? [];
  if (name?.toLowerCase() === wanted.toLowerCase()) return /^macro$/i.test(rest) ? "macro" : "set";
  return new RegExp(`^\\s*CALL\\s*/\\s*${wanted}\\b`, "i").test(text) ? "call" : null;
}

export function startSearch(files, posting, editing, form, { open, openNc, choose }) {
  const input = by("search-text"), list = by("search-places"), said = by("search-said"), whole = by("search-whole");
  let asked = 0;

  async function search() {
    const number = ++asked, wanted = input.value.trim();
    if (wanted.length < SHORTEST) {
      said.textContent = wanted ? "Two letters at least." : "";
      list.replaceChildren();
      return;
    }
    said.textContent = "Searching…";
    const unread = [], isWhole = whole.checked && NAME.test(wanted), groups = [];
    for (const name of files.names().filter((each) => !isMesh(each))) {
      const text = await files.read(name).catch(() => null);
      if (number !== asked) return;
      if (text === null) unread.push(name);
      else groups.push({ name, kind: kindOf(name), places: placesOf(text, wanted, isWhole, kindOf(name)), go: (place) => open(name, place.line, place.from) });
    }
    if (posting.answer?.nc) {
      groups.push({ name: "NC program", kind: "nc", places: placesOf(posting.lines.join("\n"), wanted, isWhole, "nc"), go: ({ line }) => openNc(line) });
    }
    groups.push({ name: "Settings", kind: "settings", places: settings(wanted), go: ({ key }) => form.showSetting(key) });
    const found = groups.filter(({ places }) => places.length);
    const count = found.reduce((sum, { places }) => sum + places.length, 0);
    said.textContent = [
      count ? `${counted(count, "place")} in ${counted(found.length, "text")}` : "Not found",
      count > MOST ? `the first ${MOST} are listed` : "",
      unread.length ? `not read: ${unread.join(", ")}` : "",
    ].filter(Boolean).join("; ");
    let left = MOST;
    list.replaceChildren(...found.map(({ name, kind, places, go }) => {
      const shown = places.filter(() => left-- > 0);
      return shown.length ? el("li", {}, el("h3", {}, name), el("ul", {}, ...shown.map((place) => item(place, roleOf(place.text, wanted, kind), go)))) : null;
    }).filter(Boolean));
  }

  function item(place, role, go) {
    return el("li", {}, el("button", { type: "button", class: "finding", onclick: () => go(place) },
      el("span", { class: "where" }, place.key ?? String(place.line)), role ? el("b", {}, role) : null,
      place.key ? el("span", {}, ...prose(place.text)) : el("code", {}, place.text.trim().slice(0, 200))));
  }

  /** Settings whose key has the text. */
  function settings(wanted) {
    const rows = form.made?.settings ?? [];
    return rows.filter(({ key }) => key.includes(wanted.toLowerCase())).slice(0, MOST_OF_FILE).map(({ key, meaning }) => ({ key, text: meaning }));
  }

  input.addEventListener("input", debounced(200, search));
  whole.addEventListener("change", search);
  const again = debounced(500, () => input.value && !by("panel-search").hidden && search());
  files.changed.on((name, who) => who !== "save" && again());
  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || !event.shiftKey || event.key.toUpperCase() !== "F") return;
    event.preventDefault();
    // The word at the cursor, or what is selected there.
    const word = editing.selected();
    choose();
    if (word) input.value = word;
    input.focus();
    input.select();
    search();
  });
}
