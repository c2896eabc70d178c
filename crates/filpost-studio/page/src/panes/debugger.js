// The pane of the debugger: steps, where the run is stopped, breakpoints and values.
import { by, counted, el } from "../dom.js";
import { NC } from "../debugging.js";

/** What the buttons do, and their keys. */
const BUTTONS = [
  ["run", "Continue", "F8: to the next breakpoint"],
  ["over", "Over", "F10: to the next statement of this level, or the next record"],
  ["in", "Into", "F7: to the next statement or record"],
  ["out", "Out", "To the end of this section or macro"],
  ["record", "Next record", "To the next CL record"],
  ["block", "Next block", "Until a block is written"],
  ["back", "Back", "Shift-F10: to the statement or record before"],
  ["block back", "Block back", "To where the block before was written"],
];

const KEYS = { F8: "run", F10: "over", F7: "in" };

const REASONS = { step: "Stopped at", breakpoint: "Breakpoint at", "function breakpoint": "Breakpoint:", "data breakpoint": "Changed:", exception: "Refused:" };

export function startDebugger(debugging, { open, openNc, stand }) {
  const place = by("debug-place");
  const unfolded = new Set(["Parameters", "Names", "Record", "Control"]);
  const buttons = new Map(BUTTONS.map(([step, text, title]) => [
    step, el("button", { type: "button", title, onclick: () => go(step) }, text),
  ]));
  const end = el("button", { type: "button", title: "End the run", onclick: () => debugging.end() }, "End");
  by("debug-steps").append(...buttons.values(), end);
  const stopAt = el("input", { type: "text", placeholder: "record CYCLE, block G83, macro NAME, watch XX", spellcheck: false, size: 34 });
  const watch = el("input", { type: "text", placeholder: "XX*2", spellcheck: false, size: 14 });
  by("debug-stops").before(
    form("Stop at ", stopAt, (text) => debugging.add(text)),
  );
  by("debug-watched").before(form("Show ", watch, (text) => {
    debugging.watched.push(text);
    debugging.look();
  }));

  function form(label, input, take) {
    return el("form", {
      class: "bar", onsubmit: (event) => {
        event.preventDefault();
        if (input.value.trim()) take(input.value.trim());
        input.value = "";
      },
    }, el("label", {}, label, input), el("button", { type: "submit" }, "Add"));
  }

  async function go(step) {
    await debugging.step(step);
    await stand(debugging.answer);
  }

  function where({ stopped, frames, blocks, refusal }) {
    if (refusal) return [el("p", { class: "error" }, refusal)];
    if (!stopped) return [el("p", {}, "The run is over. Nothing stopped it any more.")];
    return [
      el("p", {}, el("b", {}, REASONS[stopped.reason] ?? stopped.reason), stopped.text ? ` ${stopped.text}` : ""),
      el("ol", { class: "list frames" }, ...frames.map(({ name, source, line }) => {
        return el("li", {}, el("button", { type: "button", class: "finding", onclick: () => open(source.path, line) },
          el("span", { class: "where" }, `${source.path}:${line}`), el("span", {}, name)));
      })),
      blocks
        ? el("button", { type: "button", class: "other", onclick: () => openNc(blocks) }, `${counted(blocks, "block")} written`)
        : el("p", { class: "quiet" }, "No block is written yet."),
    ];
  }

  function stops() {
    const placed = debugging.answer?.placed ?? [];
    const hits = new Set(debugging.stopped?.hits ?? []);
    return debugging.breakpoints().map((stop, at) => {
      const line = stop.nc ?? stop.line;
      const name = stop.name ?? (stop.watch ? `watch ${stop.watch}` : `${stop.nc ? NC : stop.file}:${line}`);
      const condition = line && el("input", {
        type: "text", value: stop.condition ?? "", placeholder: "only if, such as XX.GT.5", spellcheck: false, size: 20,
        "aria-label": `Condition of ${name}`, onchange: (event) => debugging.setCondition(stop, event.target.value.trim()),
      });
      const { why, line: real } = placed[at] ?? {};
      return el("li", { class: hits.has(at) ? "hit" : "" },
        line
          ? el("button", { type: "button", class: "finding", onclick: () => (stop.nc ? openNc(line) : open(stop.file, line)) }, name)
          : el("span", { class: "finding" }, name),
        real && real !== line ? el("span", { class: "hint" }, `stops in line ${real}`) : null,
        why ? el("span", { class: "hint" }, why) : null,
        condition || null,
        el("button", { type: "button", class: "remove", "aria-label": `Remove ${name}`, title: "Remove", onclick: () => debugging.remove(stop) }, "×"));
    });
  }

  /** The values of a scope; those of arrays one by one. */
  function scope({ name, variables }) {
    const row = (variable) => [
      el("tr", {}, el("th", { scope: "row" }, variable.name), el("td", {}, variable.value)),
      ...(variable.elements ?? []).map((one) => el("tr", { class: "element" }, el("th", { scope: "row" }, `${variable.name}(${one.name})`), el("td", {}, one.value))),
    ];
    const box = el("details", { class: "scope", open: unfolded.has(name) },
      el("summary", {}, name, el("span", { class: "count" }, ` ${variables.length}`)),
      el("table", {}, el("tbody", {}, ...variables.flatMap(row))));
    box.addEventListener("toggle", () => (box.open ? unfolded.add(name) : unfolded.delete(name)));
    return box;
  }

  function watchedRow(text, at) {
    const { value, why } = debugging.answer?.watched?.[at] ?? {};
    return el("li", {}, el("code", {}, text), ` ${value ?? why ?? ""} `,
      el("button", {
        type: "button", class: "remove", "aria-label": `Show ${text} no more`, onclick: () => {
          debugging.watched.splice(at, 1);
          debugging.look();
        },
      }, "×"));
  }

  function show() {
    const { answer, stopped, isRunning, trouble } = debugging;
    for (const [step, button] of buttons) {
      const needs = { back: stopped?.back, "block back": stopped?.back_block };
      button.disabled = isRunning || (step in needs ? !needs[step] : Boolean(answer) && !stopped && step !== "run");
    }
    buttons.get("run").textContent = stopped ? "Continue" : "Start";
    end.disabled = !answer;
    if (!answer) stand(null);
    place.replaceChildren(...(isRunning
      ? [el("p", { class: "quiet" }, "The run is on its way…")]
      : answer ? where(answer)
      : [el("p", { class: "quiet" }, trouble || "Click beside the number of a line, of a script, a CL file or the program, or press F9 there: the run stops at it. Start runs the post.")]));
    for (const said of answer?.said ?? []) place.append(el("p", { class: "hint" }, said));
    by("debug-stops").replaceChildren(...stops());
    by("debug-watched").replaceChildren(...debugging.watched.map(watchedRow));
    by("debug-values").replaceChildren(...(answer?.scopes ?? []).map(scope));
  }

  document.addEventListener("keydown", (event) => {
    if (by("panel-debug").hidden || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? { F10: "back" }[event.key] : KEYS[event.key];
    if (!step || buttons.get(step).disabled) return;
    event.preventDefault();
    go(step);
  });
  debugging.changed.on(show);
  show();
}
