// The audit as a list: each change with who made it, and the ways to its FIL line, its records and its blocks.
import { by, el, prose } from "../dom.js";

/** Most records and blocks of a change that have a button. */
const MOST_PLACES = 4;

/** Who made a change, in words, and the FIL line where there is one. */
function madeBy(author) {
  switch (author.kind) {
    case "insert": return { name: "INSERT of the CL file", place: null };
    case "post": return author.after
      ? { name: `the post, after ${madeBy(author.after).name}`, place: madeBy(author.after).place }
      : { name: "the post, by what a script has set", place: null };
    default: {
      const place = author.file ? [author.file, author.line] : null;
      return { name: [place?.join(":"), author.section && `section ${author.section}`].filter(Boolean).join(", "), place };
    }
  }
}

export function startAudit(auditing, files, posting, { open, openNc, showLines }) {
  const list = by("audit-changes"), tab = by("tab-audit"), now = by("audit-now");
  now.addEventListener("click", () => auditing.run());

  /** Shows where a change comes from, and marks its blocks. */
  function go({ author, cl_lines: cl, nc_lines: nc }) {
    const { place } = madeBy(author);
    showLines(nc);
    // A script of a ready post is not among the files.
    if (place && files.has(place[0])) open(...place);
    else if (cl[0]) open(posting.part, cl[0]);
  }

  function item(change) {
    const { author, cl_lines: cl, nc_lines: nc, text } = change;
    const jump = (word, act) => (line) => el("button", { type: "button", class: "other", onclick: () => act(line) }, `${word} line ${line}`);
    return el(
      "li", {},
      el("button", { type: "button", class: "finding", onclick: () => go(change) },
        el("span", { class: "where" }, madeBy(author).name), el("span", {}, ...prose(text))),
      el("span", { class: "ways" },
        ...cl.filter(Boolean).slice(0, MOST_PLACES).map(jump("CL", (line) => open(posting.part, line))),
        ...nc.slice(0, MOST_PLACES).map(jump("NC", openNc))),
    );
  }

  function show() {
    const { report } = auditing;
    const count = report ? report.changes.length + report.more_changes : 0;
    tab.replaceChildren("Audit ", el("span", { class: "count" }, count ? String(count) : ""));
    tab.classList.toggle("bad", report?.verdict === "faulty");
    by("audit-said").textContent = auditing.said();
    now.hidden = !auditing.isLarge || auditing.isRunning || Boolean(report) || posting.answer?.nc === undefined;
    list.replaceChildren(
      ...(report?.changes ?? []).map(item),
      ...(report?.more_changes ? [el("li", { class: "quiet" }, `and ${report.more_changes} more`)] : []),
      ...(report?.not_compared ?? []).map((what) => el("li", { class: "quiet" }, `Not compared: ${what}`)),
    );
  }

  auditing.changed.on(show);
  show();
}
