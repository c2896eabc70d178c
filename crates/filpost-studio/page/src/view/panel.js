// What surrounds the picture: buttons, legend, the block and its state, playback.
import { BY, TOOLS, feedRange, toolsOf } from "./path.js";
import { duration } from "./read.js";
import { clock, feedText, length, offsetText, short, speedText, toolNumber, toolText, unitOf } from "./words.js";

const STROKES = ["rapid", "feed", "arc", "thread"];
const LOOKS = [["top", "Top"], ["front", "Front"], ["side", "Side"], ["iso", "Iso"]];
const FACTORS = [1, 10, 60, 100, 600];
/** Steps of the sliders, pixels of the axes in the corner, and most tools in the legend. */
const SLIDE = 10_000, AXES = 26, LISTED = TOOLS;
const KEYS = "drag: turn · shift or right button and drag: move · wheel: zoom · click: line · arrows: turn, with shift move · + −: zoom · " +
  "1 to 4: views · f: fit · space: play · , and . : step · m: measure · Home, End";

function make(tag, classes, fields = {}) {
  const one = document.createElement(tag);
  if (classes) one.className = classes;
  const { aria = {}, ...rest } = fields;
  Object.assign(one, rest);
  for (const [name, value] of Object.entries(aria)) one.setAttribute(`aria-${name}`, value);
  return one;
}

const button = (text, title, work, classes = "") => {
  const one = make("button", classes, { type: "button", textContent: text, title });
  one.addEventListener("click", work);
  return one;
};

function choice(label, options, work) {
  const select = make("select", "", { aria: { label } });
  for (const [value, text] of options) select.append(new Option(text, value));
  select.addEventListener("change", () => work(select.value));
  return select;
}

/** The panel of a view in an element. */
export function makePanel(element, view, tools) {
  return new Panel(element, view, tools);
}

class Panel {
  constructor(element, view, tools) {
    this.view = view;
    this.root = make("section", "fv", { aria: { label: "Tool path in three dimensions" } });
    this.stage = make("div", "fv-stage");
    this.canvas = make("canvas", "", { tabIndex: 0, title: "", aria: { label: `Tool path. ${KEYS}` } });
    this.canvas.setAttribute("role", "img");
    this.legend = make("div", "fv-legend", { aria: { label: "Legend" } });
    this.legend.setAttribute("role", "group");
    this.distance = make("output", "fv-distance", { hidden: true });
    this.missing = make("details", "fv-missing", { hidden: true });
    this.missingTitle = make("summary");
    this.missingList = make("p");
    this.missing.append(this.missingTitle, this.missingList);
    this.top = make("div", "fv-top");
    this.top.append(this.legend, this.distance);
    this.stage.append(this.canvas, this.top, this.makeAxes(), this.missing);
    this.root.append(this.makeBar(tools), this.stage, this.makeState(), this.makePlayer());
    element.append(this.root);
    this.stood = -1;
  }

  makeBar(tools) {
    const bar = make("div", "fv-bar"), { view } = this;
    bar.setAttribute("role", "toolbar");
    bar.setAttribute("aria-label", "View");
    const looks = make("span", "fv-group");
    this.looks = LOOKS.map(([name, text], at) => {
      const one = button(text, `${text} view (${at + 1})`, () => view.look(name));
      one.dataset.look = name;
      looks.append(one);
      return one;
    });
    looks.append(button("Fit", "Fit (f)", () => view.fit()));
    this.by = choice("Color by", [[BY.motion, "by motion"], [BY.tool, "by tool"], [BY.feed, "by feed"]], (value) => view.setBy(Number(value)));
    this.measureButton = button("Measure", "Distance of two points (m)", () => view.setMeasure(!view.measure.isOn));
    this.measureButton.setAttribute("aria-pressed", "false");
    this.sectionAxis = choice("Section", [[-1, "no section"], [0, "section X"], [1, "section Y"], [2, "section Z"]],
      (value) => view.setSection(Number(value), this.sectionAt.value / SLIDE));
    this.sectionAt = make("input", "", { type: "range", min: 0, max: SLIDE, value: SLIDE / 2, aria: { label: "Place of the section" } });
    this.sectionAt.addEventListener("input", () => view.setSection(view.section.axis, this.sectionAt.value / SLIDE));
    this.sectionText = make("output", "fv-section");
    this.machineButton = button("Machine", "Turn the part as the tables of the machine do", () => view.setMachine(!view.machine.isOn));
    this.machineButton.setAttribute("aria-pressed", "false");
    this.machineButton.hidden = true;
    bar.append(looks, this.by, this.measureButton, this.sectionAxis, this.sectionAt, this.sectionText, this.machineButton, ...tools);
    this.showSection(-1, 0, unitOf({}));
    return bar;
  }

