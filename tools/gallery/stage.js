// SPDX-License-Identifier: Apache-2.0
// One WebGL context draws all cards: a page may hold hundreds, a browser allows some sixteen contexts.
import { AmbientLight, Box3, DirectionalLight, PerspectiveCamera, Scene, Sphere, WebGLRenderer } from 'three';
import { DRACOLoader } from 'three/addons/loaders/DRACOLoader.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

const FIELD_OF_VIEW = 30;
// three divides by pi what a diffuse surface sends back.
const AMBIENT = 0.25 * Math.PI;
const HEAD_LIGHT = 0.7 * Math.PI;

/**
 * @typedef {object} Model
 * @property {import('three').Object3D} root
 * @property {Sphere} sphere  about its vertices
 */

/** @typedef {import('./card.js').Card} Card */

/** @param {import('three').Object3D} root */
function boundingSphere(root) {
  root.updateMatrixWorld(true);
  const centre = new Box3().setFromObject(root, true).getCenter(new Sphere().center);
  const vertex = centre.clone();
  let radius = 0;
  root.traverse((node) => {
    const positions = /** @type {any} */ (node).geometry?.attributes.position;
    for (let i = 0; i < (positions?.count ?? 0); ++i) {
      vertex.fromBufferAttribute(positions, i).applyMatrix4(node.matrixWorld);
      radius = Math.max(radius, vertex.distanceTo(centre));
    }
  });
  return new Sphere(centre, radius || 1);
}

export class Stage {
  #renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: false });
  #scene = new Scene();
  #camera = new PerspectiveCamera(FIELD_OF_VIEW);
  #loader = new GLTFLoader();
  /** @type {Set<Card>} */
  #waiting = new Set();
  /** @type {Set<Card>} */
  #shown = new Set();

  constructor() {
    const light = new DirectionalLight(0xffffff, HEAD_LIGHT);
    light.position.set(0, 0, 1);
    light.target.position.set(0, 0, 0);
    this.#camera.add(light, light.target);
    this.#scene.add(this.#camera, new AmbientLight(0xffffff, AMBIENT));
    this.#loader.setDRACOLoader(new DRACOLoader().setDecoderPath(new URL('draco/', import.meta.url).href));
    this.#loader.setMeshoptDecoder(MeshoptDecoder);
    this.#renderer.domElement.addEventListener('webglcontextrestored', () => this.#shown.forEach((card) => this.draw(card)));
  }

  /**
   * @param {string} address
   * @returns {Promise<Model>}
   */
  async load(address) {
    const root = (await this.#loader.loadAsync(address)).scene;
    return { root, sphere: boundingSphere(root) };
  }

  /**
   * Draws the card before the next frame is shown.
   * @param {Card} card
   */
  draw(card) {
    if (this.#waiting.size === 0) requestAnimationFrame(() => this.#drawAll());
    this.#waiting.add(card);
  }

  #drawAll() {
    const cards = [...this.#waiting];
    this.#waiting.clear();
    for (const card of cards) this.#drawNow(card);
  }

  /** @param {Card} card */
  #drawNow(card) {
    const { canvas, model } = card;
    const side = Math.round(canvas.clientWidth * Math.min(window.devicePixelRatio, 2));
    if (!model || side === 0) return;
    this.#shown.add(card);
    this.#look(model.sphere, card.turn, card.rise);
    this.#renderer.setSize(side, side, false);
    this.#scene.add(model.root);
    this.#renderer.render(this.#scene, this.#camera);
    this.#scene.remove(model.root);
    canvas.width = canvas.height = side;  // also clears it
    canvas.getContext('2d')?.drawImage(this.#renderer.domElement, 0, 0);
  }

  /**
   * The camera where the sphere just fits.
   * @param {Sphere} sphere
   * @param {number} turn
   * @param {number} rise
   */
  #look(sphere, turn, rise) {
    const distance = sphere.radius / Math.sin((FIELD_OF_VIEW / 2) * (Math.PI / 180));
    this.#camera.near = distance - sphere.radius * 1.01;
    this.#camera.far = distance + sphere.radius * 1.01;
    this.#camera.position
      .set(Math.sin(turn) * Math.cos(rise), Math.sin(rise), Math.cos(turn) * Math.cos(rise))
      .multiplyScalar(distance)
      .add(sphere.center);
    this.#camera.lookAt(sphere.center);
    this.#camera.updateProjectionMatrix();
  }
}
