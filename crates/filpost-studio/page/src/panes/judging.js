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
    // A setting that is only shown, and a doubt that is set aside, repair nothing.
    const isQuiet = ({ title, show }) => show || title.startsWith("allow ");
    const fixes = finding.fixes.map((fix) => el("button", {
      type: "button", class: isQuiet(fix) ? "other" : "repair", onclick: () => findings.repair(fix),
    }, isQuiet(fix) ? `${fix.title[0].toUpperCase()}${fix.title.slice(1)}` : `Repair: ${fix.title}`));
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
    const count = all.filter(({ severity }) => severity !== "note").length;
    tab.replaceChildren("Findings ", el("span", { class: "count" }, count ? String(count) : ""));
    by("checked").textContent = findings.verdict;
    tab.classList.toggle("bad", all.some(({ severity }) => severity === "error"));
  }

  findings.changed.on(show);
  show();
}
