// The sizes of the panes: dragged or moved with the arrow keys, and remembered.
import { by } from "./dom.js";

const KEY = "filpost-studio-layout";

/** The sashes: the size that each changes, its bounds in pixels, and the side it grows from. */
const SASHES = {
  "sash-files": { size: "--files", least: 120, most: 480, at: "x", grows: 1, pane: "files" },
  "sash-program": { size: "--program", least: 240, most: 1400, at: "x", grows: -1, pane: "program" },
  "sash-judge": { size: "--judge", least: 80, most: 700, at: "y", grows: -1, pane: "judge" },
};

const STEP = 20;

function remembered() {
  try {
    return JSON.parse(localStorage.getItem(KEY)) ?? {};
  } catch {
    return {};
  }
}

/** Keeps a value for the next time, where the browser lets us. */
function remember(name, value) {
  try {
    localStorage.setItem(KEY, JSON.stringify({ ...remembered(), [name]: value }));
  } catch {
    // A browser that keeps nothing shows the layout of the first time.
  }
}

export function startLayout() {
  const main = document.querySelector("main");
  const sizes = remembered();
  for (const [id, sash] of Object.entries(SASHES)) {
    const handle = by(id);
    const set = (pixels, keep) => {
      const size = Math.round(Math.min(Math.max(pixels, sash.least), sash.most));
      main.style.setProperty(sash.size, `${size}px`);
      handle.setAttribute("aria-valuenow", String(size));
      if (keep) remember(sash.size, size);
    };
    handle.setAttribute("aria-valuemin", String(sash.least));
    handle.setAttribute("aria-valuemax", String(sash.most));
    const now = () => {
      const box = by(sash.pane).getBoundingClientRect();
      return sash.at === "x" ? box.width : box.height;
    };
    if (Number.isFinite(sizes[sash.size])) set(sizes[sash.size], false);
    else handle.setAttribute("aria-valuenow", String(Math.round(now())));
    handle.addEventListener("pointerdown", (event) => {
      const from = sash.at === "x" ? event.clientX : event.clientY;
      const old = now();
      handle.setPointerCapture(event.pointerId);
      handle.onpointermove = (moved) => {
        const to = sash.at === "x" ? moved.clientX : moved.clientY;
        set(old + (to - from) * sash.grows, true);
      };
      handle.onpointerup = () => (handle.onpointermove = null);
    });
    handle.addEventListener("keydown", (event) => {
      const steps = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (!steps) return;
      event.preventDefault();
      set(now() + steps * STEP * sash.grows, true);
    });
  }
}

/** Shows one pane where there is room for one alone. */
export function showView(name) {
  document.querySelector("main").dataset.view = name;
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
