// What lies under the pointer, and what is said of it.

const tip = element("tip");
/** Pixels around the pointer, most lines that are listed, and length of the tool that is
 *  drawn there. */
const REACH = 8, LISTED = 6, TOOL = 60;
let found = null, chosen = [];

/** Squared distance of a place from a piece on the canvas. */
function distance(to, trace, piece, px, py) {
  let best = Infinity;
  let [bx, by] = placeOf(to, trace, trace.starts[piece]);
  for (let at = trace.starts[piece] + 1; at < trace.ends[piece]; at++) {
    const ax = bx, ay = by;
    [bx, by] = placeOf(to, trace, at);
    const wayX = bx - ax, wayY = by - ay, size = wayX * wayX + wayY * wayY;
    let share = size > 0 ? ((px - ax) * wayX + (py - ay) * wayY) / size : 0;
    share = share < 0 ? 0 : share > 1 ? 1 : share;
    const dx = px - ax - wayX * share, dy = py - ay - wayY * share;
    best = Math.min(best, dx * dx + dy * dy);
  }
  return best;
}

/** The pieces within reach of a place: the nearest of each line, the last one first of those
 *  as near, and how many further pieces there are. */
function nearest(trace, px, py, wanted) {
  const to = projection(), near = [];
  let more = 0;
  for (let block = 0; block * BLOCK < trace.shown; block++) {
    const [left, top, right, bottom] = frameOf(to, trace, block);
    if (px < left - REACH || px > right + REACH || py < top - REACH || py > bottom + REACH) continue;
    const stop = Math.min(trace.shown, (block + 1) * BLOCK);
    for (let piece = block * BLOCK; piece < stop; piece++) {
      if (!wanted(piece)) continue;
      const away = distance(to, trace, piece, px, py), line = trace.lines[piece];
      if (away > REACH * REACH) continue;
      const same = near.findIndex((one) => one.line === line);
      if (same >= 0 && near[same].away < away) continue;
      if (same >= 0) near.splice(same, 1);
      const at = near.findIndex((one) => away <= one.away);
      near.splice(at < 0 ? near.length : at, 0, { trace, piece, line, away });
      if (near.length > LISTED) more += near.splice(LISTED).length;
    }
  }
  return { near, more };
}

const isSeen = (piece) => layers[path.strokes[piece]].on && path.mask[piece];

function underPointer(px, py) {
  const list = nearest(path, px, py, isSeen);
  return list.near.length || !under || !underLayer.on ? list : nearest(under, px, py, () => true);
}

function point(px, py) {
  const { near: [first, ...others], more } = underPointer(px, py);
  found = first || null;
  drawPointer();
  tip.hidden = !found;
  if (!found) return;
  const listed = others.map(({ trace, line }) => `also ${lineOf(trace, line)}`);
  if (more) listed.push("and more");
  tip.textContent = [describe(found), ...listed].join("\n");
  const width = over.clientWidth, height = over.clientHeight;
  tip.style.left = `${Math.max(4, Math.min(px + 14, width - tip.offsetWidth - 4))}px`;
  tip.style.top = `${Math.max(4, Math.min(py + 14, height - tip.offsetHeight - 4))}px`;
}

const lineOf = (trace, line) => `line ${line}: ${trace.text.get(line).trimEnd()}`;

function describe({ trace, piece }) {
  const line = trace.lines[piece], last = trace.ends[piece] - 1;
  const end = said(pointOf(trace, last));
  const what = `${trace === under ? data.underName + ", " : ""}${data.strokes[trace.strokes[piece]].name} to ${end}`;
  const axis = trace.axes.from.length ? axisAt(trace, piece) : [0, 0, 0];
  const tilted = axis.some((part) => part !== 0) && `tool axis ${axis.map(round).join(" ")}`;
  const cause = trace.causeLines[line - 1], stack = trace.stacks[trace.causeStacks[line - 1] - 1];
  const origin = cause && `${trace.sourceName}:${cause}  ${trace.source.get(cause).trim()}`.trim();
  const state = trace === path && stateOf(piece, ends[piece]);
  return [lineOf(trace, line), what, tilted, state, origin, stack].filter((part) => part).join("\n");
}

/** A line from the tip of the tool along its axis. */
function drawTool(pen, point, axis) {
  const [x, y] = project(point), [dx, dy] = lead(axis);
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(x + TOOL * dx, y + TOOL * dy);
  pen.strokeStyle = ink("faint");
  pen.lineWidth = 4;
  pen.stroke();
  pen.beginPath();
  pen.arc(x, y, 6, 0, 2 * Math.PI);
  pen.fillStyle = ink("text");
  pen.fill();
}

/** What is marked: the tool while the path is played, the motion under the pointer, or those
 *  of the line that was clicked. */
function drawPointer() {
  const pen = penOf(over, true), to = projection();
  const now = path.shown < path.total && toolAt();
  if (now) {
    const layer = layers[path.strokes[now.piece]];
    pen.beginPath();
    if (layer.on && path.mask[now.piece]) now.way.forEach((point) => pen.lineTo(...project(point)));
    pen.strokeStyle = layer.colour;
    pen.lineWidth = 1.5;
    pen.stroke();
    drawTool(pen, now.point, now.axis);
  }
  const marked = found ? [found] : chosen.map((piece) => ({ trace: path, piece }));
  for (const { trace, piece } of marked) {
    pen.beginPath();
    for (let at = trace.starts[piece]; at < trace.ends[piece]; at++) pen.lineTo(...placeOf(to, trace, at));
    pen.strokeStyle = ink("text");
    pen.lineWidth = 3.5;
    pen.stroke();
  }
  if (!found || !found.trace.axes.from.length) return;
  drawTool(pen, pointOf(found.trace, found.trace.ends[found.piece] - 1), axisAt(found.trace, found.piece));
}

/** Marks all that a line of the program makes, and says where it ends. */
function choose(line) {
  chosen = [];
  for (let piece = 0; piece < path.total; piece++) if (path.lines[piece] === line) chosen.push(piece);
  place.textContent = `line ${line}`;
  const last = chosen.at(-1);
  if (last !== undefined) tellPlace(path, last, pointOf(path, path.ends[last] - 1), ends[last]);
  drawPointer();
}
