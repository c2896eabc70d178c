// The path on the canvas, drawn in slices so that the page answers while it is drawn.

const layers = data.strokes.map((stroke, index) => ({ ...stroke, index, on: true }));
const underLayer = { name: data.underName, colour: data.underColour, on: true };
const axisLayer = { name: "tool axis", colour: data.axisColour, on: true };
/** Paths of more pieces are drawn without dashes. */
const DASHES = 20000;
/** Least length of a line, and how far points may lie beside it, in pixels. */
const NEAR = 0.7, FLAT = 0.4;
/** Cells of the canvas of which each shows one tool axis, and its length, in pixels. */
const CELL = 26, AXIS = 22;

/** Draws the pieces of a trace, from one to another, that have a stroke of the mask, block by
 *  block. Points on a straight line on the canvas are one line; a block beside the canvas is
 *  left out. */
function* strokePieces(pen, trace, mask, first, stop) {
  const to = projection(), { a, b, c, d, e, f, x, y } = to;
  const { steps, starts, ends, strokes, kinds, mask: shown } = trace;
  for (let block = Math.floor(first / BLOCK); block * BLOCK < stop; block++) {
    if (!(kinds[block] & mask) || isBeside(to, trace, block)) continue;
    pen.beginPath();
    let last = -1, fromX = 0, fromY = 0, wayX = 0, wayY = 0, reach = 0, endX = 0, endY = 0;
    const until = Math.min(stop, (block + 1) * BLOCK);
    for (let piece = Math.max(first, block * BLOCK); piece < until; piece++) {
      if (!(mask >> strokes[piece] & 1) || !shown[piece]) continue;
      const start = starts[piece], end = ends[piece];
      if (start !== last) {
        if (last >= 0) pen.lineTo(endX, endY);
        const at = 3 * start;
        endX = fromX = x + steps[at] * a + steps[at + 1] * b + steps[at + 2] * c;
        endY = fromY = y + steps[at] * d + steps[at + 1] * e + steps[at + 2] * f;
        wayX = wayY = reach = 0;
        pen.moveTo(fromX, fromY);
      }
      for (let at = 3 * start + 3; at < 3 * end; at += 3) {
        const toX = x + steps[at] * a + steps[at + 1] * b + steps[at + 2] * c;
        const toY = y + steps[at] * d + steps[at + 1] * e + steps[at + 2] * f;
        const armX = toX - fromX, armY = toY - fromY;
        const along = armX * wayX + armY * wayY;
        if (reach > 0 && along >= reach && Math.abs(armX * wayY - armY * wayX) <= FLAT) {
          reach = along;
        } else if (reach > 0 || Math.abs(armX) + Math.abs(armY) >= NEAR) {
          if (reach > 0) {
            pen.lineTo(endX, endY);
            fromX = endX;
            fromY = endY;
          }
          wayX = toX - fromX;
          wayY = toY - fromY;
          reach = Math.hypot(wayX, wayY);
          if (reach < NEAR) reach = 0;
          else {
            wayX /= reach;
            wayY /= reach;
          }
        }
        endX = toX;
        endY = toY;
      }
      last = end - 1;
    }
    if (last >= 0) pen.lineTo(endX, endY);
    pen.stroke();
    yield;
  }
}

/** Least length on the canvas of a motion that is drawn as a point where it is seen end on, how
 *  far its ends may lie apart then, and the radius of the point, in pixels. */
const DEEP = 4, END_ON = 1, DOT = 2.5;

