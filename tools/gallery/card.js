// SPDX-License-Identifier: Apache-2.0
// @ts-check
// A card of the gallery: a <vitrine-thumbnail> and what is known about the object. Names are text, never markup.
import { linkWithCamera } from './link.js';
import { countText } from './text.js';

/**
 * An object of gallery.json.
 * @typedef {object} GalleryObject
 * @property {string} slug
 * @property {string} title
 * @property {string} thumb  address of the GLB, relative to the page
 * @property {string} poster
 * @property {number} bytes
 * @property {{ glb: string, bytes: number }} [plain]  the same without Draco, where the page is lighter with these
 * @property {number} triangles
 * @property {number} [mse1e4]
 * @property {{ centre: number[], radius: number }} [sphere]
 * @property {{ manifest: string, frames: number, rows: number, bytes: number }} [series]
 * @property {Record<string, string>} [metadata]  further columns of archive.csv
 */

/**
 * @param {string} tag
 * @param {string} text
 * @param {string} [name]  of its class
 */
export function textElement(tag, text, name) {
  const element = document.createElement(tag);
  element.textContent = text;
  if (name) element.className = name;
  return element;
}

/** A name's heading. What is longer than a line breaks between words, as file names have them, before it breaks within one. @param {string} title */
function heading(title) {
  const element = document.createElement('h2');
  title.split(/(?<=[_.\-])(?=[^_.\-])|(?<=\p{Ll})(?=\p{Lu})/u).forEach((word, i) => element.append(...(i > 0 ? [document.createElement('wbr'), word] : [word])));
  return element;
}

/** The file that the page shows. @param {GalleryObject} object */
export const shownFile = ({ plain, thumb, bytes }) => plain ?? { glb: thumb, bytes };

/** @param {GalleryObject} object */
function thumbnail(object) {
  const { title, poster, mse1e4, sphere, series } = object;
  const { glb, bytes } = shownFile(object);
  const element = document.createElement('vitrine-thumbnail');
  /** @type {Record<string, unknown>} */
  const attributes = {
    src: glb, alt: title, bytes, error: mse1e4, sphere: sphere && [...sphere.centre, sphere.radius].join(' '),
    series: series?.manifest, 'series-rows': series?.rows,
  };
  for (const [name, value] of Object.entries(attributes)) if (value !== undefined) element.setAttribute(name, String(value));
  const image = document.createElement('img');
  Object.assign(image, { slot: 'poster', loading: 'lazy', decoding: 'async', width: 200, height: 200, alt: title });
  if (poster) image.src = poster;
  element.append(image);
  return element;
}

/** @param {string} link @param {HTMLElement} seen  the thumbnail whose camera it takes */
function fullModel(link, seen) {
  const anchor = /** @type {HTMLAnchorElement} */ (textElement('a', 'Full model'));
  const update = (/** @type {Record<string, any>} */ camera) => {
    const address = linkWithCamera(link, camera, document.baseURI);
    if (address) anchor.href = address;
    return address !== null;
  };
  anchor.rel = 'noopener noreferrer';
  for (const event of ['vitrine-load', 'vitrine-change']) seen.addEventListener(event, () => update(/** @type {any} */ (seen).camera));
  return update({ azimuth: 0, elevation: 10, zoom: 1 }) ? anchor : null;
}

/** @param {GalleryObject} object */
export function makeCard(object) {
  const { slug, title, triangles, metadata = {} } = object;
  const card = document.createElement('article');
  card.className = 'card';
  card.id = slug;
  const seen = thumbnail(object);
  seen.append(heading(title));
  const { credit = '', licence = '' } = metadata;
  const credits = textElement('p', credit && licence ? `${credit}, ` : credit);
  if (licence) credits.append(textElement('span', licence));
  if (credit || licence) seen.append(credits);
  const last = textElement('p', countText(triangles, 'triangle'));
  const anchor = metadata.link ? fullModel(metadata.link, seen) : null;
  if (anchor) last.append(' · ', anchor);
  card.append(seen, last);
  return card;
}
