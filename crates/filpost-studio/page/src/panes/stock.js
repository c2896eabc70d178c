// The pane of the stock: what is cut, with which tools, and what came of it.
import { by, counted, el } from "../dom.js";
import { folderOf, isMesh, nameFrom } from "../files.js";

const volume = (mm3) => `${Math.round(mm3).toLocaleString("en")} mm³`;

export function startStock(cutting, files, posting, { open, showPath }) {
  const stock = el("input", { type: "text", placeholder: "box:100x80x30", spellcheck: false, size: 24 });
  const part = el("select");
  const grid = el("input", { type: "text", placeholder: "by the size", spellcheck: false, size: 8 });
  const tools = el("textarea", { rows: 3, cols: 30, placeholder: "1 = D10R0.5L50H40x60", spellcheck: false });
  const edit = el("button", { type: "button", onclick: () => open(cutting.setup.name) }, "Edit the file");
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

  /** Shows the setup; a file with comments, and that of a case, is only edited as text. What the machine gives is gray. */
  function load() {
    const { name, isCase, own, below } = cutting.setup, text = name ? files.text(name) ?? "" : "";
    const meshes = files.names().filter(isMesh).map((each) => nameFrom(folderOf(name ?? cutting.newFile()), each));
    const key = JSON.stringify([cutting.setup, text, meshes, posting.part]);
    if (key === shown) return;
    shown = key;
    for (const input of [stock, part, grid, tools]) input.disabled = isCase || Boolean(cutting.setup.trouble) || /^\s*#/m.test(text);
    const none = below.part ? `${below.part} (machine)` : "none";
    part.replaceChildren(el("option", { value: "" }, none), ...meshes.map((mesh) => el("option", { value: mesh }, mesh)));
    const sizes = (of) => Object.entries(of.tools ?? {}).map(([number, size]) => `${number} = ${size}`).join("\n");
    stock.placeholder = below.stock ?? "box:100x80x30";
    grid.placeholder = String(below.grid ?? "by the size");
    tools.placeholder = sizes(below) || "1 = D10R0.5L50H40x60";
    const values = [[stock, own.stock], [part, own.part], [grid, own.grid], [tools, sizes(own)]];
    // What somebody is typing stays.
    for (const [input, value] of values) if (input !== document.activeElement) input.value = value ?? "";
    edit.hidden = !name;
  }

  /** Where the stock and the tools come from, if not from the form alone. */
  function source() {
    const { name, isCase, below } = cutting.setup;
    const from = [isCase ? `[simulate] of ${name}` : null, Object.keys(below).length ? "[simulate] of machine.toml" : null].filter(Boolean);
    return from.length ? `Also from ${from.join(" and ")}.` : null;
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
    const { stock: given } = cutting.setup.keys;
    run.disabled = isRunning || !given || !posting.answer?.nc;
    see.disabled = !report;
    const lines = isRunning ? ["Cutting…"]
      : report ? said(report)
      : trouble ? trouble.split("\n")
      : given
        ? [cutting.isLarge ? "A long program: press Cut." : "Waits for a program."]
        : ["Enter the stock: box:100x80x30 (X0 Y0 is its left front corner, Z0 its top), cylinder:60x100, tube:60x20x100, auto, or an STL file. Tools come from the CL file; here are those that it does not describe: 1 = D10R0.5, on a lathe 1 = Q3R0.8 for an insert."];
    by("stock-said").replaceChildren(...[...lines, source()].filter(Boolean).map((line) => el("p", { class: trouble && !isRunning ? "error" : "" }, line)));
    by("tab-stock").classList.toggle("bad", Boolean(report?.findings.length || trouble));
  }

  cutting.changed.on(() => (load(), show()));
  cutting.look();
}
