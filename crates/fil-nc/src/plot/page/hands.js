// Mouse, keys, theme; and the first picture.

over.addEventListener("wheel", (event) => {
  event.preventDefault();
  const factor = Math.exp(-event.deltaY * 0.0015);
  view.x = event.offsetX + (view.x - event.offsetX) * factor;
  view.y = event.offsetY + (view.y - event.offsetY) * factor;
  view.scale *= factor;
  soon("picture", moved);
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
  if (!near || near.trace !== path) return;
  choose(near.line);
  goTo(near.line);
  tell(near.line);
});
over.addEventListener("pointermove", (event) => {
  if (!(event.buttons & 3)) {
    soon("tip", () => point(event.offsetX, event.offsetY));
    return;
  }
  tip.hidden = true;
  if (event.shiftKey || event.buttons & 2) turn(event.movementX * 0.008, event.movementY * 0.008);
  else {
    view.x += event.movementX;
    view.y += event.movementY;
  }
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

const STEPS = { ArrowRight: 1, ArrowLeft: -1, PageDown: 100, PageUp: -100, Home: -Infinity, End: Infinity };
const KEYS = {
  " ": toggle, f: fitAndDraw, d: () => theme.click(),
  1: () => look("xy"), 2: () => look("zx"), 3: () => look("zy"), 4: () => look("iso"),
};
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  if (/^(INPUT|SELECT|BUTTON)$/.test(event.target.tagName)) return;
  if (event.key in STEPS) {
    stop();
    show(path.shown + STEPS[event.key]);
  } else if (KEYS[event.key]) KEYS[event.key]();
  else return;
  event.preventDefault();
});

writeRows();
wait.hidden = true;
const flat = data.max[2] - data.min[2] < 1e-9;
look(data.lathe ? "zx" : flat ? "xy" : "iso");
document.documentElement.dataset.ready = "yes";
