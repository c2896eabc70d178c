// Where the panes are and how large: dragged or moved with the keys, and remembered.
import { by } from "./dom.js";
import { remember, remembered } from "./memory.js";

/**
 * The panes around the editors, from the inner one to the outer one: the side each has at first, and the bounds of its
 * width (x) and its height (y) in pixels.
 */
const PANES = {
  program: { side: "right", x: [240, 1400], y: [100, 900] },
  judge: { side: "bottom", x: [240, 1200], y: [80, 700] },
  files: { side: "left", x: [120, 480], y: [80, 480] },
};

const STEP = 20;

/** How near to a side of the page a pane is dropped to go there: a part of its width or height. */
const NEAR = 0.3;

const SIDE_OF_KEY = { ArrowLeft: "left", ArrowRight: "right", ArrowUp: "top", ArrowDown: "bottom" };

const isFlat = (side) => side === "top" || side === "bottom";
const axisOf = (side) => (isFlat(side) ? "y" : "x");
const comesFirst = (side) => side === "left" || side === "top";

const main = document.querySelector("main");
const sides = {};

/** Lays the panes around the editors. */
function lay() {
  let rows = ["minmax(120px, 1fr)"], columns = ["minmax(240px, 1fr)"], areas = [["edit"]];
  for (const name of Object.keys(PANES)) {
    const side = sides[name], flat = isFlat(side);
    const tracks = [`var(--${name}-${axisOf(side)}-track)`, "5px"];
    const names = [name, `sash-${name}`];
    const around = (own, others) => (comesFirst(side) ? [...own, ...others] : [...others, ...own.toReversed()]);
    if (flat) {
      rows = around(tracks, rows);
      areas = around(names.map((each) => areas[0].map(() => each)), areas);
    } else {
      columns = around(tracks, columns);
      areas = areas.map((row) => around(names, row));
    }
    const sash = by(`sash-${name}`);
    sash.classList.toggle("flat", flat);
    sash.setAttribute("aria-orientation", flat ? "horizontal" : "vertical");
    sash.setAttribute("aria-label", `${flat ? "Height" : "Width"} of the pane ${titleOf(name)}`);
    const [least, most] = PANES[name][axisOf(side)];
    sash.setAttribute("aria-valuemin", String(least));
    sash.setAttribute("aria-valuemax", String(most));
    sash.setAttribute("aria-valuenow", String(Math.round(sizeOf(name))));
  }
  main.style.gridTemplateRows = rows.join(" ");
  main.style.gridTemplateColumns = columns.join(" ");
  main.style.gridTemplateAreas = areas.map((row) => `"${row.join(" ")}"`).join(" ");
}

const titleOf = (name) => by(`move-${name}`).dataset.title;

/** The size of a pane along the axis that its sash moves on. */
function sizeOf(name) {
  const box = by(name).getBoundingClientRect();
  return isFlat(sides[name]) ? box.height : box.width;
}

function resize(name, pixels, keep) {
  const axis = axisOf(sides[name]), [least, most] = PANES[name][axis];
  const size = Math.round(Math.min(Math.max(pixels, least), most));
  main.style.setProperty(`--${name}-${axis}`, `${size}px`);
  by(`sash-${name}`).setAttribute("aria-valuenow", String(size));
  if (keep) remember(`${name}-${axis}`, size);
}

function move(name, side) {
  sides[name] = side;
  remember(`${name}-side`, side);
  lay();
}

function startSash(name) {
  const sash = by(`sash-${name}`);
  const grows = () => (comesFirst(sides[name]) ? 1 : -1);
  const along = (event) => (isFlat(sides[name]) ? event.clientY : event.clientX);
  sash.addEventListener("pointerdown", (event) => {
    const from = along(event), old = sizeOf(name);
    sash.setPointerCapture(event.pointerId);
    sash.onpointermove = (moved) => resize(name, old + (along(moved) - from) * grows(), true);
    sash.onpointerup = () => (sash.onpointermove = null);
  });
  sash.addEventListener("keydown", (event) => {
    const steps = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!steps) return;
    event.preventDefault();
    resize(name, sizeOf(name) + steps * STEP * grows(), true);
  });
}

/** The side of the page that a point is near to; null for its middle. */
function sideAt({ clientX, clientY }) {
  const box = main.getBoundingClientRect();
  const x = (clientX - box.left) / box.width, y = (clientY - box.top) / box.height;
  const [side, distance] = [["left", x], ["right", 1 - x], ["top", y], ["bottom", 1 - y]].reduce((best, each) => (each[1] < best[1] ? each : best));
  return distance < NEAR ? side : null;
}

/** The button in the head of a pane: it is dragged to a side, or an arrow key moves the pane there. */
function startMover(name) {
  const button = by(`move-${name}`), target = by("drop");
  button.addEventListener("keydown", (event) => {
    const side = event.key === "Home" ? PANES[name].side : SIDE_OF_KEY[event.key];
    if (!side) return;
    event.preventDefault();
    move(name, side);
    button.focus();
  });
  button.addEventListener("pointerdown", (event) => {
    button.setPointerCapture(event.pointerId);
    let side = null;
    button.onpointermove = (moved) => {
      side = sideAt(moved);
      target.hidden = side === null;
      target.dataset.side = side ?? "";
    };
    const end = (act) => () => {
      button.onpointermove = button.onpointerup = button.onpointercancel = null;
      target.hidden = true;
      if (act && side) move(name, side);
    };
    button.onpointerup = end(true);
    button.onpointercancel = end(false);
  });
}

export function startLayout() {
  const known = remembered();
  for (const [name, pane] of Object.entries(PANES)) {
    const side = known[`${name}-side`];
    sides[name] = Object.values(SIDE_OF_KEY).includes(side) ? side : pane.side;
    for (const axis of ["x", "y"]) {
      const size = known[`${name}-${axis}`];
      if (Number.isFinite(size)) main.style.setProperty(`--${name}-${axis}`, `${size}px`);
    }
    startSash(name);
    startMover(name);
  }
  lay();
}

/** Shows one pane where there is room for one alone. */
export function showView(name) {
  main.dataset.view = name;
  for (const button of by("views").children) {
    if (button.dataset.view === name) button.setAttribute("aria-current", "true");
    else button.removeAttribute("aria-current");
  }
}

export function startViews() {
  by("views").addEventListener("click", (event) => {
    const button = event.target.closest("[data-view]");
    if (button) showView(button.dataset.view);
  });
}
