// The page: the parts are put together here.
import { zipSync, strToU8 } from "fflate";
import { moduleBackend } from "./backends/module.js";
import { serverBackend } from "./backends/server.js";
import { Auditing } from "./auditing.js";
import { Cutting } from "./cutting.js";
import { Debugging } from "./debugging.js";
import { confirm, tell } from "./dialogs.js";
import { by, counted, el, tabs } from "./dom.js";
import { Files, isCl, isMesh } from "./files.js";
import { Findings } from "./findings.js";
import { Cases } from "./cases.js";
import { showView, startLayout, startViews } from "./layout.js";
import { startAudit } from "./panes/audit.js";
import { startCasebook } from "./panes/casebook.js";
import { Compare } from "./panes/compare.js";
import { startDebugger } from "./panes/debugger.js";
import { Editing } from "./panes/editing.js";
import { Form } from "./panes/form.js";
import { startJudging } from "./panes/judging.js";
import { startNaming } from "./panes/naming.js";
import { startOutline } from "./panes/outline.js";
import { PathPane } from "./panes/path.js";
import { Program } from "./panes/program.js";
import { startSearch } from "./panes/search.js";
import { startStock } from "./panes/stock.js";
import { startTree } from "./panes/tree.js";
import { MACHINE, Posting } from "./posting.js";
import { pack, unpack } from "./share.js";
import { startTheme } from "./theme.js";
import { chooseFiles, readAll, startPost } from "./start.js";

startTheme();

/** What the playground has beside the page: the examples, and later the modules and the pages of the post words. */
const parts = globalThis.filpost;
const backend = parts ? moduleBackend(parts) : serverBackend((is) => (by("lost").hidden = !is));
const { ask } = backend;
const files = new Files(backend);
const posting = new Posting(files, backend);
const cutting = new Cutting(files, posting, ask);
const auditing = new Auditing(posting, ask);
const form = new Form(files, posting, ask, { open, openForm: () => open(FORM), showLines });
const findings = new Findings(files, posting, [cutting, auditing], ask, form);
const debugging = new Debugging(files, posting, ask);
const editing = new Editing(files, posting, debugging, ask);
const program = new Program(files, posting, debugging, ask, { open });
const main = document.querySelector("main");
const path = new PathPane(files, posting, cutting, ask);
const cases = new Cases(files, posting, ask);
posting.recipeOf = (part) => cases.recipe(part);
const compare = new Compare(files, posting, cases, ask, { openNc });
const tree = startTree(files, { open: (name) => open(name), remove });

/** The pane of the form among the open files. */
const FORM = "the machine as a form";

async function open(name, line = null, units = 0) {
  try {
    await editing.show(name, line, units);
    showView("edit");
  } catch (error) {
    tell("Not opened", error.message);
  }
}

/** Shows a line of the program. */
function openNc(line) {
  programTabs.choose("tab-nc");
  program.goTo(line);
  showView("program");
}

/** Marks lines of the program. */
function showLines(lines) {
  programTabs.choose("tab-nc");
  program.mark(lines);
}

/** Shows where a run that is debugged stands, in the files and in the program. */
async function stand(answer) {
  // A script of a ready post is not among the files.
  const frames = (answer?.frames ?? []).filter(({ source }) => files.has(source.path));
  for (const { source, line } of [...frames].reverse()) await editing.show(source.path, line);
  editing.stand(frames.map(({ source, line }) => [source.path, line]));
  program.stand(answer?.stopped ? answer.blocks : null);
}

async function remove(name) {
  const sure = await confirm("Remove the file?", `${name} is removed from the folder.`, "Remove");
  if (sure) await files.remove(name).catch((error) => tell("Not removed", error.message));
}

async function save() {
  try {
    await files.saveAll();
  } catch (error) {
    tell("Not saved", error.message);
  }
}

/** Takes CL files, scripts and programs into the folder. */
function take(list) {
  for (const { name, text } of list) files.set(name, text);
  const cl = list.find(({ name }) => isCl(name));
  if (cl) choosePart(cl.name);
  if (list.length) open((cl ?? list[0]).name);
}

async function choosePart(name) {
  by("part").value = name;
  await posting.choose(name).catch((error) => tell("Not read", error.message));
}

function showParts() {
  const parts = files.names().filter(isCl);
  by("part").replaceChildren(...parts.map((name) => el("option", { value: name }, name)));
  by("part").disabled = !parts.length;
  if (posting.part && parts.includes(posting.part)) by("part").value = posting.part;
  else if (parts.length) choosePart(parts[0]);
}

function showStatus() {
  const { answer, part, isRunning } = posting;
  by("post-now").hidden = !posting.isLarge();
  by("stop").hidden = by("progress").hidden = !isRunning;
  // A bar without a value moves to and fro.
  if (posting.share === null) by("progress").removeAttribute("value");
  else by("progress").value = posting.share;
  const box = by("status");
  box.className = "";
  if (isRunning) box.textContent = "Posting…";
  else if (posting.isStopped) {
    box.textContent = "Stopped: the program is the one from before";
    box.className = "warning";
  }
  else if (!files.has(MACHINE)) box.textContent = "No post yet";
  else if (!part) box.textContent = "No CL file yet: add one";
  else if (answer?.nc !== undefined) {
    const warned = answer.warnings.length ? `, ${counted(answer.warnings.length, "warning")}` : "";
    box.textContent = `${counted(answer.blocks, "block")} of ${counted(answer.records, "record")}${warned}`;
    box.title = `${Math.round(posting.time)} ms`;
    box.className = warned ? "warning" : "good";
  } else if (answer) {
    box.textContent = "Refused: there is no program";
    box.className = "error";
  }
}

