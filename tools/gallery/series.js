// SPDX-License-Identifier: Apache-2.0
// @ts-check
// The rival: the same object as pictures from all sides, as series.json lists them.

/**
 * @typedef {object} Manifest
 * @property {number} frames
 * @property {number} rows
 * @property {number[]} [elevations]  degrees, of each row, the lowest first
 * @property {{ file: string, bytes: number }[]} files
 * @property {number} [codingMse1e4]
 * @property {number} [turningMse1e4]
 */

/** @param {string} address of series.json */
export async function openSeries(address) {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`the series: ${answer.status} ${answer.statusText}`);
  const manifest = await answer.json();
  if (manifest.schema !== 1 || !Array.isArray(manifest.files)) throw new Error('the series: no series.json of schema 1 with single files');
  return new Series(manifest, answer.url);
}

export class Series {
  /** @type {Map<number, Promise<HTMLImageElement>>} */
  #pictures = new Map();
  #manifest;
  #address;

  /** @param {Manifest} manifest @param {string} address */
  constructor(manifest, address) {
    this.#manifest = manifest;
    this.#address = address;
  }

  get rows() {
    return this.#manifest.rows;
  }

  /** Error of who turns it: the nearest frame against the true view, where that was measured. */
  get error() {
    return this.#manifest.turningMse1e4 ?? this.#manifest.codingMse1e4;
  }

  /** Of the files of that many rows. @param {number} rows */
  bytes(rows) {
    return this.#manifest.files.slice(0, rows * this.#manifest.frames).reduce((sum, file) => sum + file.bytes, 0);
  }

  /** The frame nearest to a view. @param {import('./orbit.js').Orbit} orbit @param {number} rows */
  nearest(orbit, rows) {
    const { frames, elevations = [] } = this.#manifest;
    const frame = Math.round((orbit.turn / (2 * Math.PI)) * frames) % frames;
    const above = (orbit.rise * 180) / Math.PI;
    const distances = elevations.slice(0, rows).map((elevation) => Math.abs(elevation - above));
    const row = Math.max(0, distances.indexOf(Math.min(...distances)));
    return row * frames + ((frame + frames) % frames);
  }

  /** The decoded picture, loaded once. @param {number} index */
  picture(index) {
    const known = this.#pictures.get(index);
    if (known) return known;
    const image = new Image();
    image.src = new URL(this.#manifest.files[index].file, this.#address).href;
    const picture = image.decode().then(() => image);
    picture.catch(() => this.#pictures.delete(index));
    this.#pictures.set(index, picture);
    return picture;
  }

  /** Loads the row's other frames, so that dragging finds them. @param {number} index of one of its frames */
  prefetch(index) {
    const { frames } = this.#manifest;
    const first = index - (index % frames);
    for (let i = first; i < first + frames; ++i) this.picture(i).catch(() => {});
  }
}
