// All that is wrong or doubtful: of posting, of the texts, of the check against the CL file, and of others who judge.
import { tell } from "./dialogs.js";
import { debounced, signal } from "./dom.js";
import { applyEdits, kindOf } from "./files.js";

/** A statement of FIL or CL that writes blocks by itself, on one line. */
const WRITES = /^\s*(POSTN|INSERT)\b[^$]*$/i;

/** Longest program that is checked by itself, characters. */
const MOST_CHECKED = 3_000_000;

const ORDER = { error: 0, warning: 1, advice: 2, info: 2, note: 3 };

export class Findings {
  /** `judges` have findings of their own: the stock that is cut, the audit. `form` sets and shows settings. */
  constructor(files, posting, judges, ask, form) {
    Object.assign(this, { files, posting, judges, ask, form });
    this.posted = [];
    this.ofTexts = [];
    this.checked = [];
    /** What the check against the CL file came to, in words. */
    this.verdict = "";
    this.changed = signal();
    const check = debounced(400, () => this.check());
    const later = debounced(300, () => this.judge());
    files.changed.on((name, by) => by !== "save" && ["fil", "machine"].includes(kindOf(name)) && later());
    files.listed.on(later);
    for (const judge of judges) judge.changed.on(() => this.changed.tell());
    posting.done.on(() => {
      this.posted = postedFindings(posting.answer);
      this.checked = [];
      this.verdict = "";
      this.changed.tell();
      check();
    });
  }

  /** Checks the program against the CL file, with the reader that shares no code with the post. */
  async check() {
    const request = this.posting.request();
    const nc = this.posting.answer?.nc;
    if (!request || nc === undefined || nc.length > MOST_CHECKED) return;
    // Without FIL the CL file says what must be done: what a script adds is found too.
    const { fil: _, ...asked } = request;
    const answer = await this.ask({ ...asked, do: "verify", nc }).catch((error) => ({ errors: [{ message: error.message }] }));
    if (this.posting.answer?.nc !== nc) return;
    if (!answer.verdict) {
      this.verdict = `The program can't be checked: ${(answer.errors?.[0]?.message ?? answer.misuse)}`;
    } else {
      const found = answer.findings.map((finding) => ({
        source: "verify", severity: "warning", code: "verify", message: finding.message, hint: "", fixes: finding.repairs,
        ncLine: finding.nc_line, file: this.posting.part, line: finding.cl_line,
      }));
      const open = answer.not_compared.map(({ cl_line: line, what, repairs }) => ({
        source: "verify", severity: "note", code: "verify", message: `Not compared: ${what}`, hint: "", fixes: repairs,
        file: this.posting.part, line,
      }));
      this.checked = [...found, ...open];
      this.verdict = {
        agrees: `Checked against the CL file: all ${answer.motions.asked} motions agree.`,
        partly: "Checked against the CL file: what could be compared agrees, not all could.",
        differs: `Checked against the CL file without its scripts: ${answer.findings.length + answer.more} findings.`,
      }[answer.verdict];
    }
    this.changed.tell();
  }

  /** Asks what is wrong in the machine and in the scripts, and how it is repaired. */
  async judge() {
    const { fil, includes } = this.posting.scripts();
    const machine = this.posting.machine();
    const texts = fil.map(({ name, text }) => ({ language: "fil", name, text, machine: machine?.text, includes }));
    if (machine) texts.push({ language: "machine", ...machine });
    const answers = texts.map((file) => this.judgeText(file).catch(() => []));
    this.ofTexts = (await Promise.all(answers)).flat();
    this.changed.tell();
  }

  async judgeText(file) {
    const [found, fixes] = await Promise.all([
      this.ask({ do: "findings", ...file }),
      this.ask({ do: "fixes", ...file }),
    ]);
    return found.map(({ range: [line, from, toLine, to], code, severity, message }) => {
      const [said, ...hint] = message.split("\n");
      const mine = fixes.filter((fix) => fix.code === code && fix.line === line);
      return {
        source: "text", file: file.name, line: line + 1, from, toLine: toLine + 1, to,
        code, severity, message: said, hint: hint.join(" "), fixes: mine,
      };
    });
  }

  /** All findings, errors first, each place and code once. */
  all() {
    const all = new Map();
    for (const finding of [...this.ofTexts, ...this.posted, ...this.checked, ...this.judges.flatMap((judge) => judge.findings())]) {
      const key = `${finding.code} ${finding.file} ${finding.line} ${["verify", "audit", "stock"].includes(finding.source) || !finding.code ? finding.message : ""}`;
      const known = all.get(key) ?? { ...finding, fixes: this.withdrawals(finding) };
      const isNew = ({ title }) => known.fixes.every((fix) => fix.title !== title);
      all.set(key, { ...known, fixes: [...known.fixes, ...finding.fixes.filter(isNew)] });
    }
    return [...all.values()].sort((a, b) => (ORDER[a.severity] ?? 2) - (ORDER[b.severity] ?? 2));
  }

  /** What takes back the block of a finding of a check: its statement becomes a comment. */
  withdrawals({ source, ncLine }) {
    const origin = ["verify", "audit"].includes(source) && ncLine ? this.posting.origin(ncLine) : null;
    if (!origin) return [];
    const [file, line] = origin.fil[0] ?? [this.posting.part, origin.cl];
    if (!WRITES.test(this.files.text(file)?.split("\n")[line - 1] ?? "")) return [];
    return [{ title: `make ${file}:${line} a comment`, edits: [{ file, range: [line - 1, 0, line - 1, 0], text: "$$ " }] }];
  }

  /** Does a repair. */
  async repair({ edits, set, show }) {
    if (show) return this.form.showSetting(show);
    if (edits) return applyEdits(this.files, edits);
    const why = await this.form.set(...set);
    if (why) tell("Not repaired", why);
  }
}

function postedFindings(answer) {
  if (!answer) return [];
  if (answer.failure || answer.misuse) {
    return [{ source: "post", severity: "error", code: "", message: answer.failure ?? answer.misuse, hint: "", fixes: [] }];
  }
  return [...(answer.errors ?? []), ...(answer.warnings ?? [])].map((diag) => {
    const [place] = diag.places;
    return {
      source: "post", file: place?.file, line: place?.line, from: place?.from, to: place?.to,
      code: diag.code, severity: diag.severity, message: diag.message, hint: diag.hint,
      notes: diag.notes, places: diag.places, fixes: diag.repairs ?? [],
    };
  });
}