/** Motions of a stroke that are seen end on, such as holes from above. */
function* dotPieces(pen, trace, mask, first, stop) {
  const to = projection(), { starts, ends, strokes, steps, mask: shown } = trace;
  for (let block = Math.floor(first / BLOCK); block * BLOCK < stop; block++) {
    if (!(trace.kinds[block] & mask) || isBeside(to, trace, block)) continue;
    pen.beginPath();
    const until = Math.min(stop, (block + 1) * BLOCK);
    for (let piece = Math.max(first, block * BLOCK); piece < until; piece++) {
      if (!(mask >> strokes[piece] & 1) || !shown[piece]) continue;
      const from = starts[piece], end = ends[piece] - 1, way = [0, 1, 2].map((n) => steps[3 * end + n] - steps[3 * from + n]);
      if (Math.hypot(...way) * data.step * view.scale < DEEP) continue;
      const [x, y] = placeOf(to, trace, end), [fromX, fromY] = placeOf(to, trace, from);
      if (Math.hypot(x - fromX, y - fromY) > END_ON) continue;
      pen.moveTo(x + DOT, y);
      pen.arc(x, y, DOT, 0, 2 * Math.PI);
    }
    pen.fill();
    yield;
  }
}

/** Directions of a tilting tool, one a cell of the canvas. */
function* strokeAxes(pen, trace, cells, first, stop) {
  const to = projection(), { ends, mask } = trace;
  for (let block = Math.floor(first / BLOCK); block * BLOCK < stop; block++) {
    if (isBeside(to, trace, block)) continue;
    pen.beginPath();
    const until = Math.min(stop, (block + 1) * BLOCK);
    for (let piece = Math.max(first, block * BLOCK); piece < until; piece++) {
      if (!mask[piece] || !layers[trace.strokes[piece]].on) continue;
      const axis = axisAt(trace, piece);
      if (!axis.some((part) => part !== 0)) continue;
      const [x, y] = placeOf(to, trace, ends[piece] - 1);
      const cell = Math.floor(x / CELL) + 4096 * Math.floor(y / CELL);
      if (cells.has(cell)) continue;
      cells.add(cell);
      const [dx, dy] = lead(axis);
      pen.moveTo(x, y);
      pen.lineTo(x + AXIS * dx, y + AXIS * dy);
    }
    pen.stroke();
    yield;
  }
}

/** The path from one piece to another, block by block. */
function* picturePieces(pen, cells, first, stop) {
  pen.lineJoin = "round";
  pen.setLineDash([]);
  if (under && underLayer.on && first === 0) {
    pen.strokeStyle = underLayer.colour;
    pen.lineWidth = 5;
    pen.globalAlpha = 0.55;
    yield* strokePieces(pen, under, 15, 0, under.total);
    pen.globalAlpha = 1;
  }
  for (const layer of layers) {
    if (!layer.on) continue;
    pen.strokeStyle = layer.colour;
    pen.lineWidth = layer.index === 0 ? 1 : 1.5;
    pen.setLineDash(layer.index === 0 && path.total < DASHES ? [6, 4] : []);
    yield* strokePieces(pen, path, 1 << layer.index, first, stop);
    pen.fillStyle = layer.colour;
    if (layer.index > 0) yield* dotPieces(pen, path, 1 << layer.index, first, stop);
  }
  pen.setLineDash([]);
  if (path.axes.from.length && axisLayer.on) {
    pen.strokeStyle = axisLayer.colour;
    pen.lineWidth = 1;
    yield* strokeAxes(pen, path, cells, first, stop);
  }
}

/** The pen of a canvas of the size of the plot, in CSS pixels. */
function penOf(canvas, clear) {
  const ratio = window.devicePixelRatio || 1;
  const width = Math.round(plot.clientWidth * ratio), height = Math.round(plot.clientHeight * ratio);
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  if (clear) pen.clearRect(0, 0, plot.clientWidth, plot.clientHeight);
  pen.lineJoin = "round";
  return pen;
}

/** The last picture that is whole, and the one that is being drawn: each with the view that it
 *  is of, and the piece up to which it shows the path. */
let whole = null, drawn = null;
/** Milliseconds of drawing before the page answers: at a click, while it moves. */
const AT_ONCE = 60, MOVING = 8;

