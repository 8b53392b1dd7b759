// SPDX-License-Identifier: Apache-2.0
// @ts-check
// From where an object is seen: on a turntable, where up stays up, or freely turned.
import { Quaternion, Vector3 } from 'three';

const FIRST_RISE = Math.PI / 18; // the measure's turntable: 10 degrees above the horizon
const STEEPEST = 1.5;
const MOST_ZOOM = 8;
const X = new Vector3(1, 0, 0), Y = new Vector3(0, 1, 0);

/** @param {number} value @param {number} low @param {number} high */
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

export class Orbit {
  /** Radians around the object, counterclockwise from its +Z side, and above the horizon. */
  turn = 0;
  rise = FIRST_RISE;
  zoom = 1;
  /** @type {Quaternion | null} where it was turned to freely */
  #freely = null;

  /** Whether up stays up. */
  get upright() {
    return this.#freely === null;
  }

  /** The camera's axes as a rotation. */
  get rotation() {
    return this.#freely ?? new Quaternion().setFromAxisAngle(Y, this.turn).multiply(new Quaternion().setFromAxisAngle(X, -this.rise));
  }

  /** Turns the object under the hand. @param {number} right radians @param {number} down radians */
  drag(right, down) {
    this.turn -= right;
    this.rise = clamp(this.rise + down, -STEEPEST, STEEPEST);
    this.#freely = null;
  }

  /** The same about the picture's own axes, over the top as well. @param {number} right @param {number} down */
  roll(right, down) {
    const by = new Quaternion().setFromAxisAngle(Y, -right).multiply(new Quaternion().setFromAxisAngle(X, -down));
    this.#freely = this.rotation.clone().multiply(by).normalize();
    const towards = new Vector3(0, 0, 1).applyQuaternion(this.#freely);
    this.turn = Math.atan2(towards.x, towards.z);
    this.rise = clamp(Math.asin(clamp(towards.y, -1, 1)), -STEEPEST, STEEPEST);
  }

  /** Puts up upwards again, as near as that is. */
  straighten() {
    this.#freely = null;
  }

  /** @param {number} factor */
  magnify(factor) {
    this.zoom = clamp(this.zoom * factor, 1, MOST_ZOOM);
  }

  reset() {
    this.turn = 0;
    this.rise = FIRST_RISE;
    this.zoom = 1;
    this.#freely = null;
  }

  /** Degrees around, 0 to 359, and above the horizon. */
  get degrees() {
    const around = Math.round((this.turn * 180) / Math.PI) % 360;
    return { around: (around + 360) % 360, above: Math.round((this.rise * 180) / Math.PI) };
  }
}
