// The tool and its holder.
import * as THREE from "three";

/** Of a tool without a known length: times its diameter. */
const LONG = 4;
const ROUND = 40;

/** Half of the outline of a mill or drill, from the middle of its tip up: radius and height. */
function outline({ diameter, corner, bottom }, length) {
  const radius = diameter / 2, points = [new THREE.Vector2(0, 0)];
  if (bottom > 0) {
    const rise = radius * Math.tan(bottom * Math.PI / 180);
    points.push(new THREE.Vector2(radius, rise));
  } else {
    const round = Math.min(corner, radius), steps = round > 0 ? 12 : 0;
    points.push(new THREE.Vector2(radius - round, 0));
    for (let step = 1; step <= steps; step++) {
      const angle = step / steps * Math.PI / 2;
      points.push(new THREE.Vector2(radius - round + round * Math.sin(angle), round - round * Math.cos(angle)));
    }
  }
  points.push(new THREE.Vector2(radius, length), new THREE.Vector2(0, length));
  return points;
}

/** Half of the outline of a holder, diameters and lengths from below, that begins at a height. */
function steps(holder, height) {
  const points = [[0, height]];
  for (const [wide, long] of holder) {
    points.push([wide / 2, height], [wide / 2, height + long]);
    height += long;
  }
  return [...points, [0, height]];
}

/** Its outline turned about Z. */
function turned(points) {
  return new THREE.LatheGeometry(points, ROUND).rotateX(Math.PI / 2);
}

/** The insert of a turning tool: a plate in the plane of Z and X whose corner is the tip. */
function insert(size) {
  const shape = new THREE.Shape([[0, 0], [0.35, 1], [1, 1.2], [0.8, 0.25]].map(([z, x]) => new THREE.Vector2(z * size, x * size)));
  const plate = new THREE.ExtrudeGeometry(shape, { depth: size * 0.25, bevelEnabled: false });
  // The first of the shape is Z, the second X; the plate lies below Y 0, its rake face up.
  return plate.applyMatrix4(new THREE.Matrix4().set(0, 1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0, 0, 0, 0, 1));
}

/** The tool of a program that stands somewhere. */
export class Tool {
  constructor() {
    this.group = new THREE.Group();
    this.cutter = new THREE.Mesh(undefined, new THREE.MeshLambertMaterial({ transparent: true, opacity: 0.82, side: THREE.DoubleSide }));
    this.holder = new THREE.Mesh(undefined, new THREE.MeshLambertMaterial({ transparent: true, opacity: 0.45, side: THREE.DoubleSide }));
    this.cutter.renderOrder = 3;
    this.holder.renderOrder = 4;
    this.group.add(this.cutter, this.holder);
    this.upright = new THREE.Vector3(0, 0, 1);
    this.number = null;
  }

  /** Takes the shape of a tool; `size` is that of the part, for a tool of which nothing is known. */
  take(number, shape, size, isInsert) {
    if (this.number === number && this.shape === shape && this.isInsert === isInsert) return;
    Object.assign(this, { number, shape, isInsert });
    this.cutter.geometry.dispose();
    this.holder.geometry.dispose();
    this.holder.visible = !isInsert;
    if (isInsert) {
      this.cutter.geometry = insert(size / 14);
      return;
    }
    const known = shape || { diameter: size / 40, corner: 0, bottom: 0, length: null };
    const long = known.length || Math.max(known.diameter * LONG, size / 20), wide = Math.max(known.diameter * 0.9, size / 30);
    this.cutter.geometry = turned(outline(known, long));
    const arm = known.holder?.length ? steps(known.holder, long)
      : [[0, long], [wide, long], [wide, long + wide * 2], [wide * 1.3, long + wide * 2.4], [wide * 1.3, long + wide * 3], [0, long + wide * 3]];
    this.holder.geometry = turned(arm.map(([r, z]) => new THREE.Vector2(r, z)));
  }

  /** Puts its tip at a point, along a direction. */
  put(point, axis) {
    this.group.position.copy(point);
    this.group.quaternion.identity();
    if (!this.isInsert && axis.lengthSq() > 0) this.group.quaternion.setFromUnitVectors(this.upright, axis);
  }

  colour(cutter, holder) {
    this.cutter.material.color.set(cutter);
    this.holder.material.color.set(holder);
  }

  dispose() {
    for (const mesh of [this.cutter, this.holder]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.group.removeFromParent();
  }
}
