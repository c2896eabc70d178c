// What stands on the path: origin, tool changes, axes, a scale.

/** Colours of texts, by the theme. */
const ink = (name) => getComputedStyle(document.body).getPropertyValue(`--${name}`).trim();
/** Most labels on the canvas, and most tools that one of them names. */
const LABELS = 60, TOOLS = 4;

/** Frames of what is marked, left, top, right, bottom: no label lies on another one. */
const isFree = (taken, box) =>
  taken.every((b) => box[2] < b[0] || box[0] > b[2] || box[3] < b[1] || box[1] > b[3]);
const isInside = ([left, top, right, bottom]) =>
  left > 0 && top > 0 && right < plot.clientWidth && bottom < plot.clientHeight;
/** Height of a line of a label, pixels, and how far it goes below where its letters stand. */
const LINE = 12, FOOT = 3;

/** A way of a direction, with its name at the end; nothing where it leads away from the eye. */
function arrow(pen, taken, [x, y], way, size, name) {
  const [dx, dy] = lead(way).map((part) => part * size), reach = Math.hypot(dx, dy);
  if (reach < 4) return;
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(x + dx, y + dy);
  pen.stroke();
  taken.push([Math.min(x, x + dx) - 2, Math.min(y, y + dy) - 2, Math.max(x, x + dx) + 2, Math.max(y, y + dy) + 2]);
  const width = pen.measureText(name).width, paper = ink("paper");
  // Axes that lie on one another have their names one behind the other.
  for (let far = reach + 8; far < reach + 60; far += 6) {
    const px = x + dx / reach * far - width / 2, py = y + dy / reach * far + 4;
    const box = [px - 1, py - LINE, px + width + 1, py + FOOT];
    if (!isInside(box) || !isFree(taken, box)) continue;
    taken.push(box);
    const colour = pen.strokeStyle, wide = pen.lineWidth;
    pen.strokeStyle = paper;
    pen.lineWidth = 3;
    pen.strokeText(name, px, py);
    pen.strokeStyle = colour;
    pen.lineWidth = wide;
    pen.fillText(name, px, py);
    return;
  }
}

const AXES = { X: [1, 0, 0], Y: [0, 1, 0], Z: [0, 0, 1] };

/** The line about which a lathe turns the part. */
function drawMiddle(pen) {
  pen.beginPath();
  pen.moveTo(...project([0, 0, least[2] - (most[2] - least[2]) / 20]));
  pen.lineTo(...project([0, 0, most[2] + (most[2] - least[2]) / 20]));
  pen.strokeStyle = ink("faint");
  pen.lineWidth = 1;
  pen.setLineDash([12, 3, 2, 3]);
  pen.stroke();
  pen.setLineDash([]);
}

/** The origin of the part, and the directions of its axes. */
function drawOrigin(pen, taken) {
  const at = project([0, 0, 0]);
  pen.font = "12px sans-serif";
  pen.strokeStyle = pen.fillStyle = ink("origin");
  pen.lineWidth = 1.5;
  pen.beginPath();
  pen.arc(...at, 5, 0, 2 * Math.PI);
  pen.stroke();
  taken.push([at[0] - 6, at[1] - 6, at[0] + 6, at[1] + 6]);
  for (const [name, way] of Object.entries(AXES)) arrow(pen, taken, at, way, 36, name);
}

/** The axes in the corner, where the origin with its own is out of sight. */
function drawAxes(pen, taken) {
  const at = [44, plot.clientHeight - 44], [x, y] = project([0, 0, 0]);
  if (isInside([x - 20, y - 20, x + 20, y + 20])) return;
  pen.font = "12px sans-serif";
  pen.strokeStyle = pen.fillStyle = ink("faint");
  pen.lineWidth = 1.2;
  for (const [name, way] of Object.entries(AXES)) arrow(pen, taken, at, way, 30, name);
}

