// SPDX-License-Identifier: Apache-2.0
// One object: its picture, drawn by the shared stage, and what is known about it. Names are text, never markup.
import { byteText, countText } from './text.js';

const RADIANS_PER_PIXEL = 0.012;
const RADIANS_PER_KEY = Math.PI / 16;
const STEEPEST = 1.4;

/**
 * @param {string} tag
 * @param {string} text
 */
function textElement(tag, text) {
  const element = document.createElement(tag);
  element.textContent = text;
  return element;
}

export class Card {
  /** @type {import('./stage.js').Model | null} */
  #model = null;
  /** @type {import('./stage.js').Stage | null} */
  #stage = null;
  #canvas = document.createElement('canvas');
  #caption = document.createElement('figcaption');
  #object;
  /** Where the camera stands, in radians: around the object, and above the horizon. */
  turn = 0;
  rise = Math.PI / 18;

  /** @param {import('./gallery.js').GalleryObject} object */
  constructor(object) {
    this.#object = object;
    this.element = document.createElement('figure');
    this.element.className = 'card';
    this.element.append(this.#canvas, this.#caption);
    this.#canvas.tabIndex = 0;
    this.#canvas.setAttribute('role', 'img');
    this.#canvas.setAttribute('aria-label', `${object.title}: drag or press the arrow keys to turn it`);
    this.#caption.append(
      textElement('h2', object.title),
      textElement('p', `${byteText(object.bytes)}, ${countText(object.triangles, 'triangle')}`),
    );
    const { credit, licence } = object.metadata ?? {};
    if (credit || licence) this.#caption.append(textElement('p', [credit, licence].filter(Boolean).join(', ')));
    this.#listen();
  }

  get model() {
    return this.#model;
  }

  get canvas() {
    return this.#canvas;
  }

  /**
   * Loads the model once and keeps its picture up to date.
   * @param {import('./stage.js').Stage} stage
   */
  async show(stage) {
    if (this.#stage) return;
    this.#stage = stage;
    try {
      this.#model = await stage.load(this.#object.thumb);
      new ResizeObserver(() => stage.draw(this)).observe(this.#canvas);
    } catch (error) {
      const problem = textElement('p', `Cannot be shown: ${error instanceof Error ? error.message : error}`);
      problem.className = 'problem';
      this.#caption.append(problem);
    }
  }

  /**
   * @param {number} turn
   * @param {number} rise
   */
  #move(turn, rise) {
    this.turn += turn;
    this.rise = Math.min(STEEPEST, Math.max(-STEEPEST, this.rise + rise));
    this.#stage?.draw(this);
  }

  #listen() {
    this.#canvas.addEventListener('pointerdown', (event) => this.#canvas.setPointerCapture(event.pointerId));
    this.#canvas.addEventListener('pointermove', (event) => {
      if (!this.#canvas.hasPointerCapture(event.pointerId)) return;
      this.#move(-event.movementX * RADIANS_PER_PIXEL, event.movementY * RADIANS_PER_PIXEL);
    });
    this.#canvas.addEventListener('keydown', (event) => {
      const step = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!step) return;
      event.preventDefault();
      this.#move(step[0] * RADIANS_PER_KEY, step[1] * RADIANS_PER_KEY);
    });
  }
}
