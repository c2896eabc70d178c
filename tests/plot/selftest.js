"use strict";
// Uses the page as a person does and says what came of it. Added to a page by the test.
(async () => {
  // Where the page is only dumped the browser draws no frames.
  window.requestAnimationFrame = (work) => setTimeout(work, 1);
  window.cancelAnimationFrame = clearTimeout;
  const said = {};
  // The labels of the picture: text, left, top, right, bottom.
  let labels = [];
  const pens = CanvasRenderingContext2D.prototype, { fillText, clearRect } = pens;
  pens.fillText = function (text, x, y) {
    const width = this.measureText(text).width, left = this.textAlign === "right" ? x - width : x;
    if (this.canvas.id === "plot") labels.push([text, left, y - 9, left + width, y + 1]);
    return fillText.call(this, text, x, y);
  };
  pens.clearRect = function (...box) {
    if (this.canvas.id === "plot") labels = [];
    return clearRect.apply(this, box);
  };
  /** Labels that lie on one another, or leave the canvas. */
  const clashes = () => labels.flatMap((one, at) => [
    ...labels.slice(at + 1).filter((two) => one[3] > two[1] && two[3] > one[1] && one[4] > two[2] && two[4] > one[2])
      .map((two) => `${one[0]} on ${two[0]}`),
    ...(one[1] < 0 || one[2] < 0 || one[3] > plot.clientWidth || one[4] > plot.clientHeight ? [`${one[0]} is cut`] : []),
  ]);
  const failed = document.getElementById("wait");
  for (let count = 0; count < 2000 && !document.documentElement.dataset.ready; count++)
    await new Promise((done) => setTimeout(done, 5));
  const plot = document.getElementById("plot"), over = document.getElementById("over");
  const tip = document.getElementById("tip"), upto = document.getElementById("upto");
  const frames = async () => {
    for (let count = 0; count < 3; count++) await new Promise(requestAnimationFrame);
  };
  const click = (selector) => document.querySelector(selector).click();
  const data = JSON.parse(document.getElementById("data").textContent);
  const colours = Object.fromEntries(data.strokes.map(({ name, colour }) => [name, colour]));

  /** Places of a colour on the canvas, in its pixels. */
  function places(name) {
    const colour = colours[name] || name;
    const wanted = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
    const { width, height } = plot;
    const pixels = plot.getContext("2d").getImageData(0, 0, width, height).data;
    const found = [];
    for (let at = 0; at < pixels.length; at += 4) {
      const same = wanted.every((value, axis) => Math.abs(pixels[at + axis] - value) < 24);
      if (same && pixels[at + 3] > 200) found.push([at / 4 % width, Math.floor(at / 4 / width)]);
    }
    return found;
  }
  const span = (found) => {
    const values = found.map(([x]) => x);
    return found.length ? Math.max(...values.slice(0, 50000)) - Math.min(...values.slice(0, 50000)) : 0;
  };
  function send(type, [x, y], more = {}) {
    const ratio = plot.width / plot.clientWidth, box = over.getBoundingClientRect();
    const place = { clientX: box.left + x / ratio, clientY: box.top + y / ratio };
    const kind = type === "wheel" ? WheelEvent : PointerEvent;
    over.dispatchEvent(new kind(type, { bubbles: true, cancelable: true, ...place, ...more }));
  }

  try {
    if (!failed.hidden) throw new Error(failed.textContent);
    said.rows = [...document.querySelectorAll("#rows div")].map((row) => row.textContent);
    said.legend = document.getElementById("layers").textContent;
    said.axes = places(data.axisColour).length;
    said.extent = document.getElementById("extent").textContent;
    said.opened = document.querySelector("#views .chosen").dataset.view;
    said.slider = upto.value === upto.max;
    said.views = {};
    for (const name of ["xy", "zx", "zy", "iso"]) {
      click(`[data-view=${name}]`);
      said.views[name] = Object.keys(colours).map((stroke) => places(stroke).length);
      said.clashes = [...(said.clashes ?? []), ...clashes()];
      said.labels = [...(said.labels ?? []), ...labels.map(([text]) => text)];
    }
    click("[data-view=xy]");
    said.tips = {};
    for (const name of Object.keys(colours)) {
      const found = places(name);
      if (!found.length) continue;
      send("pointermove", found[Math.floor(found.length / 2)]);
      await frames();
      said.tips[name] = tip.hidden ? null : tip.textContent;
    }
    send("pointermove", [2, 2]);
    await frames();
    said.nothing = tip.hidden;

    const middle = [plot.width / 2, plot.height / 2];
    const before = span(places("feed"));
    send("wheel", middle, { deltaY: 300 });
    await frames();
    said.zoom = span(places("feed")) / before;
    const left = Math.min(...places("feed").map(([x]) => x));
    send("pointermove", middle, { buttons: 1, movementX: 40, movementY: 0 });
    await frames();
    said.moved = Math.min(...places("feed").map(([x]) => x)) - left;
    click("#fit");

    const all = places("feed").length;
    const label = [...document.querySelectorAll("#layers label")]
      .find((label) => label.textContent.includes("feed"));
    if (label) {
      const box = label.querySelector("input");
      box.click();
      said.without = places("feed").length;
      box.click();
      said.again = places("feed").length === all;
    }
    const chosen = () => document.querySelector("#rows .chosen")?.textContent;
    const inForce = said.tips.feed;
    said.inForce = inForce;
    const arcs = places("arc");
    if (arcs.length) {
      const spot = arcs[Math.floor(arcs.length / 2)];
      send("pointerdown", spot);
      send("pointerup", spot);
      await frames();
      said.clicked = chosen();
    }
    const row = [...document.querySelectorAll("#rows div")].find((row) => row.textContent.includes("G1"));
    if (row) {
      row.click();
      said.row = chosen() === row.textContent;
    }
    const low = document.getElementById("low"), high = document.getElementById("high");
    high.value = -1000;
    high.dispatchEvent(new Event("input"));
    await frames();
    said.below = Object.keys(colours).map((stroke) => places(stroke).length);
    high.value = "";
    high.dispatchEvent(new Event("input"));
    await frames();
    said.allAgain = places("feed").length === all;
    const tools = document.getElementById("tool");
    said.operations = [...tools.options].map((option) => option.text);
    upto.value = 0;
    upto.dispatchEvent(new Event("input"));
    document.getElementById("speed").value = 600;
    click("#play");
    await new Promise((done) => setTimeout(done, 400));
    said.played = Number(upto.value);
    if (document.getElementById("play").textContent === "Pause") click("#play");
    click("#theme");
    said.dark = document.documentElement.dataset.theme;
    click("#theme");
    // Playback adds to the picture; what is there before it, and after it, is the same.
    const end = Number(upto.max);
    for (let step = 0; step <= Math.min(end, 40); step++) {
      upto.value = step === 40 ? end : step;
      upto.dispatchEvent(new Event("input"));
      await frames();
    }
    said.whole = places("feed").length / all;
    upto.value = 1;
    upto.dispatchEvent(new Event("input"));
    await frames();
    said.early = Object.keys(colours).map((stroke) => places(stroke).length);
    said.dropped = [];
    for (const [name, text] of [["proven.html", document.documentElement.outerHTML], ["part.nc", "G0 X5.\nM30\n"]]) {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([text], name));
      window.dispatchEvent(new DragEvent("drop", { cancelable: true, dataTransfer }));
      const place = document.getElementById("place");
      for (let count = 0; count < 200 && !place.textContent.startsWith(name); count++) await frames();
      said.dropped.push(place.textContent);
    }
    said.underLegend = document.getElementById("layers").textContent;
    said.missing = document.getElementById("missing").hidden ? null : document.getElementById("missing").textContent;
  } catch (error) {
    said.error = String(error);
  }
  const result = document.createElement("pre");
  result.id = "said";
  result.textContent = JSON.stringify(said);
  document.body.append(result);
})();
