// The list of the cases, and how each ended.
import { askText, tell } from "../dialogs.js";
import { by, counted, el } from "../dom.js";
import { folderOf } from "../files.js";

/** Most places of a script that no case runs, in the list. */
const MOST_MISSED = 12;

const WORDS = { passed: "passed", failed: "failed", skipped: "not run" };

export function startCasebook(cases, files, posting, { choosePart, compare, save, openFile, showCovered }) {
  const list = by("cases");
  const tab = by("tab-cases");
  let results = new Map();

  function show() {
    const names = cases.names();
    const failed = names.filter((name) => results.get(name)?.state === "failed").length;
    tab.replaceChildren("Cases ", el("span", { class: "count" }, names.length ? String(names.length) : ""));
    tab.classList.toggle("bad", failed > 0);
    by("run-cases").disabled = !names.length;
    by("save-case").disabled = !posting.answer?.nc;
    list.replaceChildren(...names.map((name) => {
      const result = results.get(name);
      return el(
        "li",
        { class: result?.state ?? "" },
        el("button", { type: "button", class: "finding", title: "Post this case's part", onclick: () => open(name) }, el("b", {}, folderOf(name) || name)),
        el("span", { class: "state" }, result ? WORDS[result.state] : ""),
        result?.why ? el("span", { class: "hint" }, result.why) : null,
        result?.state === "failed" && result.cl
          ? el("button", { type: "button", class: "other", onclick: () => open(name).then(compare) }, "Compare")
          : null,
      );
    }));
    if (!names.length) list.append(el("li", { class: "quiet" }, "There is no case yet. A case keeps a part with the program that it must give."));
  }

  async function open(name) {
    const keys = await cases.keys(name).catch((error) => tell("The case can't be read", error.message));
    if (keys?.cl) await choosePart(`${folderOf(name)}/${keys.cl}`.replace(/^\//, ""));
  }

  async function run() {
    by("run-cases").disabled = true;
    results = new Map();
    for (const name of cases.names()) {
      results.set(name, await cases.run(name));
      show();
    }
    const states = [...results.values()].map(({ state }) => state);
    const count = (state) => states.filter((each) => each === state).length;
    by("cases-said").textContent = `${counted(count("passed"), "case")} passed, ${count("failed")} failed${count("skipped") ? `, ${count("skipped")} not run` : ""}`;
    by("run-cases").disabled = false;
    showCoverage(await cases.coverage().catch(() => []));
  }

  /** Says what of each script the cases run, and marks in its editor what none does. */
  function showCoverage(covered) {
    showCovered(covered);
    by("coverage").replaceChildren(...covered.filter(({ line_share: [, all] }) => all).map(({ name, lines, line_share, branch_share, never }) => {
      const missed = lines.filter(([, count]) => !count).map(([line]) => [line, `line ${line} never ran`]);
      const of = ([hit, all], what) => all ? `${hit} of ${counted(all, what)}` : null;
      const known = files.has(name);
      return el("li", {},
        el("b", {}, name), " ", [of(line_share, "line"), of(branch_share, "outcome")].filter(Boolean).join(", "), " run by the cases",
        ...[...missed, ...never].slice(0, MOST_MISSED).map(([line, text]) => known
          ? el("button", { type: "button", class: "other", onclick: () => openFile(name, line) }, text)
          : el("span", { class: "hint" }, text)),
        missed.length + never.length > MOST_MISSED ? el("span", { class: "hint" }, `and ${missed.length + never.length - MOST_MISSED} more`) : null);
    }));
  }

  by("run-cases").addEventListener("click", run);
  by("save-case").addEventListener("click", async () => {
    const taken = cases.names().length + 1;
    const name = await askText("Save a case", "Name of its folder in cases/", `case-${taken}`, "Save");
    if (!name) return;
    if (!/^[\w][\w .-]*$/.test(name) || files.has(`cases/${name}/case.toml`)) {
      await tell("Not saved", `cases/${name} is there already, or is no name of a folder.`);
      return;
    }
    cases.save(name);
    await save();
    results.delete(`cases/${name}/case.toml`);
    show();
  });
  files.listed.on(show);
  posting.done.on(show);
  files.changed.on(() => {
    if (results.size) {
      results = new Map();
      by("cases-said").textContent = "";
      showCoverage([]);
      show();
    }
  });
  show();
}
