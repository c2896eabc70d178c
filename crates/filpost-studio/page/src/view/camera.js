// From where the part is seen: a parallel projection that turns about the point under the hand and
// zooms to the pointer.
import * as THREE from "three";

const NAMED = {
  top: [[1, 0, 0], [0, 1, 0]],
  front: [[1, 0, 0], [0, 0, 1]],
  side: [[0, 1, 0], [0, 0, 1]],
  iso: [[1, 1, 0], [-1, 1, 2]],
};
/** Those of a lathe: Z to the right, and X up. */
const TURNED = {
  top: [[0, 0, 1], [0, -1, 0]],
  front: [[0, 0, 1], [1, 0, 0]],
  side: [[0, -1, 0], [1, 0, 0]],
  iso: [[0, 1, 2], [5, 2, -1]],
};

/** Radians of a pixel of a drag, and of a press of an arrow key. */
const TURN = 0.008;
export const STEP = Math.PI / 24;
/** Pixels around the path that stay free when it is fitted. */
const MARGIN = 48;

export class Camera {
  constructor() {
    this.eye = new THREE.OrthographicCamera();
    /** The point of the part in the middle of the picture, and pixels of a mm. */
    this.center = new THREE.Vector3();
    this.scale = 1;
    this.size = { width: 1, height: 1 };
    this.reach = 1000;
    this.isLathe = false;
    this.right = new THREE.Vector3(1, 0, 0);
    this.up = new THREE.Vector3(0, 1, 0);
    this.toward = new THREE.Vector3(0, 0, 1);
    this.basis = new THREE.Matrix4();
    this.turned = new THREE.Quaternion();
    this.step = new THREE.Quaternion();
    this.way = new THREE.Vector3();
  }

  /** The direction that stays upright while the part is turned. */
  get upright() {
    return this.way.set(this.isLathe ? 1 : 0, 0, this.isLathe ? 0 : 1);
  }

  look(name) {
    const [right, up] = (this.isLathe ? TURNED : NAMED)[name];
    this.right.fromArray(right).normalize();
    this.up.fromArray(up);
    this.toward.crossVectors(this.right, this.up).normalize();
    this.up.crossVectors(this.toward, this.right);
    this.basis.makeBasis(this.right, this.up, this.toward);
    this.eye.quaternion.setFromRotationMatrix(this.basis);
  }

  /** Takes right, up and toward from where the eye looks. */
  follow() {
    this.basis.makeRotationFromQuaternion(this.eye.quaternion);
    this.basis.extractBasis(this.right, this.up, this.toward);
  }

  /** Turns about a point of the part by pixels of a drag. */
  turn(aside, down, about) {
    this.turned.setFromAxisAngle(this.upright, -aside * TURN);
    this.turned.multiply(this.step.setFromAxisAngle(this.right, -down * TURN));
    this.center.sub(about).applyQuaternion(this.turned).add(about);
    this.eye.quaternion.premultiply(this.turned);
    this.follow();
  }

  /** Moves the picture by pixels. */
  move(aside, down) {
    this.center.addScaledVector(this.right, -aside / this.scale);
    this.center.addScaledVector(this.up, down / this.scale);
  }

  /** Makes the picture larger about a place of it, pixels from its upper left corner. */
  zoom(factor, x, y) {
    const scale = Math.min(Math.max(this.scale * factor, 1e-6), 1e7), share = 1 / this.scale - 1 / scale;
    this.center.addScaledVector(this.right, (x - this.size.width / 2) * share);
    this.center.addScaledVector(this.up, (this.size.height / 2 - y) * share);
    this.scale = scale;
  }

  /** Fits a box, with room for what lies over the picture above and below it. */
  fit(box, { above = 0, below = 0 } = {}) {
    if (box.isEmpty()) return;
    box.getCenter(this.center);
    let wide = 0, high = 0;
    for (let corner = 0; corner < 8; corner++) {
      const side = (bit, axis) => (corner >> bit & 1 ? box.max : box.min)[axis];
      this.way.set(side(0, "x"), side(1, "y"), side(2, "z")).sub(this.center);
      wide = Math.max(wide, Math.abs(this.way.dot(this.right)));
      high = Math.max(high, Math.abs(this.way.dot(this.up)));
    }
    const { width, height } = this.size;
    const room = [Math.max(width - 2 * MARGIN, 40), Math.max(height - above - below - MARGIN, 40)];
    this.scale = Math.min(room[0] / Math.max(2 * wide, 1e-3), room[1] / Math.max(2 * high, 1e-3));
    this.move(0, (above - below) / 2);
  }

  /** Puts the eye where it sees all of that. */
  place() {
    const { width, height } = this.size, { eye } = this;
    eye.left = -width / 2 / this.scale;
    eye.right = -eye.left;
    eye.top = height / 2 / this.scale;
    eye.bottom = -eye.top;
    eye.near = -this.reach;
    eye.far = this.reach;
    eye.position.copy(this.center);
    eye.updateProjectionMatrix();
    eye.updateMatrixWorld();
  }

  /** Where a point lies on the picture, pixels; z grows toward the eye. */
  project(point, into) {
    into.copy(point).sub(this.center);
    const x = into.dot(this.right), y = into.dot(this.up), z = into.dot(this.toward);
    return into.set(this.size.width / 2 + x * this.scale, this.size.height / 2 - y * this.scale, z);
  }

  /** The point at a place of the picture, as deep as the middle of the part. */
  unproject(x, y, into) {
    into.copy(this.center);
    into.addScaledVector(this.right, (x - this.size.width / 2) / this.scale);
    return into.addScaledVector(this.up, (this.size.height / 2 - y) / this.scale);
  }
}
