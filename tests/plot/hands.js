"use strict";
// Plays, filters, and uses the keyboard alone; says what came of it. Added to a page by the test.
(async () => {
  // Where the page is only dumped the browser draws no frames.
  window.requestAnimationFrame = (work) => setTimeout(work, 1);
  window.cancelAnimationFrame = clearTimeout;
  const element = (id) => document.getElementById(id);
  const rest = (time) => new Promise((done) => setTimeout(done, time));
  for (let count = 0; count < 2000 && !document.documentElement.dataset.ready; count++) await rest(5);
  const said = {}, plot = element("plot"), place = () => element("place").textContent;
  const data = JSON.parse(element("data").textContent);
  const set = (id, value) => {
    element(id).value = value;
    element(id).dispatchEvent(new Event("input"));
  };
  const key = (key, more) => document.body.dispatchEvent(
    new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true, ...more }));

  /** Columns of the canvas that have a stroke of the path, as left, right of each group. */
  function columns() {
    const { width, height } = plot, found = new Set();
    const pixels = plot.getContext("2d").getImageData(0, 0, width, height).data;
    const inks = data.strokes.filter(({ name }) => name !== "rapid")
      .map(({ colour }) => [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16)));
    for (let at = 0; at < pixels.length; at += 4)
      if (inks.some((ink) => ink.every((part, n) => Math.abs(pixels[at + n] - part) < 40)) && pixels[at + 3] > 150)
        found.add(at / 4 % width);
    const groups = [];
    for (const x of [...found].sort((a, b) => a - b)) {
      const last = groups.at(-1);
      if (last && x - last[1] < 8) last[1] = x;
      else groups.push([x, x]);
    }
    return groups;
  }

  try {
    if (!element("wait").hidden) throw new Error(element("wait").textContent);
    said.played = [];
    for (const speed of [1, 10, 100]) {
      set("upto", 0);
      set("speed", speed);
      const start = performance.now();
      element("play").click();
      await rest(730);
      element("play").click();
      said.played.push({ speed, seconds: (performance.now() - start) / 1000, place: place() });
    }
    set("upto", element("upto").max);
    document.querySelector("[data-view=xy]").click();
    said.operations = [...element("tool").options].map((option) => option.text);
    said.filtered = {};
    for (const { value, text } of [...element("tool").options]) {
      set("tool", value);
      await rest(30);
      said.filtered[text] = columns();
    }
    set("tool", "");
    set("low", -1.5);
    set("high", -0.5);
    await rest(30);
    said.levels = columns();
    set("low", "");
    set("high", "");
    await rest(30);

    document.activeElement.blur();
    key("Home");
    key("ArrowRight");
    key("ArrowRight");
    said.stepped = place();
    key("ArrowDown");
    key("ArrowDown");
    said.row = document.querySelector("#rows .chosen").textContent;
    said.line = place();
    key("End");
    key("1");
    await rest(30);
    const wide = (groups) => groups.at(-1)[1] - groups[0][0];
    const before = columns();
    key("+");
    await rest(30);
    said.larger = wide(columns()) / wide(before);
    key("-");
    key("ArrowRight", { shiftKey: true });
    await rest(30);
    said.moved = columns().at(-1)[1] - before.at(-1)[1];
    key("f");
    await rest(30);
    said.fitted = columns()[0][0] - before[0][0];
    key("4");
    said.view = document.querySelector("#views .chosen").dataset.view;
    key("Home");
    key(" ");
    said.plays = element("play").getAttribute("aria-pressed");
    key(" ");
    said.themes = [];
    for (let count = 0; count < 2; count++) {
      const paper = getComputedStyle(document.body);
      said.themes.push([paper.backgroundColor, paper.color]);
      key("d");
    }
    const controls = [...document.querySelectorAll("button, select, input, canvas#over, #pane, summary")];
    said.unreachable = controls.filter((one) => one.offsetParent && one.tabIndex < 0).map((one) => one.id);
  } catch (error) {
    said.error = String(error);
  }
  const result = document.createElement("pre");
  result.id = "said";
  result.textContent = JSON.stringify(said);
  document.body.append(result);
})();