/** Draws anew: at once as far as the time goes, the rest in the frames that follow. Until then
 *  the last picture stands in, moved and scaled. */
function draw(time = AT_ONCE) {
  clearTimeout(resting);
  const reused = drawn && (!whole || drawn.canvas !== whole.canvas);
  const canvas = reused ? drawn.canvas : document.createElement("canvas");
  const cells = new Set(), upto = path.shown;
  drawn = { canvas, cells, upto, view: { ...view } };
  drawn.pieces = picturePieces(penOf(canvas, true), cells, 0, upto);
  goOn(drawn, time);
}

/** Paths of more pieces are drawn when the hand has rested for some milliseconds: while it moves
 *  the page, the browser has enough to do with the picture that stands in. */
const LARGE = 30000, REST = 120;
let resting = 0;

/** Shows what the hand has moved. */
function moved() {
  if (path.total + (under ? under.total : 0) <= LARGE) return draw(MOVING);
  drawn = null;
  clearTimeout(resting);
  resting = setTimeout(() => draw(MOVING), REST);
  paint();
}

/** Draws anew what is shown of the path: no earlier picture has the same. */
function drawOthers() {
  whole = null;
  draw();
}

/** Draws what has been added to the path since the last whole picture. */
function drawOn() {
  const same = whole && ["right", "up", "scale", "x", "y"].every((key) => whole.view[key] === view[key]);
  if (drawn ? drawn.upto > path.shown : !same || whole.upto > path.shown) return draw(MOVING);
  if (drawn) return paint();
  const { canvas, cells, upto: first } = whole, upto = path.shown;
  drawn = { canvas, cells, upto, view: whole.view };
  drawn.pieces = picturePieces(penOf(canvas, false), cells, first, upto);
  goOn(drawn, MOVING);
}

function goOn(picture, time) {
  if (picture !== drawn) return;
  const end = performance.now() + time;
  let done = false;
  while (!done && performance.now() < end) done = picture.pieces.next().done;
  if (done) {
    whole = drawn;
    drawn = null;
    if (whole.upto < path.shown) return drawOn();
  } else requestAnimationFrame(() => goOn(picture, 2 * MOVING));
  paint();
}

/** Shows what is drawn, and what stands in for the rest. */
function paint() {
  const pen = penOf(plot, true);
  const fits = whole && whole.view.right === view.right && whole.view.up === view.up &&
    whole.upto <= path.shown;
  if (fits) put(pen, whole);
  else {
    drawSkeleton(pen);
    if (drawn) put(pen, drawn);
  }
  const taken = [];
  if (data.lathe) drawMiddle(pen);
  drawOrigin(pen, taken);
  drawAxes(pen, taken);
  drawScale(pen, taken);
  drawChanges(pen, taken);
  drawPointer();
}

/** Lays a picture of another view from the same side over the canvas. */
function put(pen, { canvas, view: from }) {
  const share = view.scale / from.scale, ratio = window.devicePixelRatio || 1;
  pen.save();
  pen.translate(view.x - from.x * share, view.y - from.y * share);
  pen.scale(share, share);
  pen.drawImage(canvas, 0, 0, canvas.width / ratio, canvas.height / ratio);
  pen.restore();
}

/** A few points of the path, while a view from another side is drawn. */
function drawSkeleton(pen) {
  const to = projection(), few = Math.ceil(path.shown / 2000) || 1;
  pen.beginPath();
  for (let piece = 0; piece < path.shown; piece += few)
    pen.lineTo(...placeOf(to, path, path.ends[piece] - 1));
  pen.strokeStyle = ink("edge");
  pen.lineWidth = 0.7;
  pen.stroke();
}

const due = new Map();
/** Does a work at the next frame, in place of one of its kind that waits. */
function soon(kind, work) {
  cancelAnimationFrame(due.get(kind));
  due.set(kind, requestAnimationFrame(work));
}
