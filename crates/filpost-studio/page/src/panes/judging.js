// The list of findings, each with its place, its hint and its repairs.
import { by, el } from "../dom.js";

export function startJudging(findings, { open, openNc }) {
  const list = by("findings");
  const tab = by("tab-findings");

  function place(finding) {
    if (finding.ncLine) return [`NC line ${finding.ncLine}`, () => openNc(finding.ncLine)];
    if (!finding.file) return ["", null];
    const line = finding.line ? `:${finding.line}` : "";
    return [`${finding.file}${line}`, () => open(finding.file, finding.line ?? 1, finding.from ?? 0)];
  }

  function item(finding) {
    const [where, go] = place(finding);
    const head = [
      el("b", { class: "code" }, finding.code || finding.severity),
      where ? el("span", { class: "where" }, where) : null,
      el("span", {}, finding.message),
    ];
    const fixes = finding.fixes.map((fix) => {
      return el("button", { type: "button", class: "repair", onclick: () => findings.repair(fix) }, `Repair: ${fix.title}`);
    });
    const others = (finding.places ?? []).slice(1).map((other) => {
      return el("button", { type: "button", class: "other", onclick: () => open(other.file, other.line, other.from) },
        `${other.file}:${other.line}${other.label ? ` ${other.label}` : ""}`);
    });
    return el(
      "li",
      { class: finding.severity },
      go ? el("button", { type: "button", class: "finding", onclick: go }, ...head) : el("span", { class: "finding" }, ...head),
      finding.hint ? el("span", { class: "hint" }, finding.hint) : null,
      ...(finding.notes ?? []).map((note) => el("span", { class: "hint" }, note)),
      ...others,
      ...fixes,
    );
  }

  function show() {
    const all = findings.all();
    list.replaceChildren(...all.map(item));
    if (!all.length && !findings.verdict) list.append(el("li", { class: "quiet" }, "Nothing was found."));
    tab.replaceChildren("Findings ", el("span", { class: "count" }, all.length ? String(all.length) : ""));
    by("checked").textContent = findings.verdict;
    tab.classList.toggle("bad", all.some(({ severity }) => severity === "error"));
  }

  findings.changed.on(show);
  show();
}