  makeAxes() {
    const space = "http://www.w3.org/2000/svg", picture = document.createElementNS(space, "svg");
    picture.setAttribute("class", "fv-axes");
    picture.setAttribute("viewBox", "-40 -40 80 80");
    picture.setAttribute("aria-hidden", "true");
    this.axes = ["x", "y", "z"].map((name) => {
      const line = document.createElementNS(space, "line"), text = document.createElementNS(space, "text");
      line.setAttribute("class", `fv-${name}`);
      text.setAttribute("class", `fv-${name}`);
      text.textContent = name.toUpperCase();
      picture.append(line, text);
      return { line, text, way: null };
    });
    return picture;
  }

  makeState() {
    const state = make("div", "fv-state");
    this.block = make("code", "fv-block");
    this.force = make("span", "fv-force");
    state.append(this.block, this.force);
    return state;
  }

  makePlayer() {
    const player = make("div", "fv-player"), { view } = this;
    this.playButton = button("Play", "Play or pause (space)", () => view.toggle(), "fv-play");
    this.playButton.setAttribute("aria-pressed", "false");
    const back = button("‹", "One motion back (,)", () => view.step(-1)), on = button("›", "One motion on (.)", () => view.step(1));
    back.setAttribute("aria-label", "One motion back");
    on.setAttribute("aria-label", "One motion on");
    this.slider = make("input", "fv-slider", { type: "range", min: 0, max: SLIDE, value: SLIDE, aria: { label: "Time" } });
    this.slider.addEventListener("input", () => {
      view.pause();
      if (view.program) view.setTime(this.slider.value / SLIDE * duration(view.program));
    });
    this.factor = choice("Speed of playback", FACTORS.map((factor) => [factor, factor === 1 ? "real time" : `${factor}×`]), (value) => {
      view.factor = Number(value);
    });
    this.factor.value = "60";
    this.clock = make("span", "fv-clock");
    player.append(this.playButton, back, on, this.slider, this.factor, this.clock);
    return player;
  }

  /** Pixels of the picture that the legend and the axes take. */
  covered() {
    return { above: this.top.offsetHeight, below: 24 };
  }

  // --- what the view tells ------------------------------------------------------------

  showProgram(program, second) {
    const isEmpty = !program?.total;
    for (const one of [this.playButton, this.slider, this.factor]) one.disabled = isEmpty;
    this.machineButton.hidden = !program?.rotaryFrom.length || !program.chain?.axes.some((axis) => axis?.carries === "table");
    this.total = program ? clock(duration(program)) : "";
    this.stood = -1;
    if (isEmpty) this.block.textContent = this.force.textContent = this.clock.textContent = "";
    this.showLegend(program, second, this.view.by);
    this.showMissing(program, second);
  }

  showMissing(program, second) {
    const named = (one, name) => (one?.leftOut ?? []).map(({ line, count, why }) =>
      `${name}line ${line}${count > 1 ? ` to ${line + count - 1}` : ""}: ${why}`);
    const all = [...named(program, ""), ...named(second, `${second?.title}, `)];
    this.missing.hidden = !all.length;
    this.missingTitle.textContent = all.length === 1 ? "1 gap in the path" : `${all.length} gaps in the path`;
    this.missingList.textContent = all.slice(0, 200).join("\n") + (all.length > 200 ? `\nand ${all.length - 200} more` : "");
  }

  showLegend(program, second, by) {
    const rows = [], { view } = this;
    const used = [false, false, false, false];
    if (program) for (let piece = 0; piece < program.total; piece++) used[program.strokes[piece]] = true;
    const row = (style, text, isOn, work) => {
      const label = make("label"), sample = make("i"), box = make("input", "", { type: "checkbox", checked: isOn });
      Object.assign(sample.style, style);
      box.addEventListener("change", () => work(box.checked));
      label.append(box, sample, text);
      rows.push(label);
    };
    const plain = (style, text) => {
      const label = make("span"), sample = make("i");
      Object.assign(sample.style, style);
      label.append(sample, text);
      rows.push(label);
    };
    STROKES.forEach((name, at) => {
      if (!used[at]) return;
      const colour = by === BY.motion || at === 0 ? `var(--fv-${name})` : "none";
      row({ background: colour }, name, view.shown[at], (isOn) => view.setShown(at, isOn));
    });
    if (program && by === BY.tool) {
      const tools = toolsOf(program), { theme } = view;
      tools.slice(0, LISTED).forEach((number, at) => plain({ background: theme.tools[at] }, toolText(program, number)));
      if (tools.length > LISTED) plain({ background: "none" }, `and ${tools.length - LISTED} more, colors again from the first`);
    }
    if (program && by === BY.feed) {
      const [low, high] = feedRange(program), unit = unitOf(program);
      const name = `${length(low, unit)} to ${length(high, unit)} ${unit.name}/min`;
      if (high) plain({ background: "linear-gradient(90deg, var(--fv-feeds))", width: "44px" }, name);
    }
    if (second) row({ background: "var(--fv-second)", height: "5px" }, second.title, view.isSecondShown, (isOn) => view.setSecondShown(isOn));
    this.legend.replaceChildren(...rows);
    this.legend.hidden = !rows.length;
  }

