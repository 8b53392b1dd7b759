// SPDX-License-Identifier: Apache-2.0
// The gallery page: gallery.json beside index.html says what there is to see.
import { Card } from './card.js';
import { Stage } from './stage.js';
import { byteText, countText } from './text.js';

/**
 * @typedef {object} GalleryObject
 * @property {string} slug
 * @property {string} title
 * @property {string} thumb  address of the GLB, relative to the page
 * @property {number} bytes
 * @property {number} triangles
 * @property {Record<string, string>} [metadata]  further columns of archive.csv
 */

const summary = /** @type {HTMLElement} */ (document.getElementById('summary'));
const cards = /** @type {HTMLElement} */ (document.getElementById('cards'));

/** @returns {Promise<GalleryObject[]>} */
async function readGallery() {
  const answer = await fetch('gallery.json');
  if (!answer.ok) throw new Error(`gallery.json: ${answer.status} ${answer.statusText}`);
  const gallery = await answer.json();
  if (gallery.schema !== 1) throw new Error(`gallery.json: schema ${gallery.schema}, this page knows 1`);
  return gallery.objects;
}

async function main() {
  const objects = await readGallery();
  const bytes = objects.reduce((sum, object) => sum + object.bytes, 0);
  summary.textContent = `${countText(objects.length, 'object')}, ${byteText(bytes)}. Drag an object to turn it.`;

  const stage = new Stage();
  const inView = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) if (entry.isIntersecting) cardOf.get(entry.target)?.show(stage);
    },
    { rootMargin: '50%' },
  );
  /** @type {Map<Element, Card>} */
  const cardOf = new Map();
  for (const object of objects) {
    const card = new Card(object);
    cardOf.set(card.element, card);
    cards.append(card.element);
    inView.observe(card.element);
  }
}

main().catch((error) => {
  summary.textContent = `The gallery cannot be shown: ${error.message}`;
});
