// SPDX-License-Identifier: Apache-2.0
// A gallery in the browser, below a sub-path, and what its cards show.
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { openBrowser, serve } from './browser.mjs';

// A new folder with the page as built and a gallery.json of these objects.
export function writeGallery(objects, page) {
  const gallery = fs.mkdtempSync(path.join(os.tmpdir(), 'gallery-'));
  fs.cpSync(process.env.VITRINE_VIEWER, path.join(gallery, 'viewer'), { recursive: true });
  fs.renameSync(path.join(gallery, 'viewer/index.html'), path.join(gallery, 'index.html'));
  fs.writeFileSync(path.join(gallery, 'gallery.json'), JSON.stringify({ schema: 1, objects, page }));
  return gallery;
}

// Opens it, from a server of its own or from the one at `url`. `complaints` collects whatever should not be: errors, warnings of three, failed or foreign requests, violations of the
// content security policy. `window.contexts` counts WebGL contexts, `window.untilFirst` the bytes that were loaded when the first
// object was there, pictures apart.
export async function openGallery(folder, { width = 1280, height = 800, gzip = false, url, ...context } = {}) {
  const server = url ? null : await serve({ '/some/where/': folder }, { gzip });
  const home = url ?? `${server.url}/some/where/`;
  const browser = await openBrowser();
  const page = await browser.newPage({ viewport: { width, height }, ...context });
  const complaints = [];
  page.on('console', (message) => {
    if (message.type() === 'error' || message.text().startsWith('THREE.')) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('requestfailed', (request) => {
    if (request.failure()?.errorText !== 'net::ERR_ABORTED') complaints.push(`failed: ${request.url()}`); // cards that left before
  });
  page.on('request', (request) => { if (!/^(blob|data):/.test(request.url()) && !request.url().startsWith(new URL(home).origin)) complaints.push(`foreign: ${request.url()}`); });
  page.on('response', (response) => { if (response.status() >= 400) complaints.push(`${response.status()}: ${response.url()}`); });
  await page.addInitScript(() => {
    window.contexts = 0;
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (type, ...rest) {
      const context = get.call(this, type, ...rest);
      if (type.startsWith('webgl') && context && !this.counted) {
        this.counted = true;
        ++window.contexts;
      }
      return context;
    };
    // RGBA of what can be drawn into a canvas, in a form that travels fast.
    window.bytesOf = (source) => {
      const { width, height } = source;
      const context = source.getContext?.('2d') ?? Object.assign(document.createElement('canvas'), { width, height }).getContext('2d');
      if (!source.getContext) context.drawImage(source, 0, 0);
      const bytes = context.getImageData(0, 0, width, height).data;
      let text = '';
      for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
      return btoa(text);
    };
    const look = () => {
      if (![...document.querySelectorAll('vitrine-thumbnail')].some((card) => card.model)) return setTimeout(look, 5);
      window.untilFirst = [...performance.getEntriesByType('navigation'), ...performance.getEntriesByType('resource')]
        .filter(({ name, initiatorType }) => initiatorType !== 'img' && !name.startsWith('blob:')).reduce((sum, entry) => sum + entry.encodedBodySize, 0);
    };
    look();
    document.addEventListener('securitypolicyviolation', (event) => console.error(`policy: ${event.violatedDirective} ${event.blockedURI}`));
  });
  await page.goto(`${home}index.html`);
  return { page, complaints, close: async () => { await browser.close(); await server?.close(); } };
}

export const MOST_FIRST = 350e3; // bytes until the first object is there, pictures apart

export async function bytesUntilFirst(page) {
  await page.waitForFunction(() => window.untilFirst);
  return page.evaluate(() => window.untilFirst);
}

// How much of the page has moved by itself so far.
export const shiftOf = (page) => page.evaluate(() => new Promise((done) => {
  new PerformanceObserver((list) => done(list.getEntries().reduce((sum, { value }) => sum + value, 0))).observe({ type: 'layout-shift', buffered: true });
  setTimeout(() => done(0), 200);
}));

// The thumbnail of an object of gallery.json; of the card at this place.
export const cardOf = (page, object) => page.locator(`[id="${object.slug}"] vitrine-thumbnail`);
export const cardAt = (page, index) => page.locator('vitrine-thumbnail').nth(index);
export const pictureOf = (card) => card.locator('[part="picture"]');

// Chooses from a list by its keys.
export async function choose(page, list, value) {
  const select = page.locator(list);
  await select.focus();
  await page.keyboard.press('Home');
  for (let left = await select.locator('option').count(); (await select.inputValue()) !== value; --left) {
    if (left === 0) throw new Error(`${list} has no ${value}`);
    await page.keyboard.press('ArrowDown');
  }
}

// Waits until the card has drawn, in place of its poster; scrolls to it first.
export async function shown(card) {
  await card.scrollIntoViewIfNeeded();
  const deadline = Date.now() + 60000;
  while (!(await card.evaluate((element) => element.shadowRoot.querySelector('[name="poster"]').hidden))) {
    if (Date.now() > deadline) throw new Error(`not drawn: ${await card.getAttribute('problem')}`);
    await new Promise((done) => setTimeout(done, 30));
  }
}

// What the card's canvas shows: side, RGBA bytes.
export async function drawn(card) {
  const { side, bytes } = await card.evaluate(({ canvas }) => ({ side: canvas.width, bytes: canvas.width ? window.bytesOf(canvas) : '' }));
  return { side, data: Buffer.from(bytes, 'base64') };
}

// The same after all that is under way, at its best.
export async function pixels(card) {
  await card.evaluate(() => new Promise((done) => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done)), 250)));
  return drawn(card);
}

