// The page: texts at the left, the NC program that they make at the right.
import { Backend } from "./backend.js";
import { editor, markLines, program, setText, showFindings } from "./editors.js";
import * as languages from "./languages.js";
import { pack, unpack } from "./share.js";

/** Milliseconds without a key before a program is made. */
const REST = 300;

const find = (id) => document.getElementById(id);
const { bytes, examples } = globalThis.filpost;
const backend = new Backend(bytes(), globalThis.filpost.words);
const ask = (request) => backend.ask(request);
/** The module that draws, once somebody has asked for a plot. */
let drawer = null;

/** The input, each `{kind, name, view, box, tab}`. */
let files = [];
/** Further keys of the request, such as `set` and `allow`. */
let options = {};
/** The last answer. */
let posted = { origins: [] };
/** The plot is shown. Its page measures itself when it is loaded, so a hidden one is not. */
let plotted = false;
let timer = 0;
let round = 0;

const nc = program(find("nc"), {
  language: languages.nc,
  origin: (line) => originText(posted.origins[line - 1]),
  pointed: (line) => showOrigin(posted.origins[line - 1]),
});

function state() {
  const text = (file) => ({ name: file.name, text: file.view.state.doc.toString() });
  const one = (kind) => text(files.find((file) => file.kind === kind));
  const all = (kind) => files.filter((file) => file.kind === kind).map(text);
  const [fil, includes] = [all("fil"), all("include")];
  return { cl: one("cl"), machine: one("machine"), fil, includes, options };
}

function open(next) {
  files.forEach(({ view }) => view.destroy());
  find("editors").replaceChildren();
  find("tabs").replaceChildren();
  options = next.options ?? {};
  files = [];
  next.fil.forEach((file) => add("fil", file));
  next.includes?.forEach((file) => add("include", file));
  add("cl", next.cl);
  add("machine", next.machine);
  show(files[0]);
  post();
}

function add(kind, { name, text }) {
  const box = document.createElement("div");
  const tab = document.createElement("button");
  tab.type = "button";
  tab.setAttribute("role", "tab");
  tab.dataset.name = name;
  find("editors").append(box);
  find("tabs").append(tab);
  const file = { kind, name, box, tab };
  const language = kind === "include" ? "fil" : kind;
  const asked = (edited) => {
    if (language !== "fil") return { language, name, text: edited };
    const { machine, includes } = state();
    return { language, name, text: edited, machine: machine.text, includes };
  };
  file.asked = asked;
  file.view = editor(box, {
    text,
    language: languages[language],
    ask,
    file: asked,
    changed: () => {
      // What stands at the right is of the text before.
      find("status").textContent = "Changed…";
      clearTimeout(timer);
      timer = setTimeout(post, REST);
    },
  });
  tab.onclick = () => show(file);
  files.push(file);
  label(file, 0);
}

function label({ tab, name }, count) {
  const shown = document.createElement("span");
  shown.className = "count";
  shown.textContent = count ? String(count) : "";
  tab.replaceChildren(name, shown);
}

function show(chosen) {
  for (const file of files) {
    file.box.hidden = file !== chosen;
    file.tab.setAttribute("aria-selected", String(file === chosen));
  }
}

async function post() {
  const mine = ++round;
  const { cl, ...inputs } = state();
  delete inputs.options;
  const request = { do: "post", ...options, ...inputs, cl: cl.text, cl_name: cl.name };
  let answer, plot;
  try {
    answer = await ask(request);
    if (plotted && answer.nc !== undefined) plot = await plotOf(request, answer);
  } catch (error) {
    if (mine === round) say(`Not posted: ${error.message}`, []);
    return;
  }
  const lints = await Promise.all(files.map((file) => lintsOf(file)));
  // Of several answers the one to the newest text counts.
  if (mine === round) take(answer, plot, lints);
}

/** The page with the path of a program. */
async function plotOf({ machine, set, cl, cl_name, fil }, { nc, origins }) {
  drawer ??= loadScript("filpost-plot.wasm.js").then(() => {
    return new Backend(globalThis.filpost.plotBytes());
  });
  const request = { do: "plot", machine, set, cl, cl_name, fil, nc, origins };
  return (await drawer).ask(request);
}

function loadScript(name) {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.onload = resolve;
    script.onerror = () => {
      drawer = null;
      reject(new Error(`${name} can't be loaded`));
    };
    script.src = name;
    document.head.append(script);
  });
}

/** What fil-ide finds in FIL, also where nothing is posted. */
async function lintsOf(file) {
  if (file.kind !== "fil") return [];
  const request = { do: "findings", ...file.asked(file.view.state.doc.toString()) };
  const found = await ask(request).catch(() => []);
  return found.map(({ range: [line, from, toLine, to], ...finding }) => {
    return { ...finding, line: line + 1, from, toLine: toLine + 1, to };
  });
}

