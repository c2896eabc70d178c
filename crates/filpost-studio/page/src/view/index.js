// The view of a program in three dimensions: the path on the part, the tool where it is, playback.
import * as THREE from "three";
import { Camera } from "./camera.js";
import { addHands } from "./hands.js";
import { Machine } from "./machine.js";
import { Measure } from "./measure.js";
import { makePanel } from "./panel.js";
import { ALL, BY, Mark, Path, TOOLS, axisAt } from "./path.js";
import { Picker, cutBox, piecesOf, pointOn } from "./pick.js";
import { duration, pieceAt } from "./read.js";
import { themeOf } from "./theme.js";
import { Tool } from "./tool.js";
import { toolNumber, unitOf } from "./words.js";

export { bytesOf, readProgram } from "./read.js";

/** Pixels around the pointer, and least time of a picture that is shown while a program is played. */
const REACH = 9;
/** Pixels of the axes at the zero of the part. */
const ORIGIN = 34;
const STROKES = ["rapid", "feed", "arc", "thread"];

// Colours are those of the page; nothing is converted.
THREE.ColorManagement.enabled = false;

/** A view in an element. `onPick` gets the line of a motion that is clicked, and "program" or
 *  "second"; `textOf` gives the block of a line; `tools` are further elements of the bar. */
export function createView(element, { onPick = () => {}, textOf = () => "", tools = [] } = {}) {
  return new View(element, onPick, textOf, tools);
}

