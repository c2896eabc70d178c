// The rotary axes of a machine: a table turns the part, and the tool that is on it.
import * as THREE from "three";
import { rotaryAt } from "./pick.js";

export class Machine {
  constructor() {
    this.isOn = false;
    this.axes = [];
    this.rotary = [0, 0];
    this.turned = new THREE.Matrix4();
    this.step = new THREE.Matrix4();
    this.shift = new THREE.Matrix4();
  }

  /** Takes the tables of a program, primary first. */
  take(program) {
    this.axes = (program.chain?.axes ?? []).map((axis) => axis && {
      ...axis, direction: new THREE.Vector3().fromArray(axis.direction), center: new THREE.Vector3().fromArray(axis.center),
    });
  }

  /** Turns the part as the tables stand after a share of a piece. */
  turn(program, piece, share, part) {
    part.matrix.identity();
    rotaryAt(program, piece, share, this.rotary);
    if (this.isOn && program.rotaryFrom.length) {
      this.turned.identity();
      // From the machine to the part: the secondary table first; the part goes the other way.
      for (let index = 1; index >= 0; index--) {
        const axis = this.axes[index];
        if (axis?.carries !== "table") continue;
        const { x, y, z } = axis.center;
        this.step.makeTranslation(x, y, z);
        this.step.multiply(this.shift.makeRotationAxis(axis.direction, this.rotary[index] * Math.PI / 180));
        this.step.multiply(this.shift.makeTranslation(-x, -y, -z));
        this.turned.premultiply(this.step);
      }
      part.matrix.copy(this.turned).invert();
    }
    part.matrixWorldNeedsUpdate = true;
    part.updateMatrixWorld(true);
  }

  /** The box of the part where it is now, into `into`. */
  boxOf(box, part, into) {
    into.copy(box);
    if (!box.isEmpty()) into.applyMatrix4(part.matrix);
    return into;
  }
}