function take(answer, plot, lints) {
  const diags = [...(answer.errors ?? []), ...(answer.warnings ?? []), ...(plot?.errors ?? [])];
  files.forEach((file, index) => {
    const own = diags.flatMap((diag) => {
      const at = diag.places[0];
      return at?.file === file.name ? [{ ...diag, ...at }] : [];
    });
    const known = new Set(own.map(({ code, line }) => `${code}:${line}`));
    const further = lints[index].filter(({ code, line }) => !known.has(`${code}:${line}`));
    showFindings(file.view, [...own, ...further]);
    label(file, own.length + further.length);
  });
  files.forEach(({ view }) => markLines(view, []));
  posted = { origins: answer.origins ?? [] };
  setText(nc, answer.nc ?? "");
  if (plotted) draw(plot?.page ?? "<p>No program, no plot.</p>");
  const status = answer.misuse
    ? `Not posted: ${answer.misuse}`
    : answer.nc === undefined
      ? "Refused: no program is written."
      : `${answer.records} records, ${answer.blocks} blocks`;
  say(status, diags);
}

function say(status, diags) {
  find("status").textContent = status;
  find("findings").replaceChildren(...diags.map(listed));
}

function listed(diag) {
  const entry = document.createElement("li");
  const button = document.createElement("button");
  const code = document.createElement("b");
  const hint = document.createElement("span");
  const at = diag.places[0];
  entry.className = diag.severity;
  code.textContent = diag.code;
  hint.className = "hint";
  hint.textContent = [diag.hint, ...diag.notes].join("\n");
  const where = at ? ` ${at.file}:${at.line}` : "";
  button.append(code, `${where} ${diag.message}`, hint);
  button.type = "button";
  button.onclick = () => at && reveal(at.file, [at.line]);
  entry.append(button);
  return entry;
}

function reveal(name, lines) {
  const file = files.find((other) => other.name === name);
  if (!file) return;
  show(file);
  markLines(file.view, lines);
}

function lineOf(name, line) {
  const doc = files.find((file) => file.name === name)?.view.state.doc;
  return doc && line >= 1 && line <= doc.lines ? doc.line(line).text.trim() : "";
}

/** An origin is `[CL line, record, [[FIL file, line], …]]`. */
function originText(origin) {
  if (!origin) return "";
  const [line, , stack] = origin;
  const cl = files.find((file) => file.kind === "cl").name;
  const told = stack.map(([name, at]) => `${name}:${at}  ${lineOf(name, at)}`);
  if (line) told.unshift(`${cl}:${line}  ${lineOf(cl, line)}`);
  return told.join("\n") || "The machine's settings write this block.";
}

function showOrigin(origin) {
  if (!origin) return;
  const [line, , stack] = origin;
  for (const { kind, name, view } of files) {
    const lines = stack.filter(([file]) => file === name).map(([, at]) => at);
    markLines(view, kind === "cl" && line ? [line] : lines);
  }
}

function showOutput(plot) {
  if (plot === plotted) return;
  plotted = plot;
  find("plot").replaceChildren();
  find("plot").hidden = !plot;
  find("nc").hidden = plot;
  find("show-plot").setAttribute("aria-selected", String(plot));
  find("show-nc").setAttribute("aria-selected", String(!plot));
  if (plot) post();
}

/** Shows the page of a plot, which has no access to this one. */
function draw(page) {
  const frame = document.createElement("iframe");
  frame.title = "Plot of the program";
  frame.setAttribute("sandbox", "allow-scripts");
  frame.srcdoc = page;
  find("plot").replaceChildren(frame);
}

async function share() {
  location.hash = await pack(state());
  const copied = navigator.clipboard?.writeText(location.href) ?? Promise.reject();
  await copied.then(
    () => (find("said").textContent = "The link is in the clipboard."),
    () => (find("said").textContent = "The link is the address of this page."),
  );
}

function choose(index) {
  find("examples").value = String(index);
  open(examples[index]);
}

async function begin() {
  examples.forEach(({ title }, index) => find("examples").append(new Option(title, String(index))));
  find("examples").onchange = ({ target }) => {
    history.replaceState(null, "", location.pathname);
    choose(Number(target.value));
  };
  find("share").onclick = share;
  find("show-nc").onclick = () => showOutput(false);
  find("show-plot").onclick = () => showOutput(true);
  const shared = location.hash.length > 1 ? await unpack(location.hash.slice(1)) : null;
  if (shared) open(shared);
  else choose(0);
  if (location.hash.length > 1 && !shared) find("said").textContent = "The link can't be read.";
}

// For the console and the tests of the page.
globalThis.filpost.program = () => nc.state.doc.toString();
begin();
