// What lies under the pointer.
import * as THREE from "three";
import { rowAt } from "./read.js";

/** Pieces that are looked at as one: those beside the pointer are passed over. */
const BLOCK = 256;

/** The box around each block of pieces: least and greatest X, Y, Z. */
function boxesOf({ points, starts, ends, total }) {
  const boxes = new Float32Array(6 * Math.ceil(total / BLOCK));
  for (let block = 0; 6 * block < boxes.length; block++) {
    const at = 6 * block, last = Math.min(total, (block + 1) * BLOCK);
    boxes.fill(Infinity, at, at + 3);
    boxes.fill(-Infinity, at + 3, at + 6);
    for (let piece = block * BLOCK; piece < last; piece++)
      for (let index = 3 * starts[piece]; index < 3 * ends[piece]; index++) {
        const side = at + index % 3;
        if (points[index] < boxes[side]) boxes[side] = points[index];
        if (points[index] > boxes[side + 3]) boxes[side + 3] = points[index];
      }
  }
  return boxes;
}

/** Finds pieces of a program by their place on the picture. */
export class Picker {
  constructor(program) {
    this.program = program;
    this.boxes = boxesOf(program);
    this.right = new THREE.Vector3();
    this.up = new THREE.Vector3();
    this.matrix = new THREE.Matrix4();
    this.found = { piece: -1, point: new THREE.Vector3(), away: 0, isEnd: false };
  }

  /** The piece nearest to a place within some pixels, of those for which `seen` is true; null for
   *  none. `group` is what the points lie in. Of pieces as near, the one toward the eye counts. */
  at(px, py, reach, camera, group, seen, snaps = false) {
    const { points, starts, ends, total } = this.program, { boxes, found } = this;
    // Places as sums of the coordinates: across, down, toward the eye.
    this.matrix.copy(group.matrixWorld);
    const e = this.matrix.elements, { right, up, toward, center, scale, size } = camera;
    const row = (way, factor, shift) => [
      (e[0] * way.x + e[1] * way.y + e[2] * way.z) * factor, (e[4] * way.x + e[5] * way.y + e[6] * way.z) * factor,
      (e[8] * way.x + e[9] * way.y + e[10] * way.z) * factor,
      ((e[12] - center.x) * way.x + (e[13] - center.y) * way.y + (e[14] - center.z) * way.z) * factor + shift,
    ];
    const [a, b, c, x] = row(right, scale, size.width / 2), [d, f, g, y] = row(up, -scale, size.height / 2);
    const [i, j, k, z] = row(toward, 1, 0);
    let best = reach * reach, deep = -Infinity;
    found.piece = -1;
    const take = (piece, at, share, away, depth, isEnd) => {
      const nearer = away < best - 1 || (away < best + 1 && depth > deep);
      if (!nearer) return;
      best = Math.min(best, away);
      deep = depth;
      found.piece = piece;
      found.away = away;
      found.isEnd = isEnd;
      const from = 3 * at;
      found.point.set(...[0, 1, 2].map((n) => points[from + n] + (points[from + 3 + n] - points[from + n]) * share));
    };
    for (let block = 0; 6 * block < boxes.length; block++) {
      const o = 6 * block, low = (v) => (v < 0 ? 3 : 0), high = (v) => (v < 0 ? 0 : 3);
      const left = x + boxes[o + low(a)] * a + boxes[o + 1 + low(b)] * b + boxes[o + 2 + low(c)] * c;
      const most = x + boxes[o + high(a)] * a + boxes[o + 1 + high(b)] * b + boxes[o + 2 + high(c)] * c;
      if (px < left - reach || px > most + reach) continue;
      const top = y + boxes[o + low(d)] * d + boxes[o + 1 + low(f)] * f + boxes[o + 2 + low(g)] * g;
      const bottom = y + boxes[o + high(d)] * d + boxes[o + 1 + high(f)] * f + boxes[o + 2 + high(g)] * g;
      if (py < top - reach || py > bottom + reach) continue;
      const stop = Math.min(total, (block + 1) * BLOCK);
      for (let piece = block * BLOCK; piece < stop; piece++) {
        if (!seen(piece)) continue;
        let at = 3 * starts[piece];
        let bx = x + points[at] * a + points[at + 1] * b + points[at + 2] * c;
        let by = y + points[at] * d + points[at + 1] * f + points[at + 2] * g;
        for (at += 3; at < 3 * ends[piece]; at += 3) {
          const ax = bx, ay = by;
          bx = x + points[at] * a + points[at + 1] * b + points[at + 2] * c;
          by = y + points[at] * d + points[at + 1] * f + points[at + 2] * g;
          const wayX = bx - ax, wayY = by - ay, long = wayX * wayX + wayY * wayY;
          let share = long > 0 ? ((px - ax) * wayX + (py - ay) * wayY) / long : 0;
          share = share < 0 ? 0 : share > 1 ? 1 : share;
          // A measure snaps to the ends of motions.
          let isEnd = false;
          if (snaps) {
            const near = Math.min(long, reach * reach);
            if ((px - ax) ** 2 + (py - ay) ** 2 < near) [share, isEnd] = [0, true];
            else if ((px - bx) ** 2 + (py - by) ** 2 < near) [share, isEnd] = [1, true];
          }
          const dx = px - ax - wayX * share, dy = py - ay - wayY * share, away = dx * dx + dy * dy;
          if (away > best + 1) continue;
          const from = at - 3, depth = z + points[from] * i + points[from + 1] * j + points[from + 2] * k;
          take(piece, from / 3, share, away, depth, isEnd);
        }
      }
    }
    return found.piece < 0 ? null : found;
  }
}

