// From where the path is seen, and what lies where on the canvas.

const plot = element("plot"), over = element("over");
const half = Math.SQRT1_2, sixth = 1 / Math.sqrt(6);
const VIEWS = {
  xy: [[1, 0, 0], [0, 1, 0]],
  zx: [[0, 0, 1], [1, 0, 0]],
  zy: [[0, 0, 1], [0, 1, 0]],
  iso: [[half, half, 0], [-sixth, sixth, 2 * sixth]],
};
const view = { right: [1, 0, 0], up: [0, 1, 0], scale: 1, x: 0, y: 0 };
/** The box that is fitted, and its middle. */
const least = [...data.min], most = [...data.max], middle = [0, 0, 0];

/** Takes the box of what is shown of the path, on a lathe with the middle of the part; all of it
 *  where nothing is hidden. */
function surround() {
  const isHidden = (piece) => !path.mask[piece] || !layers[path.strokes[piece]].on;
  let hidden = 0;
  for (let piece = 0; piece < path.total; piece++) hidden += isHidden(piece);
  for (let axis = 0; axis < 3; axis++) {
    let low = Infinity, high = -Infinity;
    for (let piece = 0; hidden && piece < path.total; piece++) {
      if (isHidden(piece)) continue;
      for (let at = path.starts[piece]; at < path.ends[piece]; at++) {
        low = Math.min(low, path.steps[3 * at + axis]);
        high = Math.max(high, path.steps[3 * at + axis]);
      }
    }
    const some = low <= high, turns = data.lathe && axis === 0;
    least[axis] = some ? data.min[axis] + low * data.step : data.min[axis];
    most[axis] = some ? data.min[axis] + high * data.step : data.max[axis];
    if (turns) least[axis] = Math.min(least[axis], 0);
    if (turns) most[axis] = Math.max(most[axis], 0);
    middle[axis] = (least[axis] + most[axis]) / 2;
  }
}
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const mix = (a, p, b, q) => a.map((value, axis) => value * p + b[axis] * q);

/** A point of the part, mm, on the canvas, in CSS pixels. */
function project(point) {
  const from = point.map((value, axis) => value - middle[axis]);
  return [view.x + dot(from, view.right) * view.scale, view.y - dot(from, view.up) * view.scale];
}

/** Where a direction of the part leads on the canvas. */
const lead = (way) => [dot(way, view.right), -dot(way, view.up)];

/** How steps become places on the canvas: three numbers and a sum, across and down. */
function projection() {
  const [right, up] = [view.right, view.up].map((way) => way.map((part) => part * view.scale));
  const from = data.min.map((value, axis) => value - middle[axis]);
  return {
    a: right[0] * data.step, b: right[1] * data.step, c: right[2] * data.step,
    d: -up[0] * data.step, e: -up[1] * data.step, f: -up[2] * data.step,
    x: view.x + dot(from, right), y: view.y - dot(from, up),
  };
}

/** Where a point of a trace lies on the canvas. */
function placeOf({ a, b, c, d, e, f, x, y }, { steps }, point) {
  const at = 3 * point, i = steps[at], j = steps[at + 1], k = steps[at + 2];
  return [x + i * a + j * b + k * c, y + i * d + j * e + k * f];
}

/** The frame of a block on the canvas: left, top, right, bottom. */
function frameOf({ a, b, c, d, e, f, x, y }, { boxes }, block) {
  const at = 6 * block, low = (value) => (value < 0 ? 3 : 0), high = (value) => (value < 0 ? 0 : 3);
  const sum = (p, q, r, side) =>
    boxes[at + side(p)] * p + boxes[at + 1 + side(q)] * q + boxes[at + 2 + side(r)] * r;
  return [x + sum(a, b, c, low), y + sum(d, e, f, low), x + sum(a, b, c, high), y + sum(d, e, f, high)];
}

/** True when a block lies beside the canvas. */
function isBeside(to, trace, block) {
  const [left, top, right, bottom] = frameOf(to, trace, block);
  return right < 0 || bottom < 0 || left > plot.clientWidth || top > plot.clientHeight;
}

/** The direction of the tool at a piece; upright where nothing else is said. Tools of a lathe
 *  that do not turn have none. */
function axisAt(trace, piece) {
  const row = rowAt(trace.axes, piece), { x, y, z } = trace.axes;
  if (row < 0) return data.lathe && trace === path ? [0, 0, 0] : [0, 0, 1];
  return [x[row] / 1e4, y[row] / 1e4, z[row] / 1e4];
}

function fit() {
  surround();
  const { clientWidth: width, clientHeight: height } = plot;
  let right = 1e-3, up = 1e-3;
  for (let corner = 0; corner < 8; corner++) {
    const from = middle.map((value, axis) => (corner >> axis & 1 ? most : least)[axis] - value);
    right = Math.max(right, Math.abs(dot(from, view.right)));
    up = Math.max(up, Math.abs(dot(from, view.up)));
  }
  view.scale = Math.max(Math.min((width - 80) / (2 * right), (height - 80) / (2 * up)), 1e-9);
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

function turn(aside, down) {
  const toward = cross(view.right, view.up);
  view.right = mix(view.right, Math.cos(aside), toward, Math.sin(aside));
  const forward = cross(view.right, view.up);
  view.up = mix(view.up, Math.cos(down), forward, -Math.sin(down));
  for (const button of document.querySelectorAll("#views .chosen")) button.classList.remove("chosen");
}
