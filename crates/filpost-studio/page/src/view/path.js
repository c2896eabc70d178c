// The path as few meshes: each is a range of one set of buffers, and what is shown of it, in
// which colours and up to where, is decided on the graphics card.
import * as THREE from "three";
import { rowAt } from "./read.js";

/** Lines of a mesh, and most meshes of a path. */
const CHUNK = 32768, MOST = 90;
/** Paths of more points are drawn with lines of one pixel. */
export const WIDE = 200_000;
/** Tools that have a colour of their own. */
export const TOOLS = 8;

/** More pieces than any path has: all of it is shown. */
export const ALL = 1e9;

export const BY = { motion: 0, tool: 1, feed: 2, one: 3 };

const VERTEX = `
#ifdef WIDE
in vec2 corner;
in vec3 from, to;
in float passed, passes;
#else
in float passes;
#endif
in vec4 look;
uniform vec2 room;
uniform float width, by, back;
uniform vec4 shown;
uniform vec3 strokes[4], tools[${TOOLS}], feeds[3], one;
flat out vec3 colour;
flat out float seen;
out float progress;
out vec3 place;

vec3 chosen(float stroke) {
  if (by > 2.5) return one;
  if (by < 0.5 || stroke < 0.5) return strokes[int(stroke + 0.5)];
  if (by < 1.5) return tools[int(look.y + 0.5)];
  float share = look.z / 255.0;
  return share < 0.5 ? mix(feeds[0], feeds[1], share * 2.0) : mix(feeds[1], feeds[2], share * 2.0 - 1.0);
}

void main() {
  float stroke = look.x;
  seen = look.w > 0.5 ? shown[int(stroke + 0.5)] : 0.0;
  colour = chosen(stroke);
  mat4 all = projectionMatrix * modelViewMatrix;
#ifdef WIDE
  vec4 a = all * vec4(from, 1.0), b = all * vec4(to, 1.0);
  vec2 way = (b.xy - a.xy) * room;
  float size = length(way);
  way = size > 1e-4 ? way / size : vec2(1.0, 0.0);
  vec2 side = vec2(-way.y, way.x) * corner.y + way * (corner.x * 2.0 - 1.0);
  gl_Position = mix(a, b, corner.x);
  gl_Position.xy += side * width / room;
  progress = mix(passed, passes, corner.x);
  place = mix(from, to, corner.x);
#else
  gl_Position = all * vec4(position, 1.0);
  progress = passes;
  place = position;
#endif
  // Feeds lie over rapids at the same place, the program over the second one.
  gl_Position.z += (back + (stroke < 0.5 ? 1.0 : 0.0)) * 1e-4;
}`;

const FRAGMENT = `
precision highp float;
flat in vec3 colour;
flat in float seen;
in float progress;
in vec3 place;
uniform float upto, ghosts;
uniform vec3 ghost;
uniform vec4 section;
out vec4 pixel;
void main() {
  if (seen < 0.5 || dot(place, section.xyz) > section.w) discard;
  bool later = progress > upto;
  if (later && ghosts < 0.5) discard;
  pixel = vec4(later ? ghost : colour, 1.0);
}`;

function material(isWide) {
  const colours = (count) => ({ value: Array.from({ length: count }, () => new THREE.Color()) });
  return new THREE.ShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT,
    defines: isWide ? { WIDE: 1 } : {}, side: THREE.DoubleSide,
    uniforms: {
      room: { value: new THREE.Vector2(1, 1) }, width: { value: 1.8 }, by: { value: BY.motion },
      back: { value: 0 }, shown: { value: new THREE.Vector4(1, 1, 1, 1) },
      strokes: colours(4), tools: colours(TOOLS), feeds: colours(3), one: { value: new THREE.Color() },
      upto: { value: ALL }, ghosts: { value: 1 }, ghost: { value: new THREE.Color() },
      section: { value: new THREE.Vector4(0, 0, 0, 1) },
    },
  });
}

/** The numbers of tools in their order, each once. */
export function toolsOf(program) {
  const numbers = new Set(program.forceFrom.length ? program.tool : program.changeTool);
  return [...numbers].filter((number) => number > 0);
}

/** Least and greatest feed a minute of a program, mm/min; zeros without any. */
export function feedRange({ feed, feedKind }) {
  let low = Infinity, high = 0;
  for (let row = 0; row < feed.length; row++) {
    if (feedKind[row] !== 1 || !(feed[row] > 0)) continue;
    low = Math.min(low, feed[row]);
    high = Math.max(high, feed[row]);
  }
  return high ? [low, high] : [0, 0];
}

/** Where each point lies on the path, in pieces and shares of one; and of the line that ends at it
 *  its stroke, the place of its tool, its feed as a share of 255, and 1 where there is one. */
function pointColumns(program) {
  const { points, starts, ends, strokes, total } = program;
  const count = points.length / 3, passes = new Float32Array(count), look = new Uint8Array(4 * count);
  const tools = toolsOf(program), [low, high] = feedRange(program), span = Math.log(high / low) || 1;
  let row = -1, change = -1, tool = 0, feed = 0;
  for (let piece = 0; piece < total; piece++) {
    while (change + 1 < program.changeFrom.length && program.changeFrom[change + 1] <= piece) {
      change++;
      tool = Math.max(0, tools.indexOf(program.changeTool[change])) % TOOLS;
    }
    while (row + 1 < program.forceFrom.length && program.forceFrom[row + 1] <= piece) {
      row++;
      tool = Math.max(0, tools.indexOf(program.tool[row])) % TOOLS;
      const isFeed = program.feedKind[row] === 1 && program.feed[row] > 0;
      feed = isFeed ? Math.round(Math.log(program.feed[row] / low) / span * 255) : 0;
    }
    const first = starts[piece], last = ends[piece] - 1;
    let sum = 0;
    for (let at = first + 1; at <= last; at++) {
      const to = 3 * at;
      sum += Math.hypot(points[to] - points[to - 3], points[to + 1] - points[to - 2], points[to + 2] - points[to - 1]);
      passes[at] = sum;
    }
    passes[first] = piece;
    for (let at = first + 1; at <= last; at++) {
      passes[at] = piece + passes[at] / (sum || 1);
      look[4 * at] = strokes[piece];
      look[4 * at + 1] = tool;
      look[4 * at + 2] = feed;
      look[4 * at + 3] = 1;
    }
  }
  return { passes, look };
}

