// SPDX-License-Identifier: Apache-2.0
// @ts-check
// What the page weighs, and how long a visitor waits: objects in 3D against the same objects as pictures.
import { textElement } from './card.js';
import { byteText } from './text.js';

/** @typedef {{ bytes: number, gzip: number }} Size */
/**
 * The key `page` of gallery.json.
 * @typedef {object} PageWeight
 * @property {number} objects
 * @property {number} thumbnails
 * @property {{ thumbnails: number }} [plain]  of the files that it shows in place of these, and that need no decoder
 * @property {number} posters
 * @property {Record<string, Record<string, number>>} series  bytes by coding and frames
 * @property {Size} [viewer]
 * @property {Size} [decoder]
 */

const BANDWIDTHS = [1.6, 10, 50]; // Mbit/s: slow 3G, a phone, a line at home
const CODINGS = { jpeg90: 'JPEG of quality 90', webp80: 'WebP of quality 80', avif65: 'AVIF of quality 65' };

/** @param {number} bytes @param {number} bandwidth Mbit/s */
const seconds = (bytes, bandwidth) => (bytes * 8) / (bandwidth * 1e6);

/** @param {number} value of seconds */
const secondsText = (value) => (value < 0.995 ? `${Math.max(1, Math.round(value * 100)) / 100} s` : `${value < 10 ? value.toFixed(1) : Math.round(value)} s`);

/** @param {(string | number)[]} cells @param {'th' | 'td'} tag */
function row(cells, tag) {
  const line = document.createElement('tr');
  cells.forEach((cell, i) => {
    const element = textElement(i === 0 ? 'th' : tag, String(cell));
    element.setAttribute('scope', i === 0 && tag === 'td' ? 'row' : 'col');
    if (tag === 'td' && i > 0) element.removeAttribute('scope');
    line.append(element);
  });
  return line;
}

/** One line: what there is to load, for one object and for all, and how long that takes. @param {string} name @param {number} code @param {number} objects @param {number} count */
function line(name, code, objects, count) {
  const first = code + objects / count, all = code + objects;
  return row([name, byteText(first), byteText(all), ...BANDWIDTHS.map((b) => secondsText(seconds(first, b))), ...BANDWIDTHS.map((b) => secondsText(seconds(all, b)))], 'td');
}

/** What objects in 3D weigh. @param {PageWeight} page */
function threeD({ viewer, decoder, thumbnails, plain }) {
  if (plain) return { code: viewer?.gzip ?? 0, name: '3D, with viewer', thumbnails: plain.thumbnails };
  return { code: (viewer?.gzip ?? 0) + (decoder?.gzip ?? 0), name: '3D, with viewer and decoder', thumbnails };
}

/** @param {PageWeight} page */
export function weightTable(page) {
  const { code, name, thumbnails } = threeD(page);
  const table = document.createElement('table');
  const bands = BANDWIDTHS.map((b) => `${b} Mbit/s`);
  const head = document.createElement('thead'), body = document.createElement('tbody');
  head.append(row(['', 'first object', `all ${page.objects}`, ...bands.map((b) => `first at ${b}`), ...bands.map((b) => `all at ${b}`)], 'th'));
  body.append(line(name, code, thumbnails, page.objects));
  for (const [coding, sums] of Object.entries(page.series))
    for (const [frames, bytes] of Object.entries(sums))
      body.append(line(`${frames} pictures, ${CODINGS[/** @type {keyof CODINGS} */ (coding)] ?? coding}`, 0, bytes, page.objects));
  table.append(head, body);
  return table;
}

/** In words, above the table. @param {PageWeight} page */
export function weightText(page) {
  const viewer = byteText(page.viewer?.gzip ?? 0), decoder = byteText(page.decoder?.gzip ?? 0), { thumbnails } = threeD(page);
  const parts = page.plain ? `Thumbnails ${byteText(thumbnails)} without Draco, as its decoder, ${decoder}, would not be worth it; viewer ${viewer}`
    : `Thumbnails ${byteText(thumbnails)}, viewer ${viewer}, Draco decoder ${decoder}`;
  return `${parts} (code as by gzip); posters ${byteText(page.posters)} beside, whichever is shown. Of series of pictures no code is counted.`;
}

/** @param {number[]} decodings milliseconds */
export function decodingText(decodings) {
  if (decodings.length === 0) return '';
  const middle = [...decodings].sort((a, b) => a - b)[decodings.length >> 1];
  return `Decoding took ${Math.round(middle)} ms an object here (median of ${decodings.length}).`;
}
