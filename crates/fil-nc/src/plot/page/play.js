// The path up to a motion: slider and playback.

const upto = element("upto"), place = element("place");
const play = element("play"), speed = element("speed"), time = element("time");
/** Milliseconds between two pictures of the playback. */
const TICK = 50;
let playing = 0, minutes = 0;

/** Shows the path up to a motion. */
function show(count) {
  const more = count >= path.shown;
  path.shown = Math.max(0, Math.min(path.total, count));
  upto.value = path.shown;
  const line = path.shown ? path.lines[path.shown - 1] : 0;
  place.textContent = line ? `line ${line}` : "";
  goTo(line);
  soon("picture", more ? drawOn : moved);
}

function stop() {
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

function tick() {
  minutes += Number(speed.value) / 60 / (1000 / TICK);
  // A motion without a known feed takes no time.
  const step = ends[path.shown] - minutes > 0 ? 0 : 1;
  show(Math.max(countOver(minutes), path.shown + step));
  if (path.shown >= path.total) stop();
}

function toggle() {
  if (playing) return stop();
  if (!path.total) return;
  if (path.shown >= path.total) show(0);
  minutes = path.shown ? ends[path.shown - 1] : 0;
  play.textContent = "Pause";
  play.setAttribute("aria-pressed", "true");
  playing = setInterval(tick, TICK);
}

play.addEventListener("click", toggle);
play.disabled = upto.disabled = !path.total;
upto.max = path.total;
upto.value = path.total;
upto.addEventListener("input", () => {
  stop();
  show(Number(upto.value));
});
if (path.total) {
  const rapid = data.unit.name === "inch" ? `${Math.round(RAPID / data.unit.size)} inch/min` : `${RAPID / 1000} m/min`;
  time.textContent = `${clock(ends[path.total - 1])} with rapids at ${rapid}`;
}
