// The files of the post: what is on the disk (or in memory), and what has been edited.
import { signal } from "./dom.js";

/** Endings of CL files. */
const CL = /\.(ncl|cl|cls|apt|aptsource|clf|cldata)(\.\d+)?$/i;

export const isCl = (name) => CL.test(name);
export const isFil = (name) => /\.(fil|inc|f\d\d)$/i.test(name);
export const isMachine = (name) => /(^|\/)[^/]*machine[^/]*\.toml$/i.test(name);
export const isMesh = (name) => /\.stl$/i.test(name);
export const isNc = (name) => /\.(nc|tap|h|mpf|spf|eia|cnc|min|ptp)$/i.test(name);

/** What kind of text a file is, as the editor colours and judges it. */
export function kindOf(name) {
  if (isCl(name)) return "cl";
  if (isFil(name)) return "fil";
  if (isMachine(name)) return "machine";
  if (isNc(name)) return "nc";
  if (name.endsWith(".toml")) return "toml";
  return "text";
}

/** A text with `\n` at the ends of its lines, as editors have it. A body may be no text: its bytes stay. */
const plainEnds = (name, text) => (isMesh(name) ? text : text.replaceAll("\r\n", "\n"));

export class Files {
  constructor(backend) {
    this.backend = backend;
    this.folder = "";
    /** By name: `{name, size, stamp, encoding, text, saved, crlf}`; `text` is null until it is read. */
    this.all = new Map();
    /** A file came, went, or was renamed. */
    this.listed = signal();
    /** The text of a file is another one: its name, and who changed it. */
    this.changed = signal();
  }

  /** Reads the list of the files, and the texts of the post itself with those that its scripts may include. */
  async load() {
    const { folder, files, all } = await this.backend.list();
    this.folder = folder;
    this.isWhole = all;
    this.all.clear();
    for (const file of files) this.all.set(file.name, { ...file, text: null, saved: null });
    const own = files.filter(({ name }) => name === "machine.toml" || (isFil(name) && !name.startsWith("cases/")));
    await Promise.all(own.map(({ name }) => this.read(name)));
    this.listed.tell();
  }

  names() {
    return [...this.all.keys()].sort((a, b) => a.localeCompare(b, "en"));
  }

  has(name) {
    return this.all.has(name);
  }

  /** The text of a file that was read; null for any other. */
  text(name) {
    return this.all.get(name)?.text ?? null;
  }

  /** Reads a file, once. */
  async read(name) {
    const file = this.all.get(name);
    if (!file) throw new Error(`there is no ${name}`);
    if (file.text === null) {
      const { text, encoding, stamp } = await this.backend.read(name);
      file.crlf = !isMesh(name) && text.includes("\r\n");
      file.text = file.saved = plainEnds(name, text);
      Object.assign(file, { encoding, stamp });
    }
    return file.text;
  }

  /** Changes a text; `by` is whoever does, so that it need not take the change itself. */
  set(name, text, by = null) {
    const file = this.all.get(name);
    const isNew = !file;
    if (isNew) this.all.set(name, { name, size: 0, stamp: null, text: null, saved: null, crlf: !isMesh(name) && text.includes("\r\n"), encoding: isMesh(name) ? "bytes" : undefined });
    const known = this.all.get(name);
    const plain = plainEnds(name, text);
    if (known.text === plain) return;
    known.text = plain;
    if (isNew) this.listed.tell();
    this.changed.tell(name, by);
  }

  isDirty(name) {
    const file = this.all.get(name);
    return file !== undefined && file.text !== null && file.text !== file.saved;
  }

  dirty() {
    return this.names().filter((name) => this.isDirty(name));
  }

  /** Saves a file. */
  async save(name) {
    const file = this.all.get(name);
    const { text } = file;
    const written = file.crlf ? text.replaceAll("\n", "\r\n") : text;
    const answer = await this.backend.write(name, written, file);
    if (answer.changed) {
      throw new Error(`${name} was changed by another program since it was read. Reload the page to see it.`);
    }
    file.saved = text;
    file.stamp = answer.stamp;
    this.changed.tell(name, "save");
  }

  async saveAll() {
    for (const name of this.dirty()) await this.save(name);
  }

  /** Takes a file away, on the disk too. */
  async remove(name) {
    const file = this.all.get(name);
    if (file.stamp) {
      const answer = await this.backend.remove(name, file.stamp);
      if (answer.changed) throw new Error(`${name} was changed by another program`);
    }
    this.all.delete(name);
    this.listed.tell();
  }
}

/** A name that is said from a folder, as the name from the top: `cases/a` and `../../machine.toml`. */
export function joined(folder, name) {
  const parts = folder ? folder.split("/") : [];
  for (const part of name.replaceAll("\\", "/").split("/")) {
    if (part === "..") parts.pop();
    else if (part !== "." && part !== "") parts.push(part);
  }
  return parts.join("/");
}

/** A name from the top as it is said from a folder. */
export function nameFrom(folder, name) {
  if (!folder) return name;
  return name.startsWith(`${folder}/`) ? name.slice(folder.length + 1) : "../".repeat(folder.split("/").length) + name;
}

export const folderOf = (name) => name.split("/").slice(0, -1).join("/");
export const baseOf = (name) => name.split("/").at(-1);

/** Where a line, counted from 0, and UTF-16 units in it are in a text. */
function offset(text, line, units) {
  let at = 0;
  for (let passed = 0; passed < line; passed++) {
    const next = text.indexOf("\n", at);
    if (next < 0) return text.length;
    at = next + 1;
  }
  return Math.min(at + units, text.length);
}

/** Makes changes, each `{file, range, text}` with a range of the text before all of them. */
export function applyEdits(files, edits) {
  for (const name of new Set(edits.map(({ file }) => file))) {
    const old = files.text(name);
    if (old === null) continue;
    const own = edits.filter(({ file }) => file === name).map(({ range: [line, from, toLine, to], text }) => {
      return { begin: offset(old, line, from), end: offset(old, toLine, to), text };
    });
    own.sort((a, b) => b.begin - a.begin);
    files.set(name, own.reduce((text, edit) => text.slice(0, edit.begin) + edit.text + text.slice(edit.end), old));
  }
}