function showDirty() {
  const dirty = files.dirty();
  by("save").disabled = !dirty.length;
  by("save").textContent = dirty.length > 1 ? `Save ${dirty.length} files` : "Save";
}

posting.done.on(showStatus);
posting.moved.on(showStatus);
files.changed.on((name) => {
  showDirty();
  if (posting.reads(name) && !posting.isLarge()) by("status").className = "waiting";
});
files.listed.on(() => {
  showParts();
  showDirty();
});
findings.changed.on(() => editing.showFindings(findings.all()));
editing.chosen.on((name) => {
  tree.mark(name);
  editing.showFindings(findings.all());
});
editing.pointed.on((name, line) => program.markMadeBy(name, line));
program.pointed.on((line, places) => {
  editing.mark(places);
  path.select(line);
});
path.picked.on((line) => program.goTo(line));

by("part").addEventListener("change", (event) => choosePart(event.target.value));
by("post-now").addEventListener("click", () => posting.run());
by("stop").addEventListener("click", () => posting.stop());
by("save").addEventListener("click", save);
by("start").addEventListener("click", begin);
by("add").addEventListener("click", async () => take(await chooseFiles()));
document.addEventListener("keydown", (event) => {
  if ((event.ctrlKey || event.metaKey) && event.key === "s") {
    event.preventDefault();
    save();
  }
});
document.addEventListener("dragover", (event) => event.preventDefault());
document.addEventListener("drop", async (event) => {
  event.preventDefault();
  take(await readAll(event.dataTransfer.files));
});
window.addEventListener("beforeunload", (event) => {
  if (backend.keeps && files.dirty().length) event.preventDefault();
});

async function begin() {
  if (!(await startPost({ files, ask, examples: parts?.examples, takeExample }))) return;
  showParts();
  // A field that is typed in is one of this machine.
  await Promise.all([posting.run(), form.load()]);
  open(FORM);
}

/** Files of a case of the corpus, or of a link, in place of those that are there. */
async function takeState({ files: list, part }) {
  backend.put(list);
  posting.part = null;
  await files.load();
  await choosePart(part ?? files.names().find(isCl));
  findings.judge();
  form.load();
}

async function takeExample({ files: list, part, open: shown }) {
  await takeState({ files: list, part });
  open(shown ?? part);
  return false;
}

/** All files with their texts. */
async function allTexts() {
  const names = files.names();
  const texts = await Promise.all(names.map((name) => files.read(name)));
  return names.map((name, at) => ({ name, text: texts[at] }));
}

async function download() {
  const list = await allTexts();
  const nc = posting.answer?.nc;
  const all = nc === undefined ? list : [...list, { name: "program.nc", text: nc }];
  const zip = zipSync(Object.fromEntries(all.map(({ name, text }) => [name, strToU8(text, isMesh(name))])));
  const address = URL.createObjectURL(new Blob([zip], { type: "application/zip" }));
  el("a", { href: address, download: "post.zip" }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

async function share() {
  const packed = await pack({ files: await allTexts(), part: posting.part });
  location.hash = packed;
  const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
  tell("Shared", `All files are in the address of this page now${copied ? ", which was copied" : ""}: ${location.href.length.toLocaleString("en")} characters. Anyone who opens it sees the same.`);
}

startLayout();
startViews();
const programTabs = tabs(by("program-tabs"), (id) => id === "tab-compare" && compare.run());
const judgeTabs = tabs(by("judge-tabs"), (id) => {
  main.classList.toggle("path", id === "tab-path");
  main.classList.toggle("debug", id === "tab-debug");
  if (id === "tab-path") path.open();
});
startJudging(findings, { open, openNc });
startAudit(auditing, files, posting, { open, openNc, showLines });
startStock(cutting, files, posting, { open, showPath: () => judgeTabs.choose("tab-path") });
startDebugger(debugging, { open, openNc, stand });
startCasebook(cases, files, posting, {
  choosePart, save, openFile: open, showCovered: (covered) => editing.showCovered(covered),
  compare: () => {
    programTabs.choose("tab-compare");
    showView("program");
  },
});
startSearch(files, posting, editing, form, {
  open, openNc,
  choose: () => {
    judgeTabs.choose("tab-search");
    showView("judge");
  },
});
startNaming(files, editing, ask, { open });
startOutline(files, posting, editing, ask, { open });
editing.addPane(FORM, "Machine", form.box);

/** For the tests of the page: the text of a file, and a page without files. */
function openForTests() {
  parts.text = (name) => files.text(name);
  parts.program = () => posting.answer?.nc ?? "";
  parts.empty = async () => {
    backend.put([]);
    posting.part = null;
    await files.load();
    await posting.run();
    begin();
  };
}

/** The page without a server: what a link brings, else the first example. */
async function runAlone() {
  by("share").hidden = by("download").hidden = false;
  by("save").hidden = true;
  by("share").addEventListener("click", share);
  by("download").addEventListener("click", download);
  by("place").textContent = "playground";
  document.title = "filpost playground";
  openForTests();
  const packed = location.hash.slice(1);
  const state = packed ? await unpack(packed) : null;
  if (state) {
    await takeState(state);
    open(FORM);
  } else if (packed) {
    await takeExample(parts.examples[0]);
    tell("The link can't be read", "A part of the address is missing. This is the first example instead.");
  } else {
    await takeExample(parts.examples[0]);
  }
}

async function run() {
  if (!backend.keeps) return runAlone();
  await files.load().catch((error) => tell("The folder can't be read", error.message));
  by("place").textContent = files.folder;
  document.title = `${files.folder} – filpost studio`;
  findings.judge();
  await posting.run();
  open(FORM);
  form.load();
  if (!files.has(MACHINE)) begin();
}

run();
