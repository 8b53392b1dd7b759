// SPDX-License-Identifier: Apache-2.0
// @ts-check
// The gallery page: gallery.json beside index.html says what there is to see. It draws nothing: cards are <vitrine-thumbnail>s,
// whose script loads meanwhile.
import { makeCard, shownFile, textElement } from './card.js';
import { byteText, countText } from './text.js';
import { hereText, waitTable, weightTable, weightText } from './weight.js';

/** @typedef {import('./card.js').GalleryObject} GalleryObject */
/** @typedef {{ object: GalleryObject, element: HTMLElement, words: string }} Card */

/** @template {HTMLElement} T @param {string} id @returns {T} */
const byId = (id) => /** @type {T} */ (document.getElementById(id));

const status = byId('summary');
const cards = byId('cards');
const search = /** @type {HTMLInputElement} */ (byId('search'));
const sort = /** @type {HTMLSelectElement} */ (byId('sort'));
const order = /** @type {HTMLButtonElement} */ (byId('order'));

/** @type {Record<string, (object: GalleryObject) => string | number>} */
const KEYS = {
  name: ({ title }) => title,
  bytes: (object) => shownFile(object).bytes,
  error: ({ mse1e4 }) => mse1e4 ?? Infinity,
  triangles: ({ triangles }) => triangles,
};

const collator = new Intl.Collator(undefined, { numeric: true });

/** @param {string | number} a @param {string | number} b */
const compare = (a, b) => (typeof a === 'string' ? collator.compare(a, String(b)) : Number(a) - Number(b) || 0);

async function readGallery() {
  const answer = await fetch('gallery.json');
  if (!answer.ok) throw new Error(`gallery.json: ${answer.status} ${answer.statusText}`);
  const gallery = await answer.json();
  if (gallery.schema !== 1) throw new Error(`gallery.json: schema ${gallery.schema}, this page knows 1`);
  return gallery;
}

/** @param {Card[]} all */
function arrange(all) {
  const words = search.value.toLocaleLowerCase().split(/\s+/).filter(Boolean);
  const shown = all.filter((card) => words.every((word) => card.words.includes(word)));
  const key = KEYS[sort.value];
  const sign = order.getAttribute('aria-pressed') === 'true' ? -1 : 1;
  shown.sort((a, b) => sign * compare(key(a.object), key(b.object)));
  cards.replaceChildren(...shown.map(({ element }) => element));
  const bytes = shown.reduce((sum, { object }) => sum + shownFile(object).bytes, 0);
  const among = shown.length < all.length ? ` of ${all.length}` : '';
  status.textContent = shown.length === 0 ? 'No object fits.' : `${countText(shown.length, 'object')}${among}, ${byteText(bytes)}`;
}

/** Choices that go for all cards: each is an attribute of the thumbnails. @param {HTMLElement} form */
function listenForAll(form) {
  form.addEventListener('change', (event) => {
    const { name, value, type, checked } = /** @type {HTMLInputElement} */ (event.target);
    if (!name) return;
    const chosen = type === 'checkbox' ? (checked ? value : '') : value;
    for (const seen of document.querySelectorAll('vitrine-thumbnail')) seen.setAttribute(name, chosen);
  });
}

/** @param {GalleryObject[]} objects */
function offerSeries(objects) {
  byId('views').hidden = !objects.some(({ series }) => series);
  byId('view-2').hidden = !objects.some(({ series }) => (series?.rows ?? 1) > 1);
}

/** A table that may be wider than the page. @param {string} name @param {HTMLTableElement} table */
function scrolled(name, table) {
  const scroll = document.createElement('div');
  scroll.className = 'scroll';
  scroll.tabIndex = 0;
  scroll.setAttribute('role', 'region');
  scroll.setAttribute('aria-label', name);
  scroll.append(table);
  return scroll;
}

/** @param {import('./weight.js').PageWeight} page */
function showWeight(page) {
  const weight = byId('weight');
  const here = textElement('p', '');
  weight.append(textElement('p', weightText(page)), scrolled('What this page weighs', weightTable(page)));
  if (page.measured) {
    weight.append(textElement('p', `Waited for, in Chromium with an empty cache; decoding one object took ${Math.round(page.measured.decoding)} ms:`));
    weight.append(scrolled('How long visitors wait', waitTable(page.measured.visits)));
  }
  weight.append(here);
  weight.hidden = false;
  weight.addEventListener('toggle', () => {
    const { statistics } = /** @type {any} */ (customElements.get('vitrine-thumbnail') ?? { statistics: { decodings: [] } });
    here.textContent = hereText(statistics);
  });
}

/** Asks for the decoder before the viewer, which is long, is there to ask. @param {import('./weight.js').PageWeight} [page] */
function preloadDecoder(page) {
  if (!page || page.plain) return;
  for (const file of page.decoder?.files ?? []) {
    const link = document.createElement('link');
    if (file === 'meshopt.js') link.rel = 'modulepreload';
    else Object.assign(link, { rel: 'preload', as: 'fetch', crossOrigin: 'anonymous' });
    link.href = `viewer/${file}`;
    document.head.append(link);
  }
}

async function main() {
  const { objects, page } = await readGallery();
  preloadDecoder(page);
  /** @type {Card[]} */
  const all = objects.map((/** @type {GalleryObject} */ object) => ({
    object,
    element: makeCard(object),
    words: [object.title, ...Object.values(object.metadata ?? {})].join(' ').toLocaleLowerCase(),
  }));
  offerSeries(objects);
  listenForAll(byId('tools'));
  search.addEventListener('input', () => arrange(all));
  sort.addEventListener('change', () => arrange(all));
  order.addEventListener('click', () => {
    order.setAttribute('aria-pressed', String(order.getAttribute('aria-pressed') !== 'true'));
    arrange(all);
  });
  byId('tools').addEventListener('submit', (event) => event.preventDefault());
  arrange(all);
  for (const id of ['tools', 'foot']) byId(id).hidden = false; // not before, or they would move
  if (page) showWeight(page);
}

main().catch((error) => {
  status.textContent = `The gallery cannot be shown: ${error.message}`;
});
