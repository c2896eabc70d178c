// Long texts are sent once: later requests name them, or say what is different in them.

/** Shortest text that is named, characters. */
const LONG = 100_000;

/** Texts that are known on both sides; the server keeps as many. */
const MOST = 4;

/** The first UTF-16 unit in which two texts differ. */
function sameStart(one, other) {
  const shorter = Math.min(one.length, other.length);
  let at = 0;
  while (at < shorter && one.charCodeAt(at) === other.charCodeAt(at)) at += 1;
  return at;
}

/** How many units are the same at the ends of two texts, without their first ones. */
function sameEnd(one, other, start) {
  const shorter = Math.min(one.length, other.length) - start;
  let count = 0;
  while (count < shorter && one.charCodeAt(one.length - 1 - count) === other.charCodeAt(other.length - 1 - count)) count += 1;
  return count;
}

/** What a page has sent. Places are bytes of the server, so only texts in ASCII are named. */
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

  /** A request with its long texts named. */
  pack(request) {
    const short = {}, texts = {};
    for (const [field, value] of Object.entries(request)) {
      const said = typeof value === "string" && value.length >= LONG ? this.name(field, value) : null;
      if (said) texts[field] = said;
      else short[field] = value;
    }
    return Object.keys(texts).length ? { ...short, texts } : request;
  }

  name(field, text) {
    const same = this.kept.find((each) => each.text === text);
    if (same) return { kept: same.name };
    if (/[^\x00-\x7f]/.test(text)) return null;
    const name = `${this.page} ${++this.number}`;
    const other = this.kept.findLast((each) => each.field === field);
    this.kept.push({ name, text, field });
    if (this.kept.length > MOST) this.kept.shift();
    if (!other) return { keep: name, text };
    const from = sameStart(other.text, text), end = sameEnd(other.text, text, from);
    return { keep: name, of: other.name, from, to: other.text.length - end, text: text.slice(from, text.length - end) };
  }
}
