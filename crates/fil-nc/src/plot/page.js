"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const element = (id) => document.getElementById(id);
  const plot = element("plot"), over = element("over"), tip = element("tip");
  const upto = element("upto"), place = element("place");

  // --- what the page holds -------------------------------------------------

  /** Reads whole numbers, seven bits a byte, the lowest first. */
  function numbers(base64) {
    const text = atob(base64);
    let at = 0;
    const next = () => {
      let value = 0, weight = 1;
      for (;;) {
        const byte = text.charCodeAt(at++);
        value += (byte & 127) * weight;
        if (byte < 128) return value;
        weight *= 128;
      }
    };
    const signed = () => {
      const value = next();
      return value % 2 ? -(value + 1) / 2 : value / 2;
    };
    return { next, signed, more: () => at < text.length };
  }

  function readTrace(packed) {
    const points = [], at = [0, 0, 0];
    const steps = numbers(packed.points);
    while (steps.more()) {
      for (let axis = 0; axis < 3; axis++) {
        at[axis] += steps.signed();
        points.push(data.min[axis] + at[axis] * data.step);
      }
    }
    const starts = [], ends = [], strokes = [], lines = [];
    const pieces = numbers(packed.pieces);
    let end = 0, line = 0;
    while (pieces.more()) {
      const head = pieces.next();
      const start = head & 4 ? end - 1 : end;
      end = start + Math.floor(head / 8);
      line += pieces.signed();
      starts.push(start);
      ends.push(end);
      strokes.push(head & 3);
      lines.push(line);
    }
    const originOf = [], of = numbers(packed.originOf);
    while (of.more()) originOf.push(of.next());
    const count = points.length / 3;
    const inForce = [], states = numbers(packed.inForce);
    for (let from = 0; states.more();) {
      from += states.next();
      const [tool, feedKind, feed, speedKind, speed, spindle, fixture] = Array.from({ length: 7 }, states.next);
      inForce.push({ from, tool, feedKind, feed: feed / 1e4, speedKind, speed: speed / 1e4, spindle, fixture });
    }
    const axes = [], directions = numbers(packed.axes);
    for (let from = 0; directions.more();) {
      from += directions.next();
      axes.push({ from, axis: Array.from({ length: 3 }, () => directions.signed() / 1e4) });
    }
    return {
      inForce, axes, mask: new Uint8Array(starts.length).fill(1),
      points: Float64Array.from(points), count,
      starts: Uint32Array.from(starts), ends: Uint32Array.from(ends),
      strokes: Uint8Array.from(strokes), lines: Uint32Array.from(lines),
      x: new Float32Array(count), y: new Float32Array(count),
      changes: packed.changes, texts: packed.texts.split("\n"),
      origins: packed.origins, originOf, shown: starts.length,
    };
  }

  const path = readTrace(data.path);
  const under = data.under ? readTrace(data.under) : null;

  // --- the view --------------------------------------------------------------

  const half = Math.SQRT1_2, sixth = 1 / Math.sqrt(6);
  const VIEWS = {
    xy: [[1, 0, 0], [0, 1, 0]],
    zx: [[0, 0, 1], [1, 0, 0]],
    zy: [[0, 0, 1], [0, 1, 0]],
    iso: [[half, half, 0], [-sixth, sixth, 2 * sixth]],
  };
  window.filpostPlot = {};
  const view = { right: [1, 0, 0], up: [0, 1, 0], scale: 1, x: 0, y: 0 };
  const middle = [0, 1, 2].map((axis) => (data.min[axis] + data.max[axis]) / 2);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) =>
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const mix = (a, p, b, q) => a.map((value, axis) => value * p + b[axis] * q);

  /** A point of the part on the canvas, in CSS pixels. */
  function project(point) {
    const from = point.map((value, axis) => value - middle[axis]);
    return [view.x + dot(from, view.right) * view.scale, view.y - dot(from, view.up) * view.scale];
  }

  function projectAll(trace) {
    const { points, count, x, y } = trace;
    const [a, b, c] = view.right.map((value) => value * view.scale);
    const [d, e, f] = view.up.map((value) => value * view.scale);
    const [mx, my, mz] = middle;
    for (let index = 0, at = 0; index < count; index++, at += 3) {
      const px = points[at] - mx, py = points[at + 1] - my, pz = points[at + 2] - mz;
      x[index] = view.x + px * a + py * b + pz * c;
      y[index] = view.y - (px * d + py * e + pz * f);
    }
  }

  function fit() {
    const { clientWidth: width, clientHeight: height } = plot;
    let right = 1e-6, up = 1e-6;
    for (let corner = 0; corner < 8; corner++) {
      const from = middle.map((value, axis) => (corner >> axis & 1 ? data.max : data.min)[axis] - value);
      right = Math.max(right, Math.abs(dot(from, view.right)));
      up = Math.max(up, Math.abs(dot(from, view.up)));
    }
    view.scale = Math.min((width - 80) / (2 * right), (height - 80) / (2 * up));
    view.x = width / 2;
    view.y = height / 2;
  }

  function look(name) {
    [view.right, view.up] = VIEWS[name];
    for (const button of document.querySelectorAll("#views button"))
      button.classList.toggle("chosen", button.dataset.view === name);
    fit();
    draw();
  }

  // --- drawing -----------------------------------------------------------------

  const layers = data.strokes.map((stroke, index) => ({ ...stroke, index, on: true }));
  const clLayer = { name: data.underName, colour: data.underColour, on: true };
  const BATCH = 4000, DASHES = 20000;

  /** Draws the pieces of a trace that `wanted` takes; what does not reach the next
   *  pixel is left out, and so is what lies beside the canvas. */
  function strokePieces(pen, trace, wanted) {
    const { x, y, starts, ends } = trace;
    const width = plot.clientWidth, height = plot.clientHeight;
    let segments = 0, last = -1, atX = 0, atY = 0;
    pen.beginPath();
    for (let piece = 0; piece < trace.shown; piece++) {
      if (!wanted(piece)) continue;
      const start = starts[piece], end = ends[piece];
      if (start !== last) {
        atX = x[start];
        atY = y[start];
        pen.moveTo(atX, atY);
      }
      for (let index = start + 1; index < end; index++) {
        const toX = x[index], toY = y[index];
        const near = Math.abs(toX - atX) + Math.abs(toY - atY) < 0.7;
        const goesOn = index + 1 === end && starts[piece + 1] === index;
        if (near && (index + 1 < end || goesOn)) continue;
        const beside = (atX < 0 && toX < 0) || (atX > width && toX > width) ||
          (atY < 0 && toY < 0) || (atY > height && toY > height);
        if (beside) pen.moveTo(toX, toY);
        else {
          pen.lineTo(toX, toY);
          if (++segments % BATCH === 0) {
            pen.stroke();
            pen.beginPath();
            pen.moveTo(toX, toY);
          }
        }
        atX = toX;
        atY = toY;
      }
      last = end - 1;
    }
    pen.stroke();
    return segments;
  }

  function canvasPen(canvas) {
    const ratio = window.devicePixelRatio || 1;
    const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    pen.lineJoin = "round";
    return pen;
  }

  function draw() {
    const pen = canvasPen(plot);
    projectAll(path);
    if (under) {
      projectAll(under);
      if (clLayer.on) {
        pen.strokeStyle = clLayer.colour;
        pen.lineWidth = 5;
        pen.globalAlpha = 0.55;
        strokePieces(pen, under, () => true);
        pen.globalAlpha = 1;
      }
    }
    for (const layer of layers) {
      if (!layer.on) continue;
      pen.strokeStyle = layer.colour;
      pen.lineWidth = layer.index === 0 ? 1 : 1.5;
      pen.setLineDash(layer.index === 0 && path.shown < DASHES ? [6, 4] : []);
      strokePieces(pen, path, (piece) => path.mask[piece] && path.strokes[piece] === layer.index);
    }
    pen.setLineDash([]);
    drawOrigin(pen);
    drawChanges(pen);
    drawAxes(pen);
    drawScale(pen);
    drawPointer();
  }

  /** Colours of texts, by the theme. */
  const ink = (name) => getComputedStyle(document.body).getPropertyValue(`--${name}`).trim();

  /** The origin of the part, and the directions of its axes. */
  function drawOrigin(pen) {
    const [x, y] = project([0, 0, 0]);
    pen.font = "12px sans-serif";
    pen.strokeStyle = pen.fillStyle = ink("origin");
    pen.lineWidth = 1.5;
    pen.beginPath();
    pen.arc(x, y, 5, 0, 2 * Math.PI);
    pen.stroke();
    ["X", "Y", "Z"].forEach((name, axis) => {
      const dx = view.right[axis] * 36, dy = -view.up[axis] * 36;
      if (Math.hypot(dx, dy) < 4) return;
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(x + dx, y + dy);
      pen.stroke();
      pen.fillText(name, x + dx * 1.2 - 4, y + dy * 1.2 + 4);
    });
  }

  /** Puts a label beside a point, where none stands yet. */
  function putLabel(pen, taken, label, px, py) {
    const width = pen.measureText(label).width;
    for (let ring = 0; ring < 6; ring++) {
      for (const [dx, dy] of [[7, -6 - 15 * ring], [7, 16 + 15 * ring], [-width - 7, -6 - 15 * ring], [-width - 7, 16 + 15 * ring]]) {
        const box = [px + dx, py + dy - 12, px + dx + width, py + dy + 3];
        const free = taken.every((b) => box[2] < b[0] || box[0] > b[2] || box[3] < b[1] || box[1] > b[3]);
        if (!free) continue;
        taken.push(box);
        pen.strokeText(label, px + dx, py + dy);
        pen.fillText(label, px + dx, py + dy);
        return;
      }
    }
  }

  function drawChanges(pen) {
    const seen = new Map();
    const lastLine = path.shown ? path.lines[path.shown - 1] : 0;
    pen.font = "13px sans-serif";
    for (const [x, y, z, tool, line] of path.changes) {
      if (path.shown < path.starts.length && line > lastLine) continue;
      const [px, py] = project([x, y, z]);
      const key = `${Math.round(px)},${Math.round(py)}`;
      const tools = seen.get(key) || [];
      if (!tools.includes(tool)) tools.push(tool);
      seen.set(key, tools);
      pen.beginPath();
      pen.arc(px, py, 4, 0, 2 * Math.PI);
      pen.fillStyle = ink("paper");
      pen.fill();
      pen.strokeStyle = ink("text");
      pen.lineWidth = 1.2;
      pen.stroke();
    }
    pen.fillStyle = ink("text");
    pen.strokeStyle = ink("paper");
    pen.lineWidth = 4;
    const taken = [];
    for (const [key, tools] of seen) {
      const [px, py] = key.split(",").map(Number);
      putLabel(pen, taken, tools.map((tool) => `T${tool}`).join(" "), px, py);
    }
  }

  function drawAxes(pen) {
    const x = 44, y = plot.clientHeight - 44;
    pen.font = "12px sans-serif";
    pen.strokeStyle = ink("faint");
    pen.fillStyle = ink("faint");
    pen.lineWidth = 1.2;
    ["X", "Y", "Z"].forEach((name, axis) => {
      const dx = view.right[axis] * 30, dy = -view.up[axis] * 30;
      if (Math.hypot(dx, dy) < 2) return;
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(x + dx, y + dy);
      pen.stroke();
      pen.fillText(name, x + dx * 1.25 - 4, y + dy * 1.25 + 4);
    });
  }

  /** A bar of a round length. */
  function drawScale(pen) {
    const wanted = 120 / view.scale;
    const power = 10 ** Math.floor(Math.log10(wanted));
    const length = [5, 2, 1].map((digit) => digit * power).find((value) => value <= wanted);
    const x = plot.clientWidth - 20, y = plot.clientHeight - 20;
    pen.beginPath();
    pen.moveTo(x - length * view.scale, y);
    pen.lineTo(x, y);
    pen.strokeStyle = ink("faint");
    pen.lineWidth = 2;
    pen.stroke();
    pen.textAlign = "right";
    pen.fillText(`${Number(length.toPrecision(1))} mm`, x, y - 6);
    pen.textAlign = "left";
  }

  // --- what lies under the pointer ------------------------------------------------

  let found = null, chosen = [];

  /** The pieces within eight pixels of a place, the nearest first. */
  function nearest(trace, px, py, wanted) {
    const { x, y, starts, ends } = trace;
    const near = [];
    for (let index = 0; index < trace.shown; index++) {
      if (!wanted(index)) continue;
      let best = 64.000001;
      for (let at = starts[index]; at + 1 < ends[index]; at++) {
        const ax = x[at], ay = y[at], bx = x[at + 1] - ax, by = y[at + 1] - ay;
        const length = bx * bx + by * by;
        let share = length > 0 ? ((px - ax) * bx + (py - ay) * by) / length : 0;
        share = share < 0 ? 0 : share > 1 ? 1 : share;
        const dx = px - ax - bx * share, dy = py - ay - by * share;
        best = Math.min(best, dx * dx + dy * dy);
      }
      if (best <= 64) near.push({ trace, piece: index, best });
    }
    return near.sort((a, b) => a.best - b.best || b.piece - a.piece);
  }

  const isSeen = (piece) => layers[path.strokes[piece]].on && path.mask[piece];

  function under8(px, py) {
    const near = nearest(path, px, py, isSeen);
    return near.length || !under || !clLayer.on ? near : nearest(under, px, py, () => true);
  }

  function point(px, py) {
    const near = under8(px, py);
    found = near[0] || null;
    drawPointer();
    if (!found) {
      tip.hidden = true;
      return;
    }
    const others = near.slice(1).filter((one) => one.trace.lines[one.piece] !== found.trace.lines[found.piece]);
    const listed = others.slice(0, 5).map(({ trace, piece }) => `also ${lineOf(trace, piece)}`);
    if (others.length > 5) listed.push(`and ${others.length - 5} more`);
    tip.textContent = [describe(found), ...listed].join("\n");
    tip.hidden = false;
    const width = over.clientWidth, height = over.clientHeight;
    tip.style.left = `${Math.max(4, Math.min(px + 14, width - tip.offsetWidth - 4))}px`;
    tip.style.top = `${Math.max(4, Math.min(py + 14, height - tip.offsetHeight - 4))}px`;
  }

  const short = (value) => String(Math.round(value * 1000) / 1000);
  const lineOf = (trace, piece) => `line ${trace.lines[piece]}: ${trace.texts[trace.lines[piece] - 1] || ""}`;

  /** The last of a list of changes at or before a piece. */
  function at(list, piece) {
    let low = 0, high = list.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (list[middle].from <= piece) low = middle + 1;
      else high = middle;
    }
    return list[low - 1];
  }

  function describe({ trace, piece }) {
    const last = 3 * (trace.ends[piece] - 1);
    const end = ["X", "Y", "Z"].map((name, axis) => name + short(trace.points[last + axis])).join(" ");
    const what = `${trace === under ? data.underName + ", " : ""}${data.strokes[trace.strokes[piece]].name} to ${end}`;
    const direction = trace.axes.length ? (at(trace.axes, piece) || { axis: [0, 0, 1] }).axis : null;
    const tilted = direction && `tool axis ${direction.map(short).join(" ")}`;
    const origin = trace.origins[trace.originOf[trace.lines[piece] - 1] || 0];
    const more = window.filpostPlot.stateOf ? window.filpostPlot.stateOf(trace, piece) : "";
    return [lineOf(trace, piece), what, tilted, more, origin].filter((part) => part).join("\n");
  }

  function drawPointer() {
    const pen = canvasPen(over);
    const last = path.shown ? path.ends[path.shown - 1] - 1 : -1;
    if (last >= 0 && path.shown < path.starts.length) {
      pen.beginPath();
      pen.arc(path.x[last], path.y[last], 6, 0, 2 * Math.PI);
      pen.fillStyle = ink("text");
      pen.fill();
    }
    const marked = found ? [found] : chosen.map((piece) => ({ trace: path, piece }));
    for (const { trace, piece } of marked) {
      pen.beginPath();
      for (let at = trace.starts[piece]; at < trace.ends[piece]; at++) pen.lineTo(trace.x[at], trace.y[at]);
      pen.strokeStyle = ink("text");
      pen.lineWidth = 3.5;
      pen.stroke();
    }
  }

  // --- hands -------------------------------------------------------------------------

  let due = 0;
  const soon = (work) => {
    cancelAnimationFrame(due);
    due = requestAnimationFrame(work);
  };

  over.addEventListener("wheel", (event) => {
    event.preventDefault();
    const factor = Math.exp(-event.deltaY * 0.0015);
    view.x = event.offsetX + (view.x - event.offsetX) * factor;
    view.y = event.offsetY + (view.y - event.offsetY) * factor;
    view.scale *= factor;
    soon(draw);
  }, { passive: false });

  let pressed = null;
  over.addEventListener("pointerdown", (event) => {
    pressed = [event.offsetX, event.offsetY];
    over.focus();
    if (event.isTrusted) over.setPointerCapture(event.pointerId);
  });
  over.addEventListener("pointerup", (event) => {
    const still = pressed && Math.hypot(event.offsetX - pressed[0], event.offsetY - pressed[1]) < 4;
    pressed = null;
    const [near] = still ? under8(event.offsetX, event.offsetY) : [];
    if (near && near.trace === path) choose(path.lines[near.piece], true);
  });

  over.addEventListener("pointermove", (event) => {
    if (!(event.buttons & 3)) {
      soon(() => point(event.offsetX, event.offsetY));
      return;
    }
    tip.hidden = true;
    if (event.shiftKey || event.buttons & 2) turn(event.movementX * 0.008, event.movementY * 0.008);
    else {
      view.x += event.movementX;
      view.y += event.movementY;
    }
    soon(draw);
  });

  over.addEventListener("pointerleave", () => {
    found = null;
    tip.hidden = true;
    drawPointer();
  });
  over.addEventListener("contextmenu", (event) => event.preventDefault());

  function turn(aside, down) {
    const toward = cross(view.right, view.up);
    view.right = mix(view.right, Math.cos(aside), toward, Math.sin(aside));
    const forward = cross(view.right, view.up);
    view.up = mix(view.up, Math.cos(down), forward, -Math.sin(down));
    for (const button of document.querySelectorAll("#views .chosen")) button.classList.remove("chosen");
  }

  function show(count) {
    path.shown = Math.max(0, Math.min(path.starts.length, count));
    upto.value = path.shown;
    const line = path.shown ? path.lines[path.shown - 1] : 0;
    place.textContent = line ? `line ${line}` : "";
    if (window.filpostPlot.shown) window.filpostPlot.shown(line);
    soon(draw);
  }

  /** Marks all that a line of the program makes. */
  function choose(line, tell) {
    chosen = [];
    for (let piece = 0; piece < path.lines.length; piece++) if (path.lines[piece] === line) chosen.push(piece);
    drawPointer();
    if (tell && window.filpostPlot.told) window.filpostPlot.told(line);
  }

  upto.max = path.starts.length;
  upto.value = path.starts.length;
  upto.addEventListener("input", () => show(Number(upto.value)));
  element("fit").addEventListener("click", () => {
    fit();
    draw();
  });
  for (const button of document.querySelectorAll("#views [data-view]"))
    button.addEventListener("click", () => look(button.dataset.view));

  const used = layers.filter((layer) => path.strokes.includes(layer.index));
  for (const layer of under ? [...used, clLayer] : used) {
    const label = document.createElement("label"), box = document.createElement("input");
    const sample = document.createElement("i");
    box.type = "checkbox";
    box.checked = true;
    box.addEventListener("change", () => {
      layer.on = box.checked;
      draw();
    });
    sample.style.color = layer.colour;
    label.append(box, " ", sample, ` ${layer.name}`);
    element("layers").append(label);
  }

  window.addEventListener("resize", () => {
    fit();
    draw();
  });
  window.filpostPlot = { path, data, at, short, draw, soon, show, look, fit, choose };
  const flat = data.max[2] - data.min[2] < 1e-9;
  look(data.lathe ? "zx" : flat ? "xy" : "iso");
})();
