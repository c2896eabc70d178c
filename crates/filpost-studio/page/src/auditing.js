// The audit: what scripts and INSERT changed in the program, and whether the rest does what the CL file asks for.
import { counted, debounced, signal } from "./dom.js";

/** Longest CL text whose program is audited by itself, characters: it is posted up to three times more. */
const MOST_AUDITED = 1_000_000;

export class Auditing {
  constructor(posting, ask) {
    Object.assign(this, { posting, ask });
    /** The answer for the program that is shown; null where there is none. */
    this.report = null;
    /** Why there is none, in a sentence. */
    this.trouble = "";
    this.isRunning = false;
    this.asked = 0;
    this.changed = signal();
    const later = debounced(700, () => this.run());
    posting.done.on(() => {
      Object.assign(this, { report: null, trouble: "", isRunning: false });
      this.asked += 1;
      this.changed.tell();
      if (!this.isLarge) later();
    });
  }

  get isLarge() {
    return (this.posting.request()?.cl.length ?? 0) > MOST_AUDITED;
  }

  async run() {
    const request = this.posting.request();
    if (!request || this.posting.answer?.nc === undefined) return;
    const number = ++this.asked;
    this.isRunning = true;
    this.changed.tell();
    const answer = await this.ask({ ...request, do: "audit" }).catch((error) => ({ misuse: error.message }));
    // Another program has been posted: this audit is not of it.
    if (number !== this.asked) return;
    this.isRunning = false;
    if (answer.verdict) this.report = answer;
    else this.trouble = answer.misuse ?? answer.errors.map(({ code, message }) => `${code}: ${message}`).join("\n");
    this.changed.tell();
  }

  /** Faults of the post and blocks that break a rule, for the list of findings. */
  findings() {
    return (this.report?.findings ?? []).map(({ message, nc_line: ncLine, cl_line: line, repairs: fixes }) => ({
      source: "audit", severity: "warning", code: "audit", message, hint: "", fixes, ncLine,
      file: this.posting.part, line: line ?? this.posting.origin(ncLine)?.cl,
    }));
  }

  /** What it came to, in a sentence. */
  said() {
    if (this.trouble) return `The program can't be audited: ${this.trouble}`;
    if (this.isRunning) return "Posting once more without the scripts…";
    if (!this.report) return this.posting.answer?.nc === undefined ? "There is no program." : "";
    const { changes, more_changes: more, findings, motions, blocks, more: moreFindings } = this.report;
    const count = changes.length + more, wrong = findings.length + moreFindings;
    return [
      count ? `${counted(count, "change")} by scripts and INSERT.` : "Scripts and INSERT change no block.",
      motions ? `${motions.made} of ${counted(motions.asked, "motion")} of the CL file are made by the post as it asks.` : "",
      `${blocks.as_the_post} of ${counted(blocks.all, "block")} are as the post alone writes them.`,
      wrong ? `${counted(wrong, "fault")} among the findings.` : "",
    ].filter(Boolean).join(" ");
  }
}