/** The pieces of a line, as points one after the other with a break before each chain; and the box
 *  around them. At most so many pieces. */
export function piecesOf(program, line, most = 20_000) {
  const places = [], breaks = [], box = new THREE.Box3(), point = new THREE.Vector3();
  const { points, starts, ends, lines, total } = program;
  let first = -1, last = -1, count = 0;
  for (let piece = 0; piece < total && count < most; piece++) {
    if (lines[piece] !== line) continue;
    if (first < 0) first = piece;
    const goesOn = last >= 0 && ends[last] - 1 === starts[piece];
    if (!goesOn) breaks.push(places.length / 3);
    for (let at = starts[piece] + (goesOn ? 1 : 0); at < ends[piece]; at++) {
      places.push(points[3 * at], points[3 * at + 1], points[3 * at + 2]);
      box.expandByPoint(point.fromArray(points, 3 * at));
    }
    last = piece;
    count++;
  }
  return { first, last, box, breaks, points: new Float32Array(places) };
}

/** Makes a box larger by what a program does not run over in rapid traverse. */
export function cutBox({ points, starts, ends, strokes, total, base }, box, spot) {
  for (let piece = 0; piece < total; piece++) {
    if (strokes[piece] === 0) continue;
    for (let at = 3 * starts[piece]; at < 3 * ends[piece]; at += 3)
      box.expandByPoint(spot.set(points[at] + base[0], points[at + 1] + base[1], points[at + 2] + base[2]));
  }
}

/** Where the tool is after a share of a piece, into `into`. */
export function pointOn({ points, starts, ends }, piece, share, into) {
  const first = 3 * starts[piece], last = 3 * (ends[piece] - 1);
  let whole = 0;
  for (let at = first; at < last; at += 3)
    whole += Math.hypot(points[at + 3] - points[at], points[at + 4] - points[at + 1], points[at + 5] - points[at + 2]);
  let left = whole * share;
  for (let at = first; at < last; at += 3) {
    const x = points[at + 3] - points[at], y = points[at + 4] - points[at + 1], z = points[at + 5] - points[at + 2];
    const size = Math.hypot(x, y, z);
    if (size >= left && size > 0) {
      const part = left / size;
      return into.set(points[at] + x * part, points[at + 1] + y * part, points[at + 2] + z * part);
    }
    left -= size;
  }
  return into.fromArray(points, last);
}

/** The positions of the rotary axes after a share of a piece, degrees, into a list of two. */
export function rotaryAt({ rotaryFrom, rotary }, piece, share, into) {
  const row = rowAt(rotaryFrom, piece);
  into[0] = into[1] = 0;
  if (row < 0) return into;
  const before = rotaryFrom[row] === piece && row > 0 ? row - 1 : row;
  for (let axis = 0; axis < 2; axis++) {
    const from = rotary[2 * before + axis];
    into[axis] = from + (rotary[2 * row + axis] - from) * share;
  }
  return into;
}