/** The ball around points from one to another. */
function ballOf(points, first, last) {
  const box = new THREE.Box3(), point = new THREE.Vector3();
  for (let at = first; at <= last; at++) box.expandByPoint(point.fromArray(points, 3 * at));
  return box.getBoundingSphere(new THREE.Sphere());
}

/** Four corners of a line that is drawn as two triangles. */
const CORNERS = new Float32Array([0, -1, 1, -1, 0, 1, 1, 1]);

function wideGeometry(points, passes, look) {
  const geometry = new THREE.InstancedBufferGeometry();
  geometry.setAttribute("corner", new THREE.BufferAttribute(CORNERS, 2));
  geometry.setIndex([0, 1, 2, 2, 1, 3]);
  // Each line is an instance: its end is its start of the next one.
  const pair = (list, size, names) => {
    const buffer = new THREE.InstancedInterleavedBuffer(list, size);
    names.forEach((name, at) => name && geometry.setAttribute(name, new THREE.InterleavedBufferAttribute(buffer, size, at * size)));
  };
  pair(points, 3, ["from", "to"]);
  pair(passes, 1, ["passed", "passes"]);
  pair(look, 4, [null, "look"]);
  geometry.instanceCount = Math.max(0, points.length / 3 - 1);
  return geometry;
}

/** A path that can be drawn. */
export class Path {
  constructor(program) {
    const { points } = program, count = points.length / 3;
    this.program = program;
    this.isWide = count <= WIDE;
    this.group = new THREE.Group();
    this.material = material(this.isWide);
    const { passes, look } = pointColumns(program);
    if (this.isWide) this.addWide(points, passes, look);
    else this.addThin(points, passes, look);
  }

  addWide(points, passes, look) {
    if (points.length < 6) return;
    const geometry = wideGeometry(points, passes, look);
    geometry.boundingSphere = ballOf(points, 0, points.length / 3 - 1);
    this.group.add(new THREE.Mesh(geometry, this.material));
  }

  /** Ranges of points, each a mesh. A line goes from each point to the next one; where there is
   *  none, both of its ends are one point. */
  addThin(points, passes, look) {
    const count = points.length / 3, size = Math.max(CHUNK, Math.ceil(count / MOST));
    const position = new THREE.BufferAttribute(points, 3);
    const others = { passes: new THREE.BufferAttribute(passes, 1), look: new THREE.BufferAttribute(look, 4) };
    for (let first = 0; first < count - 1; first += size) {
      const last = Math.min(count - 1, first + size), index = new Uint32Array(2 * (last - first));
      for (let at = first, to = 0; at < last; at++) {
        index[to++] = look[4 * at + 7] ? at : at + 1;
        index[to++] = at + 1;
      }
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", position);
      geometry.setAttribute("passes", others.passes);
      geometry.setAttribute("look", others.look);
      geometry.setIndex(new THREE.BufferAttribute(index, 1));
      geometry.boundingSphere = ballOf(points, first, last);
      this.group.add(new THREE.LineSegments(geometry, this.material));
    }
  }

  set(name, value) {
    this.material.uniforms[name].value = value;
  }

  dispose() {
    this.group.removeFromParent();
    for (const mesh of this.group.children) mesh.geometry.dispose();
    this.material.dispose();
  }
}

/** Lines over the path, of one colour, that are not hidden by anything. */
export class Mark {
  constructor() {
    this.group = new THREE.Group();
    this.material = material(true);
    this.material.depthTest = false;
    this.material.uniforms.by.value = BY.one;
    this.material.uniforms.width.value = 3;
    this.mesh = null;
  }

  /** Marks lines, given as one point after the other with a break before each chain. */
  show(points, breaks) {
    this.empty();
    const count = points.length / 3;
    if (count < 2) return;
    const look = new Uint8Array(4 * count).fill(1), passes = new Float32Array(count);
    for (const at of breaks) look[4 * at + 3] = 0;
    const geometry = wideGeometry(points, passes, look);
    geometry.boundingSphere = ballOf(points, 0, count - 1);
    this.mesh = new THREE.Mesh(geometry, this.material);
    this.mesh.renderOrder = 2;
    this.group.add(this.mesh);
  }

  set(name, value) {
    this.material.uniforms[name].value = value;
  }

  clear() {
    this.empty();
  }

  empty() {
    this.mesh?.geometry.dispose();
    this.mesh?.removeFromParent();
    this.mesh = null;
  }

  dispose() {
    this.empty();
    this.group.removeFromParent();
    this.material.dispose();
  }
}

/** The direction of the tool at the end of a piece, into `into`. Tools of a lathe that do not turn
 *  have none: zero. */
export function axisAt(program, piece, into) {
  const row = rowAt(program.axesFrom, piece);
  if (row >= 0) return into.fromArray(program.axes, 3 * row);
  return into.set(0, 0, program.lathe ? 0 : 1);
}
