// The path up to a motion, or to a place on its way: slider and playback.

const upto = element("upto"), place = element("place");
const play = element("play"), speed = element("speed"), time = element("time");
/** Milliseconds between two pictures of the playback. */
const TICK = 50;
let playing = 0, minutes = 0, since = 0;

/** Shows the path up to a motion, and of the next one a share of its way. */
function show(count, share = 0) {
  const more = count >= path.shown;
  path.shown = Math.max(0, Math.min(path.total, count));
  path.part = path.shown < path.total ? share : 0;
  upto.value = path.shown;
  const now = toolAt();
  if (now) tellPlace(path, now.piece, now.point, now.minutes);
  goTo(now ? path.lines[now.piece] : 0);
  soon("picture", more ? drawOn : moved);
}

/** The piece that the tool is on, where its tip stands, its axis, and the minutes until then;
 *  null where the path has no motion. */
function toolAt() {
  if (!path.total) return null;
  const part = path.part || !path.shown;
  const piece = part ? path.shown : path.shown - 1, end = axisAt(path, piece);
  if (!part) return { piece, way: [], point: pointOf(path, path.ends[piece] - 1), axis: end, minutes: ends[piece] };
  const way = wayOf(path, piece, path.part), before = piece ? ends[piece - 1] : 0;
  const start = piece ? axisAt(path, piece - 1) : end;
  return {
    piece, way, point: way.at(-1), axis: mix(start, 1 - path.part, end, path.part),
    minutes: before + path.part * (ends[piece] - before),
  };
}

/** Says where the tool is, for those who point with the keyboard. */
function tellPlace(trace, piece, point, minutes) {
  const state = trace === path ? ` · ${stateOf(piece, minutes)}` : "";
  place.textContent = `line ${trace.lines[piece]} · ${said(point)}${state}`;
}

function stop() {
  if (playing) advance();
  clearInterval(playing);
  playing = 0;
  play.textContent = "Play";
  play.setAttribute("aria-pressed", "false");
}

/** How many motions are over after some minutes. */
function countOver(minutes) {
  let low = 0, high = path.total;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (ends[middle] <= minutes) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Shows the path up to this moment of the playback. */
function advance() {
  const now = performance.now();
  minutes += Number(speed.value) * (now - since) / 60000;
  since = now;
  let count = countOver(minutes);
  // A motion without a known feed takes no time: each of them is seen for a moment.
  const wait = timeless.indexOf(1, path.shown);
  if (wait >= 0 && wait < count) {
    count = wait + 1;
    minutes = ends[wait];
  }
  const before = count ? ends[count - 1] : 0;
  show(count, count < path.total ? (minutes - before) / (ends[count] - before) : 0);
}

function tick() {
  advance();
  if (path.shown >= path.total) stop();
}

function toggle() {
  if (playing) return stop();
  if (!path.total) return;
  if (path.shown >= path.total) show(0);
  minutes = toolAt().minutes;
  since = performance.now();
  play.textContent = "Pause";
  play.setAttribute("aria-pressed", "true");
  playing = setInterval(tick, TICK);
}

play.addEventListener("click", toggle);
play.disabled = upto.disabled = !path.total;
upto.max = path.total;
upto.value = path.total;
upto.addEventListener("input", () => {
  const count = Number(upto.value);
  stop();
  show(count);
});
if (path.total) {
  const rapid = data.unit.name === "inch" ? `${Math.round(RAPID / data.unit.size)} inch/min` : `${RAPID / 1000} m/min`;
  time.textContent = `${clock(ends[path.total - 1])} with rapids at ${rapid}`;
}
