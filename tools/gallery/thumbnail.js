// SPDX-License-Identifier: Apache-2.0
// @ts-check
// <vitrine-thumbnail>: one object as a card, in any page. docs/embedding.md says how.
import { switcher, toolbar } from './controls.js';
import { Decoder } from './decode.js';
import { listen } from './gestures.js';
import { release, request, unwatch, watch } from './loading.js';
import { Orbit } from './orbit.js';
import { openSeries } from './series.js';
import { lookAt, Stage } from './stage.js';
import { byteText, errorText } from './text.js';
import css from './thumbnail.css';

const MODES = /** @type {const} */ (['shaded', 'white', 'normals']);
const SHOWINGS = /** @type {const} */ (['3d', 'series', 'series-2']);
const SETTLE = 150; // milliseconds without a turn, after which a picture is drawn at its best

const sheet = new CSSStyleSheet();
sheet.replaceSync(css);

/** @type {Set<VitrineThumbnail>} those that show something that was drawn */
const live = new Set();
/** @type {Stage | null} */
let stage = null;
/** @type {Decoder | null} */
let decoder = null;
/** @type {number[]} milliseconds of each decoding */
const decodings = [];
/** Milliseconds after which the page's first object was drawn; 0: not yet. */
let first = 0;

/** The one value of a list that an attribute names, else the first. @template T @param {readonly T[]} list @param {any} value @returns {T} */
const among = (list, value) => (list.includes(value) ? value : list[0]);

export class VitrineThumbnail extends HTMLElement {
  static observedAttributes = ['src', 'poster', 'alt', 'series', 'series-rows', 'sphere', 'bytes', 'error', 'mode', 'view', 'light', 'rotation'];

  /** Where the decoders lie: draco/ and meshopt.js. */
  static decoders = new URL('./', import.meta.url).href;

  /** What all thumbnails of the page take. */
  static get statistics() {
    const { geometries = 0, textures = 0 } = stage?.memory ?? {};
    return { live: live.size, contexts: stage ? 1 : 0, geometries, textures, decodings: [...decodings], first };
  }

  orbit = new Orbit();
  /** @type {import('./model.js').Model | null} */
  model = null;
  /** @type {[number, number]} */
  light = [0, 0];
  moving = false;
  canvas = document.createElement('canvas');
  #poster = document.createElement('img');
  #slot = document.createElement('slot');
  #picture = document.createElement('div');
  #facts = document.createElement('p');
  #near = false;
  #settling = 0;
  /** @type {import('./series.js').Series | null} */
  #series = null;
  #tools = toolbar((action) => this.#act(action));
  #switch = switcher((showing) => this.setAttribute('view', showing));

