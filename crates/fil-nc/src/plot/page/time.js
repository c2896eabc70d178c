// What is in force at a motion, and when it is over.

/** mm/min that rapids are taken to have. */
const RAPID = 10000;
/** Minutes from the start to the end of each piece. */
const ends = new Float64Array(path.total);
/** 1 for a piece whose feed nothing says. */
const timeless = new Uint8Array(path.total);

/** Length of a piece, mm. */
function lengthOf(trace, piece) {
  let sum = 0;
  const { steps } = trace;
  for (let at = 3 * trace.starts[piece], stop = 3 * (trace.ends[piece] - 1); at < stop; at += 3)
    sum += Math.hypot(steps[at + 3] - steps[at], steps[at + 4] - steps[at + 1], steps[at + 5] - steps[at + 2]);
  return sum * data.step;
}

/** Turns a minute at a piece; 0 where nothing says them. Surface speed is that of the middle
 *  between the ends of the piece, up to the limit in force. */
function turnsOf(piece, row) {
  const { speedKind, speed, limit } = path.inForce;
  if (speedKind[row] !== 2) return speed[row] / 1e4;
  const radius = (coordinate(path, path.starts[piece], 0) + coordinate(path, path.ends[piece] - 1, 0)) / 2;
  const turns = speed[row] / 1e4 * 1000 / (2 * Math.PI * Math.max(Math.abs(radius), 0.01));
  return limit[row] ? Math.min(turns, limit[row] / 1e4) : turns;
}

/** mm/min of a piece; 0 where nothing says it. */
function feedOf(piece, row) {
  if (path.strokes[piece] === 0) return RAPID;
  const { feedKind, feed } = path.inForce;
  if (row < 0 || feedKind[row] === 0) return 0;
  return feed[row] / 1e4 * (feedKind[row] === 1 ? 1 : turnsOf(piece, row));
}

for (let piece = 0, minutes = 0, row = -1; piece < path.total; piece++) {
  while (row + 1 < path.inForce.from.length && path.inForce.from[row + 1] <= piece) row++;
  const feed = feedOf(piece, row);
  if (feed > 0) minutes += lengthOf(path, piece) / feed;
  else timeless[piece] = 1;
  ends[piece] = minutes;
}

/** The points of a piece up to a share of its length, mm. */
function wayOf(trace, piece, share) {
  let at = trace.starts[piece], from = pointOf(trace, at), left = share * lengthOf(trace, piece);
  const way = [from];
  while (++at < trace.ends[piece]) {
    const to = pointOf(trace, at), step = Math.hypot(...to.map((value, axis) => value - from[axis]));
    if (step >= left) {
      if (step > 0) way.push(mix(from, 1 - left / step, to, left / step));
      break;
    }
    way.push(to);
    left -= step;
    from = to;
  }
  return way;
}

function clock(minutes) {
  const seconds = Math.round(minutes * 60), two = (value) => String(value).padStart(2, "0");
  return `${Math.floor(seconds / 3600)}:${two(Math.floor(seconds / 60) % 60)}:${two(seconds % 60)}`;
}

/** The name of a work offset: its number is that of the packed table, 0 for none. */
function offset(fixture) {
  if (!fixture) return "no offset";
  const code = fixture - 1;
  if (code < 1000) return `G${code}`;
  const tenths = Math.floor(code / 1000);
  return code < 1e6 ? `G${Math.floor(tenths / 10)}.${tenths % 10} P${code % 1000}` : `work offset ${code - 1e6}`;
}

/** mm of the length that a surface speed counts in. */
const SURFACE = data.unit.name === "inch" ? { size: 0.3048, name: "ft/min" } : { size: 1, name: "m/min" };

/** Tool, offset, feed and speed of a piece of the path, and the time since the start. */
function stateOf(piece, minutes) {
  const row = rowAt(path.inForce, piece);
  if (row < 0) return "";
  const { tool, feedKind, feed, speedKind, speed, spindle, fixture } = path.inForce;
  const said = [`T${tool[row]}`];
  if (fixture[row]) said.push(offset(fixture[row]));
  if (path.strokes[piece] !== 0 && feedKind[row])
    said.push(`F ${length(feed[row] / 1e4)} ${data.unit.name}${feedKind[row] === 1 ? "/min" : "/rev"}`);
  if (speedKind[row] === 1) said.push(`S ${round(speed[row] / 1e4)} rpm`);
  if (speedKind[row] === 2) said.push(`S ${round(speed[row] / 1e4 / SURFACE.size)} ${SURFACE.name}`);
  said.push(["spindle off", "clockwise", "counterclockwise"][spindle[row]], `after ${clock(minutes)}`);
  return said.join(" · ");
}
