// The distance of two points.
import { Mark } from "./path.js";
import { length } from "./words.js";

export class Measure extends Mark {
  constructor(panel, unit) {
    super();
    Object.assign(this, { panel, unit, isOn: false, ends: [] });
    this.material.uniforms.width.value = 2;
  }

  /** Takes a point, in the frame of the part; a third one begins anew. */
  add(point) {
    if (this.ends.length === 2) this.ends = [];
    this.ends.push(point);
    const [from, to] = this.ends;
    const last = to || from;
    this.show(new Float32Array([...from.toArray(), ...last.toArray()]), []);
    this.panel.showDistance(this.text());
  }

  text() {
    const [from, to] = this.ends, { unit } = this;
    if (!from) return "";
    const named = (point) => ["X", "Y", "Z"].map((name, axis) => `${name}${length(point.getComponent(axis), unit)}`).join(" ");
    if (!to) return `${named(from)} · click the second point`;
    const way = to.clone().sub(from);
    const parts = ["dx", "dy", "dz"].map((name, axis) => `${name} ${length(way.getComponent(axis), unit)}`);
    return `${length(way.length(), unit)} ${unit.name} · ${parts.join(" · ")}`;
  }

  clear() {
    this.empty();
    this.ends = [];
    this.panel.showDistance("");
  }

  colour(colour) {
    this.material.uniforms.one.value.set(colour);
  }
}