class View {
  constructor(element, onPick, textOf, tools) {
    Object.assign(this, { onPick, textOf });
    this.panel = makePanel(element, this, tools);
    this.canvas = this.panel.canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: false });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.scene = new THREE.Scene();
    this.camera = new Camera();
    /** What turns with the part: the paths, the marks, the tool. */
    this.part = new THREE.Group();
    this.part.matrixAutoUpdate = false;
    this.scene.add(this.part);
    this.addLights();
    this.origin = this.makeOrigin();
    this.spindle = this.makeSpindle();
    this.tool = new Tool();
    this.mark = new Mark();
    this.measure = new Measure(this.panel, unitOf({}));
    this.machine = new Machine();
    this.part.add(this.tool.group, this.mark.group, this.measure.group, this.origin, this.spindle);
    Object.assign(this, { program: null, second: null, first: null, other: null, picker: null, otherPicker: null });
    Object.assign(this, { time: 0, piece: 0, share: 0, playing: false, factor: 60, by: BY.motion, last: 0, line: 0 });
    this.shown = [true, true, true, true];
    this.isSecondShown = true;
    this.section = { axis: -1, at: 1 };
    this.point = new THREE.Vector3();
    this.axis = new THREE.Vector3();
    this.axisBefore = new THREE.Vector3();
    this.box = new THREE.Box3();
    this.cut = new THREE.Box3();
    this.spot = new THREE.Vector3();
    this.asked = 0;
    /** How the last picture was made: draw calls, and milliseconds of script. */
    this.stats = { calls: 0, milliseconds: 0 };
    this.frame = (now) => this.draw(now);
    this.stopHands = addHands(this.canvas, this.camera, {
      pivot: (x, y, into) => this.pivot(x, y, into), middle: () => this.middle(),
      hover: () => {}, click: (x, y) => this.click(x, y), key: (key) => this.key(key), changed: () => this.ask(),
    });
    this.watch = new ResizeObserver(() => this.resize());
    this.watch.observe(this.panel.stage);
    this.recolour = () => this.colour();
    this.dark = matchMedia("(prefers-color-scheme: dark)");
    this.dark.addEventListener("change", this.recolour);
    this.themes = new MutationObserver(this.recolour);
    this.themes.observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme", "class"] });
    this.colour();
    this.resize();
  }

  addLights() {
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x9aa0a8, 1.9));
    const lamp = new THREE.DirectionalLight(0xffffff, 1.3);
    lamp.position.set(-0.4, 0.7, 1);
    this.camera.eye.add(lamp, lamp.target);
    this.scene.add(this.camera.eye);
  }

  makeOrigin() {
    const ends = new Float32Array(18), geometry = new THREE.BufferGeometry();
    for (let axis = 0; axis < 3; axis++) ends[6 * axis + 3 + axis] = 1;
    geometry.setAttribute("position", new THREE.BufferAttribute(ends, 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(18), 3));
    const lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ vertexColors: true, depthTest: false }));
    lines.renderOrder = 1;
    lines.frustumCulled = false;
    return lines;
  }

  /** The axis of the spindle of a lathe. */
  makeSpindle() {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(6), 3));
    const line = new THREE.LineSegments(geometry, new THREE.LineDashedMaterial());
    line.frustumCulled = false;
    line.visible = false;
    return line;
  }

  // --- what is shown ------------------------------------------------------------

  /** Shows a program, or nothing. */
  setProgram(program) {
    this.pause();
    this.first?.dispose();
    const isNew = !this.program || !program || program.lathe !== this.program.lathe || program.title !== this.program.title;
    this.program = program;
    this.first = program && new Path(program);
    this.picker = program && new Picker(program);
    this.mark.clear();
    this.measure.clear();
    if (program) {
      this.part.add(this.first.group);
      this.first.group.position.fromArray(program.base);
      this.mark.group.position.fromArray(program.base);
      this.camera.isLathe = program.lathe;
      this.measure.unit = unitOf(program);
      this.machine.take(program);
    }
    this.surround();
    this.colour();
    this.applySection();
    this.panel.showProgram(program, this.second);
    if (isNew) this.look("iso");
    this.setTime(program ? duration(program) : 0);
  }

  /** Lays a second program under the first, or takes it away. */
  setSecond(program) {
    this.other?.dispose();
    this.second = program;
    this.other = program && new Path(program);
    this.otherPicker = program && new Picker(program);
    if (program) {
      this.part.add(this.other.group);
      this.other.group.position.fromArray(program.base);
      this.other.set("by", BY.one);
      this.other.set("back", 4);
      this.other.set("width", 3.6);
    }
    this.surround();
    this.colour();
    this.applySection();
    this.panel.showProgram(this.program, program);
    this.ask();
  }

  /** Shapes of tools beside those of the program: a list of number, diameter, corner, bottom
   *  (degrees), length and holder (diameter and length of each step from below), mm. */
  setTools(tools) {
    if (!this.program) return;
    const given = new Set(tools.map(({ number }) => number));
    this.program.tools = [...this.program.tools.filter(({ number }) => !given.has(number)), ...tools];
    this.panel.forgetPlace();
    this.setTime(this.time);
  }

  /** Shows a body, such as what is left of the stock: `positions` and `normals`, three numbers a
   *  corner (mm, frame of the part), and the corners of its triangles; null takes it away. */
  setStock(body) {
    const isNew = Boolean(body) && !this.stock;
    this.stock?.geometry.dispose();
    this.stock?.material.dispose();
    this.stock?.removeFromParent();
    this.stock = null;
    if (body) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(body.positions, 3));
      if (body.indices) geometry.setIndex(new THREE.BufferAttribute(body.indices, 1));
      if (body.normals) geometry.setAttribute("normal", new THREE.BufferAttribute(body.normals, 3));
      else geometry.computeVertexNormals();
      // The path lies over the surface that it cuts.
      const look = { color: this.theme.stock, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 };
      this.stock = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial(look));
      this.part.add(this.stock);
      geometry.computeBoundingBox();
    }
    this.surround();
    if (isNew) this.fit();
    this.ask();
  }

  /** The box around both paths, and the one around what they cut; those of a lathe have the axis of
   *  the spindle in them. */
  surround() {
    this.box.makeEmpty();
    this.cut.makeEmpty();
    for (const program of [this.program, this.second]) {
      if (!program?.total) continue;
      cutBox(program, this.cut, this.spot);
      if (program.lathe && !this.cut.isEmpty()) this.cut.expandByPoint(this.spot.set(0, 0, this.cut.min.z));
      this.box.expandByPoint(this.spot.fromArray(program.min));
      this.box.expandByPoint(this.spot.fromArray(program.max));
      if (program.lathe) this.box.expandByPoint(this.spot.set(0, 0, program.min[2]));
    }
    if (this.stock) for (const box of [this.box, this.cut]) box.union(this.stock.geometry.boundingBox);
    const size = this.box.isEmpty() ? 100 : this.box.getSize(this.spot).length();
    this.size = Math.max(size, 1e-3);
    const center = this.box.isEmpty() ? 0 : this.box.getCenter(this.spot).length();
    this.spindle.visible = Boolean(this.program?.lathe) && !this.box.isEmpty();
    if (this.spindle.visible) {
      const { position } = this.spindle.geometry.attributes, more = 0.05 * this.size;
      position.setXYZ(0, 0, 0, this.box.min.z - more);
      position.setXYZ(1, 0, 0, this.box.max.z + more);
      position.needsUpdate = true;
      this.spindle.computeLineDistances();
      this.spindle.material.dashSize = this.size / 40;
      this.spindle.material.gapSize = this.size / 100;
    }
    this.camera.reach = 20 * this.size + 4 * center;
  }

  /** Marks what a line makes, and moves it into the middle. Says whether it makes anything. */
  select(line) {
    this.line = line;
    this.mark.clear();
    if (!this.program || !line) return this.ask(false);
    const { points, breaks, first, last, box } = piecesOf(this.program, line);
    if (first < 0) return this.ask(false);
    this.mark.show(points, breaks);
    this.pause();
    this.stand(last, 1);
    this.toMiddle(box);
    return this.ask(true);
  }

  /** Moves the picture where a box lies beside it; makes it smaller where it is larger. */
  toMiddle(box) {
    const { camera, part } = this, base = this.spot.fromArray(this.program.base);
    box.translate(base).applyMatrix4(part.matrixWorld);
    const { width, height } = camera.size;
    box.getCenter(camera.center);
    const size = box.getSize(this.spot).length() * camera.scale, room = 0.8 * Math.min(width, height);
    if (size > room) camera.scale *= room / size;
  }

  // --- time -----------------------------------------------------------------------

  /** Shows the program at a time, seconds from its start. */
  setTime(time) {
    if (!this.program?.total) return this.ask();
    const whole = duration(this.program);
    this.time = Math.min(Math.max(time, 0), whole);
    const piece = pieceAt(this.program, this.time);
    if (piece >= this.program.total) return this.stand(this.program.total - 1, 1);
    const before = piece ? this.program.seconds[piece - 1] : 0, after = this.program.seconds[piece];
    this.stand(piece, after > before ? (this.time - before) / (after - before) : 1, this.time);
  }

  /** Puts the tool on a piece, after a share of it. */
  stand(piece, share, time) {
    const { program } = this;
    if (!program?.total) return;
    const before = piece ? program.seconds[piece - 1] : 0;
    this.time = time ?? before + (program.seconds[piece] - before) * share;
    Object.assign(this, { piece, share });
    pointOn(program, piece, share, this.point);
    this.point.x += program.base[0];
    this.point.y += program.base[1];
    this.point.z += program.base[2];
    axisAt(program, piece, this.axis);
    if (piece > 0 && program.axesFrom.length && this.axis.lengthSq() > 0) {
      axisAt(program, piece - 1, this.axisBefore);
      if (this.axisBefore.lengthSq() > 0) this.axis.multiplyScalar(share).addScaledVector(this.axisBefore, 1 - share).normalize();
    }
    const number = toolNumber(program, piece), shape = this.shapeOf(number);
    this.tool.take(number, shape, this.size, program.lathe && this.axis.lengthSq() === 0);
    this.tool.put(this.point, this.axis);
    this.first.set("upto", piece + 1 === program.total && share >= 1 ? ALL : piece + share);
    this.machine.turn(program, piece, share, this.part);
    this.panel.showPlace(program, piece, this.time, this.point);
    this.ask();
  }

  shapeOf(number) {
    const { tools } = this.program;
    for (let at = 0; at < tools.length; at++) if (tools[at].number === number) return tools[at];
    return null;
  }

  /** One motion on or back. */
  step(count) {
    if (!this.program?.total) return;
    this.pause();
    this.stand(Math.min(Math.max(this.piece + count, 0), this.program.total - 1), 1);
  }

  play() {
    if (!this.program?.total || this.playing) return;
    if (this.time >= duration(this.program)) this.setTime(0);
    this.playing = true;
    this.last = 0;
    this.mark.clear();
    this.panel.showPlaying(true);
    this.ask();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.panel.showPlaying(false);
    this.ask();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  advance(now) {
    const seconds = this.last ? (now - this.last) / 1000 : 0;
    this.last = now;
    this.setTime(this.time + seconds * this.factor);
    if (this.time >= duration(this.program)) this.pause();
  }

  // --- hand -----------------------------------------------------------------------

  look(name) {
    this.camera.look(name);
    this.fit();
    this.panel.showLook(name);
  }

  /** Fits what is cut; all of it where nothing is. */
  fit() {
    this.machine.boxOf(this.cut.isEmpty() ? this.box : this.cut, this.part, this.spotBox ??= new THREE.Box3());
    this.camera.fit(this.spotBox, this.panel.covered());
    this.ask();
  }

  middle() {
    return this.camera.center;
  }

  isSeen(program, shown) {
    return (piece) => shown[program.strokes[piece]];
  }

  /** What lies under a place of the picture: a piece of the first program, or else of the second. */
  find(x, y, snaps = false) {
    const hit = this.picker?.at(x, y, REACH, this.camera, this.first.group, this.isSeen(this.program, this.shown), snaps);
    if (hit) return { ...hit, program: this.program };
    if (!this.second || !this.isSecondShown) return null;
    const other = this.otherPicker.at(x, y, REACH, this.camera, this.other.group, () => true, snaps);
    return other && { ...other, program: this.second };
  }

  /** The point about which a drag turns the part: that under the hand, or else the middle of the
   *  part as deep as it is. */
  pivot(x, y, into) {
    const hit = this.find(x, y);
    if (hit) {
      const group = hit.program === this.program ? this.first.group : this.other.group;
      return into.copy(hit.point).applyMatrix4(group.matrixWorld);
    }
    if (this.box.isEmpty()) return into.copy(this.camera.center);
    return this.box.getCenter(into).applyMatrix4(this.part.matrixWorld);
  }

  click(x, y) {
    const hit = this.find(x, y, this.measure.isOn);
    if (this.measure.isOn) {
      if (hit) this.measure.add(hit.point.clone().add(this.spot.fromArray(hit.program.base)));
      return this.ask();
    }
    if (!hit) return;
    const line = hit.program.lines[hit.piece], isFirst = hit.program === this.program;
    if (isFirst) {
      this.pause();
      this.line = line;
      const { points, breaks } = piecesOf(this.program, line);
      this.mark.show(points, breaks);
      this.stand(hit.piece, 1);
    }
    this.onPick(line, isFirst ? "program" : "second");
    this.ask();
  }

  key(key) {
    const keys = {
      " ": () => this.toggle(), f: () => this.fit(), m: () => this.setMeasure(!this.measure.isOn),
      Escape: () => this.setMeasure(false), ",": () => this.step(-1), ".": () => this.step(1),
      PageUp: () => this.step(-100), PageDown: () => this.step(100),
      Home: () => this.setTime(0), End: () => this.setTime(Infinity),
      1: () => this.look("top"), 2: () => this.look("front"), 3: () => this.look("side"), 4: () => this.look("iso"),
    };
    if (!keys[key]) return false;
    keys[key]();
    return true;
  }

  setMeasure(isOn) {
    this.measure.isOn = isOn;
    if (!isOn) this.measure.clear();
    this.panel.showMeasure(isOn);
    this.ask();
  }

  /** Hides what lies beyond a share (0 to 1) of the part along an axis (0 to 2); -1 for none. */
  setSection(axis, at) {
    this.section = { axis, at };
    this.applySection();
    this.ask();
  }

  applySection() {
    const { axis, at } = this.section;
    const level = axis < 0 || this.box.isEmpty() ? 0 : this.box.min.getComponent(axis) + at * (this.box.max.getComponent(axis) - this.box.min.getComponent(axis));
    for (const path of [this.first, this.other]) {
      if (!path) continue;
      const { value } = path.material.uniforms.section;
      value.set(axis === 0 ? 1 : 0, axis === 1 ? 1 : 0, axis === 2 ? 1 : 0, axis < 0 ? 1 : level - path.program.base[axis] + 1e-5 * this.size);
    }
    this.panel.showSection(axis, level, unitOf(this.program || {}));
  }

  /** The tables turn with the part, or the part stays where it is. */
  setMachine(isOn) {
    this.machine.isOn = isOn;
    this.panel.showMachine(isOn);
    if (this.program?.total) this.machine.turn(this.program, this.piece, this.share, this.part);
    this.ask();
  }

  setBy(by) {
    this.by = by;
    this.first?.set("by", by);
    this.panel.by.value = String(by);
    this.panel.showLegend(this.program, this.second, by);
    this.ask();
  }

  setShown(stroke, isShown) {
    this.shown[stroke] = isShown;
    this.first?.material.uniforms.shown.value.fromArray(this.shown.map(Number));
    this.ask();
  }

  setSecondShown(isShown) {
    this.isSecondShown = isShown;
    if (this.other) this.other.group.visible = isShown;
    this.ask();
  }

  // --- picture ----------------------------------------------------------------------

  colour() {
    const theme = this.theme = themeOf(this.panel.root);
    this.renderer.setClearColor(theme.paper, 1);
    for (const path of [this.first, this.other]) {
      if (!path) continue;
      const { strokes, tools, feeds, ghost } = path.material.uniforms;
      STROKES.forEach((name, at) => strokes.value[at].set(theme[name]));
      for (let at = 0; at < TOOLS; at++) tools.value[at].set(theme.tools[at]);
      theme.feeds.forEach((colour, at) => feeds.value[at].set(colour));
      ghost.value.set(theme.ghost);
      path.material.uniforms.one.value.set(theme.second);
    }
    this.first?.set("by", this.by);
    this.first?.material.uniforms.shown.value.fromArray(this.shown.map(Number));
    this.mark.material.uniforms.one.value.set(theme.mark);
    this.tool.colour(theme.cutter, theme.holder);
    this.measure.colour(theme.mark);
    this.stock?.material.color.set(theme.stock);
    this.spindle.material.color.set(theme.holder);
    const { color } = this.origin.geometry.attributes, axis = new THREE.Color();
    ["x", "y", "z"].forEach((name, at) => {
      axis.set(theme[name]);
      for (const end of [0, 1]) color.setXYZ(2 * at + end, axis.r, axis.g, axis.b);
    });
    color.needsUpdate = true;
    this.panel.showLegend(this.program, this.second, this.by);
    this.ask();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.panel.stage;
    if (!width || !height) return;
    const isFirst = this.camera.size.width === 1, ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.camera.size = { width, height };
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    if (isFirst && this.program) this.look("iso");
    this.ask();
  }

  /** Asks for a picture, and hands a value on. */
  ask(value) {
    if (!this.asked && this.renderer) this.asked = requestAnimationFrame(this.frame);
    return value;
  }

  draw(now) {
    const start = performance.now();
    this.asked = 0;
    if (this.playing) this.advance(now);
    const { camera } = this, { width, height } = camera.size;
    camera.place();
    for (const path of [this.first, this.other, this.mark]) path?.material.uniforms.room.value.set(width, height);
    this.measure.material.uniforms.room.value.set(width, height);
    this.tool.group.visible = Boolean(this.program?.total);
    this.origin.scale.setScalar(ORIGIN / camera.scale);
    this.renderer.render(this.scene, camera.eye);
    this.panel.showAxes(camera, this.part);
    this.stats.calls = this.renderer.info.render.calls;
    this.stats.milliseconds = performance.now() - start;
    if (this.playing) this.ask();
  }

  /** Draws at once; for measurements and pictures. */
  drawNow() {
    cancelAnimationFrame(this.asked);
    this.draw(performance.now());
    return this.stats;
  }

  dispose() {
    this.playing = false;
    this.setStock(null);
    cancelAnimationFrame(this.asked);
    this.stopHands();
    this.watch.disconnect();
    this.themes.disconnect();
    this.dark.removeEventListener("change", this.recolour);
    for (const one of [this.first, this.other, this.mark, this.measure, this.tool]) one?.dispose();
    for (const one of [this.origin, this.spindle]) {
      one.geometry.dispose();
      one.material.dispose();
    }
    this.renderer.dispose();
    this.renderer = null;
    this.panel.root.remove();
  }
}