/** Puts a label beside a point, where none stands yet. */
function putLabel(pen, taken, label, px, py) {
  const width = pen.measureText(label).width;
  for (let ring = 0; ring < 6; ring++) {
    const up = -6 - 15 * ring, down = 16 + 15 * ring;
    for (const [dx, dy] of [[7, up], [7, down], [-width - 7, up], [-width - 7, down]]) {
      const box = [px + dx - 3, py + dy - LINE, px + dx + width + 3, py + dy + FOOT];
      if (!isInside(box) || !isFree(taken, box)) continue;
      taken.push(box);
      pen.strokeText(label, px + dx, py + dy);
      pen.fillText(label, px + dx, py + dy);
      return;
    }
  }
}

/** Side of a cell whose tool changes are told together, in pixels: rings of so many must not
 *  hide the path. */
const CHANGE = path.changes.from.length > 2000 ? 24 : 6;

/** The tool changes in sight, those at one place together. */
function changesInSight() {
  const { from, tool, x, y, z } = path.changes, to = projection();
  const places = new Map();
  for (let change = 0; change < from.length; change++) {
    if (path.shown < path.total && from[change] >= path.shown) continue;
    if (path.mask[from[change]] === 0) continue;
    const px = to.x + x[change] * to.a + y[change] * to.b + z[change] * to.c;
    const py = to.y + x[change] * to.d + y[change] * to.e + z[change] * to.f;
    if (px < 0 || py < 0 || px > plot.clientWidth || py > plot.clientHeight) continue;
    const key = Math.round(px / CHANGE) + 16384 * Math.round(py / CHANGE);
    const place = places.get(key);
    if (!place) places.set(key, { px, py, tools: [tool[change]], more: 0 });
    else if (place.tools.includes(tool[change])) continue;
    else if (place.tools.length < TOOLS) place.tools.push(tool[change]);
    else place.more++;
  }
  return [...places.values()];
}

function drawChanges(pen, taken) {
  const places = changesInSight();
  pen.fillStyle = ink("paper");
  pen.strokeStyle = ink("text");
  pen.lineWidth = 1.2;
  pen.beginPath();
  for (const { px, py } of places) {
    pen.moveTo(px + 4, py);
    pen.arc(px, py, 4, 0, 2 * Math.PI);
    taken.push([px - 3, py - 3, px + 3, py + 3]);
  }
  pen.fill();
  pen.stroke();
  pen.font = "13px sans-serif";
  pen.fillStyle = ink("text");
  pen.strokeStyle = ink("paper");
  pen.lineWidth = 4;
  for (const { px, py, tools, more } of places.slice(0, LABELS)) {
    const names = tools.map((tool) => `T${tool}`).join(" ");
    putLabel(pen, taken, more ? `${names} and more` : names, px, py);
  }
}

/** A bar of a round length. */
function drawScale(pen, taken) {
  const wanted = 120 / view.scale / data.unit.size;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const size = [5, 2, 1].map((digit) => digit * power).find((value) => value <= wanted);
  const bar = size * data.unit.size * view.scale;
  pen.font = "12px sans-serif";
  const label = `${Number(size.toPrecision(1))} ${data.unit.name}`;
  const width = Math.max(pen.measureText(label).width, bar);
  const right = plot.clientWidth - 20, bottom = plot.clientHeight - 20;
  const boxOf = ([x, y]) => [x - width, y - 6 - LINE, x, y + FOOT];
  const corners = [[right, bottom], [right, 32], [20 + width, 32]];
  const [x, y] = corners.find((corner) => isFree(taken, boxOf(corner))) ?? corners[0];
  const line = new Path2D(`M${x - bar} ${y}H${x}`);
  pen.strokeStyle = ink("paper");
  pen.lineWidth = 6;
  pen.stroke(line);
  pen.textAlign = "right";
  pen.lineWidth = 4;
  pen.strokeText(label, x, y - 6);
  pen.strokeStyle = pen.fillStyle = ink("faint");
  pen.lineWidth = 2;
  pen.stroke(line);
  pen.fillText(label, x, y - 6);
  taken.push(boxOf([x, y]));
  pen.textAlign = "left";
}
