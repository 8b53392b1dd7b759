// SPDX-License-Identifier: Apache-2.0
// @ts-check
// What the page weighs, and how long a visitor waits: objects in 3D against the same objects as pictures.
import { textElement } from './card.js';
import { byteText } from './text.js';

/** @typedef {{ bytes: number, gzip: number }} Size */
/**
 * What tools/page_speed.mjs found: seconds until the first poster, the first object and all in view were there.
 * @typedef {{ view: string, megabits: number, latency: number, poster: number, first: number, all: number }} Visit
 */
/**
 * The key `page` of gallery.json.
 * @typedef {object} PageWeight
 * @property {number} objects
 * @property {number} thumbnails
 * @property {{ thumbnails: number }} [plain]  of the files that it shows in place of these, and that need no decoder
 * @property {number} posters
 * @property {Record<string, Record<string, number>>} series  bytes by coding and frames
 * @property {Size} [viewer]
 * @property {Size & { files: string[] }} [decoder]  of the profile, where it needs one
 * @property {{ decoding: number, visits: Visit[] }} [measured]  milliseconds an object, and visits over slow lines
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

/** @param {HTMLTableRowElement} head @param {HTMLTableRowElement[]} lines */
function tableOf(head, lines) {
  const table = document.createElement('table');
  table.createTHead().append(head);
  table.createTBody().append(...lines);
  return table;
}

/** What objects in 3D weigh. @param {PageWeight} page */
function threeD({ viewer, decoder, thumbnails, plain }) {
  const code = viewer?.gzip ?? 0;
  if (plain) return { code, name: '3D, with viewer', thumbnails: plain.thumbnails };
  return decoder ? { code: code + decoder.gzip, name: '3D, with viewer and decoder', thumbnails } : { code, name: '3D, with viewer', thumbnails };
}

/** @param {PageWeight} page */
export function weightTable(page) {
  const { code, name, thumbnails } = threeD(page);
  const bands = BANDWIDTHS.map((b) => `${b} Mbit/s`);
  const lines = [line(name, code, thumbnails, page.objects)];
  for (const [coding, sums] of Object.entries(page.series))
    for (const [frames, bytes] of Object.entries(sums))
      lines.push(line(`${frames} pictures, ${CODINGS[/** @type {keyof CODINGS} */ (coding)] ?? coding}`, 0, bytes, page.objects));
  return tableOf(row(['computed', 'first object', `all ${page.objects}`, ...bands.map((b) => `first at ${b}`), ...bands.map((b) => `all at ${b}`)], 'th'), lines);
}

/** How long visitors waited. @param {Visit[]} visits */
export function waitTable(visits) {
  const lines = visits.map(({ view, megabits, latency, poster, first, all }) =>
    row([view === '3d' ? '3D' : 'pictures, one axis', `${megabits} Mbit/s, ${latency} ms`, ...[poster, first, all].map(secondsText)], 'td'));
  return tableOf(row(['measured', 'line', 'first poster', 'first object', 'all in view'], 'th'), lines);
}

/** In words, above the table. @param {PageWeight} page */
export function weightText(page) {
  const viewer = byteText(page.viewer?.gzip ?? 0), decoder = byteText(page.decoder?.gzip ?? 0), { thumbnails } = threeD(page);
  const parts = page.plain ? `Thumbnails ${byteText(thumbnails)} without Draco, as its decoder, ${decoder}, would not be worth it; viewer ${viewer}`
    : `Thumbnails ${byteText(thumbnails)}, viewer ${viewer}${page.decoder ? `, decoder ${decoder}` : ''}`;
  return `${parts} (code as by gzip); posters ${byteText(page.posters)} beside, whichever is shown. Of series of pictures no code is counted.`;
}

/** What this visit took. @param {{ decodings: number[], first: number }} statistics  milliseconds */
export function hereText({ decodings, first }) {
  if (decodings.length === 0) return '';
  const middle = [...decodings].sort((a, b) => a - b)[decodings.length >> 1];
  return `Here the first object was there after ${secondsText(first / 1000)}; decoding one took ${Math.round(middle)} ms (median of ${decodings.length}).`;
}