  constructor() {
    super();
    const root = this.attachShadow({ mode: 'open' });
    root.adoptedStyleSheets = [sheet];
    const frame = document.createElement('div');
    frame.setAttribute('part', 'frame');
    for (const [element, part] of /** @type {const} */ ([[this.#picture, 'picture'], [this.#poster, 'poster'], [this.canvas, 'canvas'], [this.#facts, 'facts']]))
      element.setAttribute('part', part);
    this.#poster.alt = '';
    this.#poster.hidden = true;
    this.#slot.name = 'poster';
    this.#slot.append(this.#poster);
    this.canvas.hidden = true;
    this.#picture.tabIndex = 0;
    this.#picture.setAttribute('role', 'slider');
    this.#picture.setAttribute('aria-valuemin', '0');
    this.#picture.setAttribute('aria-valuemax', '359');
    this.#picture.append(this.#slot, this.canvas);
    frame.append(this.#picture, this.#tools.bar);
    root.append(frame, document.createElement('slot'), this.#facts, this.#switch.group);
    this.#listen();
  }

  // ---- Attributes ---------------------------------------------------------------------------------------------------

  get mode() {
    return among(MODES, this.getAttribute('mode'));
  }

  /** '3d', or one or two axes of pictures. */
  get view() {
    return this.hasAttribute('series') ? among(SHOWINGS, this.getAttribute('view')) : '3d';
  }

  get #free() {
    return this.getAttribute('rotation') === 'free' && this.view === '3d';
  }

  get #lit() {
    return this.getAttribute('light') === 'pointer';
  }

  /** Where the camera stands: in degrees, and in the model's own space once it is loaded. */
  get camera() {
    const { around, above } = this.orbit.degrees;
    const camera = { azimuth: around, elevation: above, zoom: this.orbit.zoom };
    const sphere = this.model?.sphere;
    if (!sphere) return camera;
    const { eye, up } = lookAt(sphere, this.orbit);
    return { ...camera, eye: eye.toArray(), target: sphere.center.toArray(), up: up.toArray() };
  }

  get #sphere() {
    const numbers = (this.getAttribute('sphere') ?? '').trim().split(/\s+/).map(Number);
    return numbers.length === 4 && numbers.every(Number.isFinite) && numbers[3] > 0 ? numbers : null;
  }

  connectedCallback() {
    this.#describe();
    watch(this);
  }

  disconnectedCallback() {
    unwatch(this);
  }

  /** @param {string} name @param {string | null} before @param {string | null} value */
  attributeChangedCallback(name, before, value) {
    if (before === value) return;
    if (name === 'poster') {
      this.#poster.hidden = !value;
      if (value) this.#poster.src = value;
    }
    if (name === 'rotation' && value !== 'free') this.orbit.straighten();
    if (name === 'light' && !this.#lit) this.light = [0, 0];
    if (name === 'series') this.#series = null;
    if (name === 'src' || name === 'series' || name === 'sphere' || name === 'view') this.#reload();
    this.#describe();
    this.#draw();
    if (name === 'view' && this.isConnected) this.#tell('vitrine-view', { view: this.view });
  }

  // ---- Loading ------------------------------------------------------------------------------------------------------

  /** @param {boolean} near */
  wanted(near) {
    this.#near = near;
    if (near) request(this);
    else release(this);
  }

  #reload() {
    release(this);
    if (this.isConnected && this.#near) request(this, this.matches(':hover, :focus-within'));
  }

  /** Called when its turn has come. @param {AbortSignal} signal */
  async load(signal) {
    try {
      if (this.view === '3d') await this.#loadModel(signal);
      else this.#series ??= await openSeries(/** @type {string} */ (this.getAttribute('series')));
      if (signal.aborted) return;
      live.add(this);
      this.removeAttribute('problem');
      this.#describe();
      this.#draw();
    } catch (error) {
      if (signal.aborted) return;
      const reason = error instanceof Error ? error.message : String(error);
      this.setAttribute('problem', reason);
      this.#describe();
      this.#tell('vitrine-error', { reason });
    }
  }

  /** @param {AbortSignal} signal */
  async #loadModel(signal) {
    const source = this.getAttribute('src');
    if (!source) throw new Error('no src');
    const answer = await fetch(source, { signal });
    if (!answer.ok) throw new Error(`${answer.status} ${answer.statusText}`);
    const bytes = await answer.arrayBuffer();
    decoder ??= new Decoder(VitrineThumbnail.decoders);
    stage ??= new Stage(() => live.forEach((card) => card.#draw()));
    const model = await decoder.model(bytes, this.#sphere);
    if (signal.aborted) return model.dispose();
    this.model = model;
    decodings.push(model.milliseconds);
    this.#tell('vitrine-load', { bytes: bytes.byteLength, triangles: model.triangles, milliseconds: model.milliseconds });
  }

  /** Gives its memory back, and shows the poster. */
  free() {
    if (live.delete(this)) this.#tell('vitrine-free', {});
    this.model?.dispose();
    this.model = null;
    this.#series = null;
    this.canvas.width = this.canvas.height = 0;
    this.#show(false);
  }

  // ---- Showing ------------------------------------------------------------------------------------------------------

  /** @param {boolean} drawn */
  #show(drawn) {
    this.canvas.hidden = !drawn;
    this.#slot.hidden = drawn;
  }

  #draw() {
    if (this.view === '3d') {
      if (!this.model || !stage) return;
      this.canvas.hidden = false; // only what is laid out has a size
      stage.draw(this);
    } else if (this.#series) {
      this.#drawFrame(this.#series);
    }
  }

  /** Called by the stage. */
  drawn() {
    first ||= performance.now();
    this.#show(true);
  }

  /** @param {import('./series.js').Series} series */
  async #drawFrame(series) {
    const rows = this.view === 'series-2' ? series.rows : 1;
    const wanted = series.nearest(this.orbit, rows);
    const picture = await series.picture(wanted).catch(() => null);
    if (!picture || this.#series !== series || series.nearest(this.orbit, rows) !== wanted) return;
    this.#show(true);
    const side = Math.round(this.canvas.clientWidth * Math.min(window.devicePixelRatio, 2));
    this.canvas.width = this.canvas.height = side;
    this.canvas.getContext('2d')?.drawImage(picture, 0, 0, side, side);
    series.prefetch(wanted);
  }

  /** Brings words, buttons and what assistive technology reads up to date. */
  #describe() {
    const { around, above } = this.orbit.degrees;
    this.#picture.setAttribute('aria-label', `Turn ${this.getAttribute('alt') || 'the object'}`);
    this.#picture.setAttribute('aria-valuenow', String(around));
    this.#picture.setAttribute('aria-valuetext', `${around} degrees around, ${above} above`);
    this.#facts.textContent = this.#factsText();
    this.#tools.show(this.mode, this.#free, this.#lit);
    this.#tools.bar.hidden = this.view !== '3d';
    const rows = this.#series?.rows ?? Number(this.getAttribute('series-rows') ?? 1);
    this.#switch.show(this.view, this.hasAttribute('series'), rows > 1);
  }

  #factsText() {
    const problem = this.getAttribute('problem');
    if (problem) return `Cannot be shown: ${problem}`;
    if (this.view !== '3d') {
      if (!this.#series) return '';
      return [byteText(this.#series.bytes(this.view === 'series' ? 1 : this.#series.rows)), errorText(this.#series.error)].filter(Boolean).join(', ');
    }
    const [bytes, error] = ['bytes', 'error'].map((name) => (this.hasAttribute(name) ? Number(this.getAttribute(name)) : undefined));
    return [bytes === undefined ? '' : byteText(bytes), errorText(error)].filter(Boolean).join(', ');
  }

  /** @param {string} type @param {object} detail */
  #tell(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail, bubbles: true, composed: true }));
  }

  // ---- Hands --------------------------------------------------------------------------------------------------------

  #listen() {
    for (const pointedAt of ['pointerenter', 'focusin']) this.addEventListener(pointedAt, () => request(this, true));
    listen(this.#picture, {
      orbit: this.orbit,
      free: () => this.#free,
      changed: (moving) => this.#changed(moving),
      pointed: (right, up) => this.#shine(right, up),
      left: () => this.#shine(0, 0),
      pressed: (key) => this.#pressed(key),
    });
    new ResizeObserver(() => this.#draw()).observe(this.#picture);
  }

  /** @param {boolean} moving */
  #changed(moving) {
    this.moving = moving;
    clearTimeout(this.#settling);
    if (moving) this.#settling = window.setTimeout(() => this.#changed(false), SETTLE);
    this.#describe();
    this.#draw();
    this.#tell('vitrine-change', this.camera);
  }

  /** @param {number} right @param {number} up */
  #shine(right, up) {
    if (!this.#lit || this.view !== '3d') return;
    const far = Math.max(1, Math.hypot(right, up));
    this.light = [right / far, up / far];
    this.#draw();
  }

  /** @param {string} key */
  #pressed(key) {
    const action = { m: 'mode', l: 'light', f: 'rotation' }[key.toLowerCase()];
    if (action) this.#act(/** @type {any} */ (action));
    return action !== undefined;
  }

  /** @param {import('./controls.js').Action} action */
  #act(action) {
    if (action === 'mode') this.setAttribute('mode', MODES[(MODES.indexOf(this.mode) + 1) % MODES.length]);
    if (action === 'rotation') this.setAttribute('rotation', this.#free ? 'turntable' : 'free');
    if (action === 'light') this.setAttribute('light', this.#lit ? 'head' : 'pointer');
    if (action === 'closer' || action === 'farther') this.orbit.magnify(action === 'closer' ? 1.25 : 0.8);
    if (action === 'reset') this.orbit.reset();
    if (['closer', 'farther', 'reset'].includes(action)) this.#changed(false);
  }
}

customElements.define('vitrine-thumbnail', VitrineThumbnail);
