// SPDX-License-Identifier: Apache-2.0
// @ts-check
// The demonstration: an object of the gallery as any page would show it, the lines that do so, and the events that come of it.

import { shownFile } from './card.js';

/** @typedef {import('./card.js').GalleryObject} GalleryObject */

const EVENTS = ['vitrine-load', 'vitrine-change', 'vitrine-view', 'vitrine-free', 'vitrine-error'];
const MOST_LINES = 12;

/** @param {string} text */
const escaped = (text) => text.replace(/[&"<]/g, (c) => ({ '&': '&amp;', '"': '&quot;', '<': '&lt;' })[c] ?? c);

/** @param {GalleryObject} object */
function attributesOf(object) {
  const { poster, title, mse1e4, sphere, series } = object;
  const { glb, bytes } = shownFile(object);
  /** @type {[string, unknown][]} */
  const attributes = [
    ['src', new URL(`../${glb}`, document.baseURI).pathname], ['poster', new URL(`../${poster}`, document.baseURI).pathname], ['alt', title],
    ['sphere', sphere && [...sphere.centre, sphere.radius].map((x) => Number(x.toPrecision(6))).join(' ')], ['bytes', bytes], ['error', mse1e4?.toFixed(2)],
    ['series', series && new URL(`../${series.manifest}`, document.baseURI).pathname], ['series-rows', series?.rows],
  ];
  return attributes.filter(([, value]) => value !== undefined).map(([name, value]) => /** @type {[string, string]} */ ([name, String(value)]));
}

/** @param {string} id */
const byId = (id) => /** @type {HTMLElement} */ (document.getElementById(id));

/** @param {GalleryObject} object */
function show(object) {
  const attributes = attributesOf(object);
  const element = document.createElement('vitrine-thumbnail');
  for (const [name, value] of attributes) element.setAttribute(name, value);
  const script = new URL('vitrine-thumbnail.js', document.baseURI).pathname;
  const written = attributes.map(([name, value]) => `${name}="${escaped(value)}"`).join('\n  ');
  byId('code').textContent = `<script type="module" src="${script}"></script>\n<vitrine-thumbnail\n  ${written}></vitrine-thumbnail>`;
  byId('events').textContent = '';
  byId('demo').replaceChildren(element);
}

/** @param {Event} event */
function note(event) {
  const log = byId('events');
  const lines = [`${event.type} ${JSON.stringify(/** @type {CustomEvent} */ (event).detail)}`, ...(log.textContent ?? '').split('\n')];
  log.textContent = lines.slice(0, MOST_LINES).join('\n');
}

async function main() {
  const { objects } = await (await fetch('../gallery.json')).json();
  const select = /** @type {HTMLSelectElement} */ (byId('object'));
  select.append(...objects.map((/** @type {GalleryObject} */ { title }, /** @type {number} */ i) => new Option(title, String(i))));
  for (const type of EVENTS) byId('demo').addEventListener(type, note);
  select.addEventListener('change', () => show(objects[Number(select.value)]));
  if (objects.length > 0) show(objects[0]);
}

main().catch((error) => { byId('code').textContent = `The gallery cannot be read: ${error.message}`; });
