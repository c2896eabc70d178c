// The pane of the stock: what is cut, with which tools, and what came of it.
import { by, counted, el } from "../dom.js";
import { folderOf, isMesh, nameFrom } from "../files.js";

const volume = (mm3) => `${Math.round(mm3).toLocaleString("en")} mm³`;

export function startStock(cutting, files, posting, { open, showPath }) {
  const stock = el("input", { type: "text", placeholder: "box:100x80x30", spellcheck: false, size: 24 });
  const part = el("select");
  const grid = el("input", { type: "text", placeholder: "by the size", spellcheck: false, size: 8 });
  const tools = el("textarea", { rows: 3, cols: 30, placeholder: "1 = D10R0.5L50H40x60", spellcheck: false });
  const edit = el("button", { type: "button", onclick: () => open(cutting.file()) }, "Edit the file");
  const run = el("button", { type: "button", onclick: () => cutting.run() }, "Cut");
  const see = el("button", { type: "button", onclick: showPath }, "Show in Path");
  by("stock-form").append(
    el("label", {}, "Stock ", stock), el("label", {}, "Part ", part), el("label", {}, "Cells ", grid),
    el("label", {}, "Tools ", tools), run, see, edit,
  );
  let shown = null;

  for (const input of [stock, part, grid, tools]) input.addEventListener("change", write);

  function write() {
    const sizes = tools.value.split("\n").map((line) => /^\s*(\d+)\s*[=:]?\s*(\S.*)$/.exec(line)).filter(Boolean);
    cutting.write({
      stock: stock.value.trim(), part: part.value, grid: grid.value.trim(),
      tools: Object.fromEntries(sizes.map(([, number, size]) => [number, size.trim()])),
    });
  }

  /** Shows what the setup file says; a file with comments is only edited as a text. */
  async function load() {
    const name = cutting.file(), text = name ? files.text(name) ?? await files.read(name) : "";
    const meshes = files.names().filter(isMesh).map((each) => nameFrom(folderOf(name ?? cutting.newFile()), each));
    const key = `${name} ${text} ${meshes.join("|")} ${posting.part}`;
    if (key === shown) return;
    shown = key;
    const keys = await cutting.keys().catch(() => null);
    if (key !== shown) return;
    for (const input of [stock, part, grid, tools]) input.disabled = !keys || /^\s*#/m.test(text);
    part.replaceChildren(el("option", { value: "" }, "none"), ...meshes.map((mesh) => el("option", { value: mesh }, mesh)));
    const sizes = Object.entries(keys?.tools ?? {}).map(([number, size]) => `${number} = ${size}`).join("\n");
    const values = [[stock, keys?.stock], [part, keys?.part], [grid, keys?.grid], [tools, sizes]];
    // What somebody is typing stays.
    for (const [input, value] of values) if (input !== document.activeElement) input.value = value ?? "";
    edit.hidden = !name;
  }

  function said({ findings, more, removed, removed_by_tool: byTool, stock: before, motions, cell, ends_only: ends, without_holder: bare }) {
    const tool = byTool.map((each) => `tool ${each.tool}: ${volume(each.volume)}`).join(", ");
    return [
      findings.length ? `${counted(findings.length + more, "finding")}, in the list of findings.` : "Nothing was found.",
      `Removed ${volume(removed)} of ${volume(before)}${tool ? ` (${tool})` : ""} in ${counted(motions, "motion")}, cells of ${Number(cell.toFixed(3))} mm.`,
      bare.length ? `The holder is not checked of ${bare.map((each) => `tool ${each}`).join(", ")}: it is not known.` : null,
      ends ? `${counted(ends, "rapid")} from or to an unknown position: at most the end was checked.` : null,
    ].filter(Boolean);
  }

  function show() {
    const { report, trouble, isRunning } = cutting;
    run.disabled = isRunning || !cutting.file() || !posting.answer?.nc;
    see.disabled = !report;
    const lines = isRunning ? ["Cutting…"]
      : report ? said(report)
      : trouble ? trouble.split("\n")
      : cutting.file()
        ? [cutting.isLarge ? "A long program: press Cut." : "Waits for a program."]
        : ["Enter the stock: box:100x80x30 (X0 Y0 is its left front corner, Z0 its top), cylinder:60x100, tube:60x20x100, auto, or an STL file. Tools come from the CL file; here are those that it does not describe: 1 = D10R0.5, on a lathe 1 = Q3R0.8 for an insert."];
    by("stock-said").replaceChildren(...lines.map((line) => el("p", { class: trouble && !isRunning ? "error" : "" }, line)));
    by("tab-stock").classList.toggle("bad", Boolean(report?.findings.length || trouble));
  }

  const follow = () => load().then(show);
  cutting.changed.on(follow);
  files.listed.on(follow);
  follow();
}
