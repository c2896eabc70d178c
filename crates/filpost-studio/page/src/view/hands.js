// Mouse, fingers and keys.
import * as THREE from "three";
import { STEP } from "./camera.js";

/** Pixels that a press may move and still be a click, and that an arrow key moves. */
const STILL = 5, MOVE = 60;
const LARGER = 1.25;
/** Turns of an arrow key, in pixels of a drag. */
const ARROW = STEP / 0.008;

/** Moves the camera of a canvas; `acts` has what a click and the other keys do, and `changed`. */
export function addHands(canvas, camera, acts) {
  const pressed = new Map(), about = new THREE.Vector3();
  let moved = 0, pinch = null, clean = [];
  const listen = (type, work, options) => {
    canvas.addEventListener(type, work, options);
    clean.push(() => canvas.removeEventListener(type, work, options));
  };

  function startPinch() {
    const [a, b] = [...pressed.values()];
    pinch = { size: Math.hypot(a.x - b.x, a.y - b.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  }

  listen("pointerdown", (event) => {
    canvas.focus({ preventScroll: true });
    try { canvas.setPointerCapture(event.pointerId); } catch { /* the pointer is gone again */ }
    pressed.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    if (pressed.size === 1) {
      moved = 0;
      acts.pivot(event.offsetX, event.offsetY, about);
    } else if (pressed.size === 2) startPinch();
  });

  listen("pointermove", (event) => {
    const last = pressed.get(event.pointerId);
    if (!last) return acts.hover(event.offsetX, event.offsetY);
    const aside = event.offsetX - last.x, down = event.offsetY - last.y;
    last.x = event.offsetX;
    last.y = event.offsetY;
    moved += Math.abs(aside) + Math.abs(down);
    if (moved < STILL) return;
    if (pressed.size === 2) {
      const before = pinch;
      startPinch();
      if (before.size > 0) camera.zoom(pinch.size / before.size, pinch.x, pinch.y);
      camera.move(pinch.x - before.x, pinch.y - before.y);
    } else if (event.shiftKey || event.buttons & 6) camera.move(aside, down);
    else camera.turn(aside, down, about);
    acts.changed();
  });

  const end = (event) => {
    const was = pressed.get(event.pointerId);
    pressed.delete(event.pointerId);
    if (event.type === "pointerup" && was && moved < STILL && event.button === 0 && !pressed.size)
      acts.click(event.offsetX, event.offsetY);
  };
  listen("pointerup", end);
  listen("pointercancel", end);
  listen("contextmenu", (event) => event.preventDefault());
  listen("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    camera.zoom(Math.exp(-event.deltaY * lines * 0.0015), event.offsetX, event.offsetY);
    acts.changed();
  }, { passive: false });

  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  listen("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const arrow = arrows[event.key], middle = [camera.size.width / 2, camera.size.height / 2];
    if (arrow && event.shiftKey) camera.move(-arrow[0] * MOVE, -arrow[1] * MOVE);
    else if (arrow) camera.turn(arrow[0] * ARROW, arrow[1] * ARROW, acts.middle());
    else if (event.key === "+" || event.key === "=") camera.zoom(LARGER, ...middle);
    else if (event.key === "-") camera.zoom(1 / LARGER, ...middle);
    else if (!acts.key(event.key)) return;
    event.preventDefault();
    acts.changed();
  });
  return () => clean.forEach((undo) => undo());
}
