// Long texts go over once: later requests and answers name them, or say what is different in them.

/** Shortest text that is named, characters. */
export const LONG = 100_000;

/** Texts that are known on both sides; the server keeps as many. */
const MOST = 8;

/** A piece that is compared at once, characters. */
const PIECE = 4096;

/** The first UTF-16 unit in which two texts differ. */
function sameStart(one, other) {
  const shorter = Math.min(one.length, other.length);
  let at = 0;
  // Pieces are compared much faster than letters.
  while (at + PIECE <= shorter && one.slice(at, at + PIECE) === other.slice(at, at + PIECE)) at += PIECE;
  while (at < shorter && one.charCodeAt(at) === other.charCodeAt(at)) at += 1;
  return at;
}

/** How many units are the same at the ends of two texts, without their first ones. */
function sameEnd(one, other, start) {
  const shorter = Math.min(one.length, other.length) - start;
  const piece = (text, count) => text.slice(text.length - count - PIECE, text.length - count);
  let count = 0;
  while (count + PIECE <= shorter && piece(one, count) === piece(other, count)) count += PIECE;
  while (count < shorter && one.charCodeAt(one.length - 1 - count) === other.charCodeAt(other.length - 1 - count)) count += 1;
  return count;
}

/** Where two texts differ: `{from, to, text}`, what stands in the second one for those units of the first. */
function difference(one, other) {
  const from = sameStart(one, other), end = sameEnd(one, other, from);
  return { from, to: one.length - end, text: other.slice(from, other.length - end) };
}

/** The same in whole lines, as the server says it of its answers: `line` is how many lines stand before. */
export function lineDifference(one, other) {
  const start = sameStart(one, other), from = one.lastIndexOf("\n", start - 1) + 1;
  const same = sameEnd(one, other, from), first = one.indexOf("\n", one.length - same);
  const end = same && first >= 0 ? one.length - first - 1 : 0;
  return { from, to: one.length - end, line: lineEnds(one.slice(0, from)), text: other.slice(from, other.length - end) };
}

/** How many lines end in a text. */
function lineEnds(text) {
  let count = 0;
  for (let at = text.indexOf("\n"); at >= 0; at = text.indexOf("\n", at + 1)) count += 1;
  return count;
}

/**
 * Puts a text into an answer that says how it differs from another one, and says beside it as `change` which lines do: the
 * text before, `of`; behind `line` lines of it `gone` lines went, and `text` came.
 */
export function whole(answer, other) {
  const { from, to, line, text } = answer.nc;
  answer.nc = other.slice(0, from) + text + other.slice(to);
  answer.change = { of: other, line, gone: to < other.length ? lineEnds(other.slice(from, to)) : Infinity, text };
}

/** What a page has sent and got. Places are bytes of the server, so only texts in ASCII are named. */
export class SentTexts {
  constructor() {
    this.page = crypto.randomUUID();
    this.number = 0;
    /** `{name, text, field}`, the newest last. */
    this.kept = [];
  }

  /** The server has other texts. */
  forget() {
    this.kept.length = 0;
  }

  /** A request with its long texts named, and a name for the program of its answer. */
  pack(request) {
    const short = {}, texts = {};
    for (const [field, value] of Object.entries(request)) {
      const said = typeof value === "string" && value.length >= LONG ? this.name(field, value) : null;
      if (said) texts[field] = said;
      else short[field] = value;
    }
    if (request.do === "post") short.names = { nc: { keep: this.next(), of: this.last("nc")?.name } };
    return Object.keys(texts).length ? { ...short, texts } : short;
  }

  /** Puts the program into an answer that names it; false where it is said by another one that is gone. */
  unpack(answer) {
    const said = answer?.nc;
    if (typeof said?.keep !== "string") return true;
    if (said.of) {
      const other = this.kept.find(({ name }) => name === said.of);
      if (!other) return false;
      whole(answer, other.text);
    } else {
      answer.nc = said.text;
    }
    this.keep({ name: said.keep, text: answer.nc, field: "nc" });
    return true;
  }

  name(field, text) {
    const same = this.kept.find((each) => each.text === text);
    if (same) return { kept: same.name };
    const other = this.last(field), said = other ? { of: other.name, ...difference(other.text, text) } : { text };
    if (/[^\x00-\x7f]/.test(said.text)) return null;
    const keep = this.next();
    this.keep({ name: keep, text, field });
    return { keep, ...said };
  }

  next() {
    return `${this.page} ${++this.number}`;
  }

  last(field) {
    return this.kept.findLast((each) => each.field === field);
  }

  keep(text) {
    this.kept.push(text);
    if (this.kept.length > MOST) this.kept.shift();
  }
}
