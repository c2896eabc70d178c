// Mouse, keys, theme; and the first picture.

/** Makes the picture larger about a place of the canvas. */
function zoom(factor, x, y) {
  view.x = x + (view.x - x) * factor;
  view.y = y + (view.y - y) * factor;
  view.scale *= factor;
  soon("picture", moved);
}

function shift(aside, down) {
  view.x += aside;
  view.y += down;
  soon("picture", moved);
}

over.addEventListener("wheel", (event) => {
  event.preventDefault();
  zoom(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY);
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
  const near = still ? underPointer(event.offsetX, event.offsetY).near[0] : null;
  if (near && near.trace === path) chooseLine(near.line);
});
over.addEventListener("pointermove", (event) => {
  if (!(event.buttons & 3)) {
    soon("tip", () => point(event.offsetX, event.offsetY));
    return;
  }
  tip.hidden = true;
  if (!event.shiftKey && !(event.buttons & 2)) return shift(event.movementX, event.movementY);
  turn(event.movementX * 0.008, event.movementY * 0.008);
  soon("picture", moved);
});
over.addEventListener("pointerleave", () => {
  found = null;
  tip.hidden = true;
  drawPointer();
});
over.addEventListener("contextmenu", (event) => event.preventDefault());

function fitAndDraw() {
  fit();
  draw();
}
element("fit").addEventListener("click", fitAndDraw);
for (const button of document.querySelectorAll("#views [data-view]"))
  button.addEventListener("click", () => look(button.dataset.view));
window.addEventListener("resize", fitAndDraw);

const theme = element("theme");
theme.addEventListener("click", () => {
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  const now = document.documentElement.dataset.theme || (dark ? "dark" : "light");
  document.documentElement.dataset.theme = now === "dark" ? "light" : "dark";
  paint();
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", paint);

const STEPS = { ArrowRight: 1, ArrowLeft: -1, PageDown: 100, PageUp: -100, Home: -Infinity, End: Infinity };
/** What zooms by a key, and pixels of a move by a key with shift. */
const LARGER = 1.25, MOVE = 60;
const zoomMiddle = (factor) => zoom(factor, plot.clientWidth / 2, plot.clientHeight / 2);
const MOVES = { ArrowLeft: [MOVE, 0], ArrowRight: [-MOVE, 0], ArrowUp: [0, MOVE], ArrowDown: [0, -MOVE] };
const KEYS = {
  " ": toggle, f: fitAndDraw, d: () => theme.click(),
  1: () => look("xy"), 2: () => look("zx"), 3: () => look("zy"), 4: () => look("iso"),
  "+": () => zoomMiddle(LARGER), "=": () => zoomMiddle(LARGER), "-": () => zoomMiddle(1 / LARGER),
  ArrowUp: () => chooseLine(current - 1), ArrowDown: () => chooseLine(current + 1),
};
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  if (/^(INPUT|SELECT|BUTTON)$/.test(event.target.tagName)) return;
  if (event.shiftKey && event.key in MOVES) shift(...MOVES[event.key]);
  else if (event.key in STEPS) {
    stop();
    show(path.shown + STEPS[event.key]);
  } else if (KEYS[event.key]) KEYS[event.key]();
  else return;
  event.preventDefault();
});

/** Lays the path of a page that was dropped under this one. */
async function takeDropped(file) {
  try {
    under = await readOther(await file.text());
    data.underName = underLayer.name = file.name;
    showUnder();
    drawOthers();
    tellMissing();
    place.textContent = `${file.name}: ${under.total} motions under the path`;
  } catch (error) {
    place.textContent = `${file.name} can't be shown: ${error.message}`;
  }
}
window.addEventListener("dragover", (event) => event.preventDefault());
window.addEventListener("drop", (event) => {
  event.preventDefault();
  const [file] = event.dataTransfer.files;
  if (file) takeDropped(file);
});

/** Lists the lines that are not drawn. */
function tellMissing() {
  const missing = element("missing"), all = [...path.leftOut, ...(under ? under.leftOut.map((one) => `${data.underName}, ${one}`) : [])];
  missing.hidden = !all.length;
  missing.querySelector("summary").textContent = all.length === 1 ? "1 gap in the path" : `${all.length} gaps in the path`;
  missing.querySelector("p").textContent = all.join("\n");
}

tellMissing();
writeRows();
wait.hidden = true;
const flat = data.max[2] - data.min[2] < 1e-9;
look(data.lathe ? "zx" : flat ? "xy" : "iso");
document.documentElement.dataset.ready = "yes";
