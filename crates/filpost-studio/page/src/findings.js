// All that is wrong or doubtful: of posting, of the texts, of the check against the CL file, and of others who judge.
import { debounced, signal } from "./dom.js";
import { applyEdits, kindOf } from "./files.js";

/** Longest program that is checked by itself, characters. */
const MOST_CHECKED = 3_000_000;

const ORDER = { error: 0, warning: 1, advice: 2, info: 2, note: 3 };

export class Findings {
  /** `judges` have findings of their own: the stock that is cut, the audit. */
  constructor(files, posting, judges, ask) {
    Object.assign(this, { files, posting, judges, ask });
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
      this.checked = answer.findings.map((found) => ({
        source: "verify", severity: "warning", code: "verify", message: found.message, hint: "", fixes: [],
        ncLine: found.nc_line, file: this.posting.part, line: found.cl_line,
      }));
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
    const seen = new Set();
    const once = (finding) => {
      const key = `${finding.code} ${finding.file} ${finding.line} ${["verify", "audit", "stock"].includes(finding.source) || !finding.code ? finding.message : ""}`;
      return !seen.has(key) && seen.add(key);
    };
    // Those of the texts come first, as they bring repairs.
    const all = [...this.ofTexts, ...this.posted, ...this.checked, ...this.judges.flatMap((judge) => judge.findings())].filter(once);
    return all.sort((a, b) => (ORDER[a.severity] ?? 2) - (ORDER[b.severity] ?? 2));
  }

  /** Does a repair. */
  repair(fix) {
    applyEdits(this.files, fix.edits);
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
      notes: diag.notes, places: diag.places, fixes: [],
    };
  });
}
