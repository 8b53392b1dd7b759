// SPDX-License-Identifier: Apache-2.0
// @ts-check
// One WebGL context draws all cards: a page may hold hundreds, and browsers allow some sixteen contexts.
//
// Each picture is drawn into the context's own canvas, off the page, and copied into the card's 2D canvas. A canvas that
// covers the page and is scissored to the cards would spare the copy, but trails behind when the page scrolls, lies above or
// below everything else, and cannot live in somebody else's layout. Cards are drawn when something about them changes, never else.
import { AmbientLight, DirectionalLight, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from 'three';

const FIELD_OF_VIEW = 30;
// The measure's light; three divides by pi what a diffuse surface sends back.
const AMBIENT = 0.25 * Math.PI;
const DIRECTIONAL = 0.7 * Math.PI;
const LARGEST = 2048; // pixels of the context's canvas
const FRAME = 10; // milliseconds of drawing in a frame, after which the others wait for the next
const STILL = 4, MOVING = 2; // pictures are drawn so many times larger, as the measure does, then reduced

/**
 * What the stage draws, and where to.
 * @typedef {object} View
 * @property {HTMLCanvasElement} canvas
 * @property {import('./model.js').Model | null} model
 * @property {import('./model.js').Mode} mode
 * @property {import('./orbit.js').Orbit} orbit
 * @property {[number, number]} light  where the light stands, in the picture from -1 to 1, right and up; 0, 0: at the camera
 * @property {boolean} moving
 * @property {() => void} drawn  called after each picture
 */

/** The camera where the sphere just fits. @param {import('three').Sphere} sphere @param {import('./orbit.js').Orbit} orbit */
export function lookAt(sphere, orbit) {
  const distance = sphere.radius / Math.sin((FIELD_OF_VIEW / 2) * (Math.PI / 180));
  const rotation = orbit.rotation;
  const eye = new Vector3(0, 0, distance).applyQuaternion(rotation).add(sphere.center);
  return { distance, rotation, eye, up: new Vector3(0, 1, 0).applyQuaternion(rotation) };
}

export class Stage {
  #renderer = new WebGLRenderer({ antialias: false, alpha: true, powerPreference: 'low-power' });
  #scene = new Scene();
  #camera = new PerspectiveCamera(FIELD_OF_VIEW);
  #light = new DirectionalLight(0xffffff, DIRECTIONAL);
  #half = document.createElement('canvas');
  /** @type {Set<View>} */
  #waiting = new Set();
  #lost = false;
  #side = 0;

  /** @param {() => void} restored  called when everything must be drawn again */
  constructor(restored) {
    this.#camera.add(this.#light, this.#light.target);
    this.#scene.add(this.#camera, new AmbientLight(0xffffff, AMBIENT));
    this.#renderer.setScissorTest(true);
    const { domElement } = this.#renderer;
    domElement.addEventListener('webglcontextlost', () => { this.#lost = true; });
    domElement.addEventListener('webglcontextrestored', () => {
      this.#lost = false;
      restored();
    });
  }

  /** What the context holds: numbers of geometries and textures. */
  get memory() {
    return this.#renderer.info.memory;
  }

  /** Draws before the next frame is shown, or as soon as there is time. @param {View} view */
  draw(view) {
    if (this.#waiting.size === 0) requestAnimationFrame(() => this.#drawSome());
    this.#waiting.add(view);
  }

  /** What is being turned first, then what fits into the frame. */
  #drawSome() {
    const start = performance.now();
    for (const view of [...this.#waiting].sort((a, b) => Number(b.moving) - Number(a.moving))) {
      if (performance.now() - start > FRAME) break;
      this.#waiting.delete(view);
      if (!this.#lost) this.#drawNow(view);
    }
    if (this.#waiting.size > 0) requestAnimationFrame(() => this.#drawSome());
  }

  /** @param {View} view */
  #drawNow(view) {
    const { canvas, model } = view;
    const side = Math.round(canvas.clientWidth * Math.min(window.devicePixelRatio, 2));
    if (!model || side === 0) return;
    let times = view.moving ? MOVING : STILL;
    while (times > 1 && times * side > LARGEST) times /= 2;
    this.#render(model, view, times * side);
    this.#reduce(canvas, side, times);
    view.drawn();
  }

  /** @param {import('./model.js').Model} model @param {View} view @param {number} side */
  #render(model, { mode, orbit, light }, side) {
    if (side > this.#side) {
      this.#side = side;
      this.#renderer.setSize(side, side, false);
    }
    this.#renderer.setViewport(0, this.#side - side, side, side);
    this.#renderer.setScissor(0, this.#side - side, side, side);
    const { distance, rotation, eye } = lookAt(model.sphere, orbit);
    this.#camera.position.copy(eye);
    this.#camera.quaternion.copy(rotation);
    this.#camera.near = distance - 1.5 * model.sphere.radius;
    this.#camera.far = distance + 1.5 * model.sphere.radius;
    this.#camera.zoom = orbit.zoom;
    this.#camera.updateProjectionMatrix();
    this.#light.position.set(light[0], light[1], Math.sqrt(Math.max(0, 1 - light[0] ** 2 - light[1] ** 2)));
    model.dress(mode);
    this.#scene.add(model.root);
    this.#renderer.render(this.#scene, this.#camera);
    this.#scene.remove(model.root);
  }

  /**
   * Halves the picture until it fits: exactly the mean of each block of pixels, as the measure takes it.
   * @param {HTMLCanvasElement} canvas @param {number} side @param {number} times
   */
  #reduce(canvas, side, times) {
    let source = this.#renderer.domElement;
    if (times === 4) {
      this.#half.width = this.#half.height = 2 * side;
      this.#half.getContext('2d')?.drawImage(source, 0, 0, 4 * side, 4 * side, 0, 0, 2 * side, 2 * side);
      source = this.#half;
      times = 2;
    }
    canvas.width = canvas.height = side; // also clears it
    canvas.getContext('2d')?.drawImage(source, 0, 0, times * side, times * side, 0, 0, side, side);
  }
}