// Share of the pixels that differ by more than `by` in some channel.
export function change(a, b, by = 8) {
  let count = 0;
  for (let i = 0; i < a.data.length; i += 4) count += [0, 1, 2, 3].some((k) => Math.abs(a.data[i + k] - b.data[i + k]) > by);
  return count / (a.data.length / 4);
}

// How far any pixel is from grey.
export const hue = ({ data }) => data.reduce((most, value, i) => (i % 4 === 3 ? most : Math.max(most, Math.abs(value - data[i - (i % 4)]))), 0);

// Share of the pixels that the object covers.
export const coverage = ({ data }) => data.filter((value, i) => i % 4 === 3 && value > 0).length / (data.length / 4);

// RGBA of the pixel in the middle.
export function middle({ side, data }) {
  const i = 4 * ((side >> 1) * side + (side >> 1));
  return [...data.subarray(i, i + 4)];
}

// A picture's file as the page's browser decodes it, RGBA.
export const decoded = async (page, file) => Buffer.from(await page.evaluate(async (source) => {
  const image = new Image();
  image.src = source;
  await image.decode();
  return window.bytesOf(image);
}, file), 'base64');

// Mean square error times 10^4 of two pictures, RGBA; alpha apart.
export function mse1e4(a, b) {
  let sum = 0;
  for (let i = 0; i < a.length; ++i) if (i % 4 !== 3) sum += ((a[i] - b[i]) / 255) ** 2;
  return (1e4 * sum) / (a.length * 0.75);
}

// Means of the 8 x 8 blocks of a square picture, which JPEG keeps whatever it does to the texture within, RGBA.
export function blockMeans(data) {
  const side = Math.sqrt(data.length / 4), count = Math.floor(side / 8);
  const means = new Float64Array(4 * count * count);
  for (let y = 0; y < 8 * count; ++y)
    for (let x = 0; x < 8 * count; ++x)
      for (let k = 0; k < 4; ++k) means[4 * ((y >> 3) * count + (x >> 3)) + k] += data[4 * (y * side + x) + k] / 64;
  return means;
}

// Over white, as the page shows it.
export function overWhite({ data }) {
  return data.map((value, i) => {
    const alpha = data[i - (i % 4) + 3];
    return i % 4 === 3 ? 255 : Math.round((value * alpha) / 255 + 255 - alpha);
  });
}