  /** The tools have other shapes: what is said of them is said anew. */
  forgetPlace() {
    this.stood = -1;
  }

  showPlace(program, piece, seconds, point) {
    const unit = unitOf(program), line = program.lines[piece];
    if (piece !== this.stood) {
      this.stood = piece;
      this.block.textContent = `${line}: ${this.view.textOf(line)}`.trimEnd();
      const turned = program.diameter && Math.abs(point.y) < 1e-4;
      this.state = [toolText(program, toolNumber(program, piece)), offsetText(program, piece), feedText(program, piece, unit), speedText(program, piece)]
        .filter(Boolean).join(" · ");
      this.turned = turned;
    }
    const at = this.turned ? `\u2300${length(2 * point.x, unit)} Z${length(point.z, unit)}`
      : `X${length(point.x, unit)} Y${length(point.y, unit)} Z${length(point.z, unit)}`;
    this.force.textContent = `${at} ${this.rotaryText(program)}· ${this.state}`;
    this.clock.textContent = `${clock(seconds)} of ${this.total}`;
    const whole = duration(program);
    this.slider.value = whole ? seconds / whole * SLIDE : SLIDE;
    this.slider.setAttribute("aria-valuetext", this.clock.textContent);
  }

  /** The positions of the rotary axes. */
  rotaryText(program) {
    if (!program.rotaryFrom.length) return "";
    const { axes, rotary } = this.view.machine;
    return axes.map((axis, at) => (axis ? `${axis.letter}${short(rotary[at], 3)} ` : "")).join("");
  }

  showPlaying(isPlaying) {
    this.playButton.textContent = isPlaying ? "Pause" : "Play";
    this.playButton.setAttribute("aria-pressed", isPlaying);
  }

  showLook(name) {
    for (const one of this.looks) one.classList.toggle("fv-chosen", one.dataset.look === name);
  }

  showMachine(isOn) {
    this.machineButton.setAttribute("aria-pressed", isOn);
  }

  showMeasure(isOn) {
    this.measureButton.setAttribute("aria-pressed", isOn);
    this.root.classList.toggle("fv-measuring", isOn);
    if (isOn) this.showDistance("click the first point");
  }

  showDistance(text) {
    this.distance.textContent = text;
    this.distance.hidden = !text;
  }

  showSection(axis, level, unit) {
    this.sectionAt.hidden = this.sectionText.hidden = axis < 0;
    this.sectionAxis.value = String(axis);
    this.sectionText.textContent = axis < 0 ? "" : `${"XYZ"[axis]} \u2264 ${length(level, unit)}`;
  }

  /** The directions of the axes in the corner. */
  showAxes(camera, part) {
    const e = part.matrixWorld.elements;
    for (let at = 0; at < 3; at++) {
      const { line, text } = this.axes[at], o = 4 * at;
      const x = AXES * (e[o] * camera.right.x + e[o + 1] * camera.right.y + e[o + 2] * camera.right.z);
      const y = -AXES * (e[o] * camera.up.x + e[o + 1] * camera.up.y + e[o + 2] * camera.up.z);
      const size = Math.hypot(x, y), isSeen = size > 3;
      if (this.axes[at].x === x && this.axes[at].y === y) continue;
      this.axes[at].x = x;
      this.axes[at].y = y;
      line.setAttribute("x2", x);
      line.setAttribute("y2", y);
      text.setAttribute("x", isSeen ? x + x / size * 9 : 0);
      text.setAttribute("y", (isSeen ? y + y / size * 9 : 0) + 4);
      text.setAttribute("visibility", isSeen ? "visible" : "hidden");
    }
  }
}
