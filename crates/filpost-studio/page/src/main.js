// The page: the parts are put together here.
import { serverBackend } from "./backends/server.js";
import { askText, confirm, tell } from "./dialogs.js";
import { by, counted, el, tabs } from "./dom.js";
import { Files, isCl } from "./files.js";
import { Findings } from "./findings.js";
import { showView, startLayout, startViews } from "./layout.js";
import { Editing } from "./panes/editing.js";
import { startJudging } from "./panes/judging.js";
import { PathPane } from "./panes/path.js";
import { Program } from "./panes/program.js";
import { startTree } from "./panes/tree.js";
import { MACHINE, Posting } from "./posting.js";
import { chooseFiles, readAll, startPost } from "./start.js";

const backend = serverBackend((is) => (by("lost").hidden = !is));
const { ask } = backend;
const files = new Files(backend);
const posting = new Posting(files, ask);
const findings = new Findings(files, posting, ask);
const editing = new Editing(files, posting, ask);
const program = new Program(files, posting, { open });
const main = document.querySelector("main");
const path = new PathPane(files, posting, ask);
const tree = startTree(files, { open: (name) => open(name), remove });

async function open(name, line = null, units = 0) {
  try {
    await editing.show(name, line, units);
    showView("edit");
  } catch (error) {
    tell("Not opened", error.message);
  }
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
  const box = by("status");
  box.className = "";
  if (isRunning) box.textContent = "Posting…";
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
files.changed.on(() => {
  showDirty();
  if (!posting.isLarge()) by("status").className = "waiting";
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
  if (!(await startPost({ files, ask }))) return;
  showParts();
  await posting.run();
  open(MACHINE);
}

startLayout();
startViews();
tabs(by("program-tabs"));
tabs(by("judge-tabs"), (id) => {
  main.classList.toggle("path", id === "tab-path");
  if (id === "tab-path") path.open();
});
startJudging(findings, {
  open,
  openNc: (line) => {
    program.goTo(line);
    showView("program");
  },
});

async function run() {
  await files.load().catch((error) => tell("The folder can't be read", error.message));
  by("place").textContent = files.folder;
  document.title = `${files.folder} – filpost studio`;
  findings.judge();
  await posting.run();
  if (files.has(MACHINE)) await open(files.has("post.fil") ? "post.fil" : MACHINE);
  else begin();
}

run();
