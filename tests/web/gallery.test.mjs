// SPDX-License-Identifier: Apache-2.0
// The gallery page as built (VITRINE_VIEWER), over thumbnails of all profiles, below a sub-path, in a browser that reaches nothing else.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { openBrowser, serve } from './browser.mjs';
import { glbs } from './fixtures.mjs';

const HOSTILE = '<img src=x onerror="document.title=\'broken in\'">';

const files = glbs();
let gallery, server, browser, page;
const complaints = [];

function makeGallery() {
  fs.cpSync(process.env.VITRINE_VIEWER, path.join(gallery, 'viewer'), { recursive: true });
  fs.renameSync(path.join(gallery, 'viewer/index.html'), path.join(gallery, 'index.html'));
  fs.mkdirSync(path.join(gallery, 'models'));
  const objects = files.map((file, i) => {
    fs.copyFileSync(file, path.join(gallery, `models/${i}.glb`));
    return { slug: `${i}`, title: path.basename(file), thumb: `models/${i}.glb`, bytes: fs.statSync(file).size, triangles: 2, metadata: {} };
  });
  objects[0].title = HOSTILE;
  objects[0].metadata = { credit: HOSTILE, licence: 'CC0-1.0' };
  fs.writeFileSync(path.join(gallery, 'gallery.json'), JSON.stringify({ schema: 1, objects }));
}

// Share of a card's pixels that are not empty.
const filled = (card) => card.$eval('canvas', (canvas) => {
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let i = 3; i < data.length; i += 4) count += data[i] > 0;
  return count / (data.length / 4);
});

const picture = (card) => card.$eval('canvas', (canvas) => canvas.toDataURL());

before(async () => {
  gallery = fs.mkdtempSync(path.join(os.tmpdir(), 'gallery-'));
  makeGallery();
  server = await serve({ '/some/where/': gallery });
  browser = await openBrowser();
  page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  page.on('console', (message) => {
    if (message.type() === 'error' || message.text().startsWith('THREE.')) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('requestfailed', (request) => complaints.push(`failed: ${request.url()}`));
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
  });
  await page.goto(`${server.url}/some/where/index.html`);
});

after(async () => {
  await browser?.close();
  await server?.close();
  if (gallery) fs.rmSync(gallery, { recursive: true });
});

test('every object has a card, and every card gets its picture', async () => {
  await page.waitForFunction((count) => document.querySelectorAll('.card').length === count, files.length);
  for (const card of await page.$$('.card')) {
    await card.scrollIntoViewIfNeeded();
    const canvas = await card.$('canvas');
    await page.waitForFunction((c) => c.getContext('2d').getImageData(0, 0, c.width, c.height).data.some((x) => x > 0), canvas);
    assert.ok(await filled(card) > 0.05);
  }
});

test('names are text', async () => {
  assert.equal(await page.$eval('.card h2', (heading) => heading.textContent), HOSTILE);
  assert.equal(await page.$('img'), null);
  assert.notEqual(await page.title(), 'broken in');
});

test('dragging turns an object and no other', async () => {
  const [first, second] = await page.$$('.card');
  await first.scrollIntoViewIfNeeded();
  const before = [await picture(first), await picture(second)];
  const box = await (await first.$('canvas')).boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 40, box.y + box.height / 2, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction(([canvas, old]) => canvas.toDataURL() !== old, [await first.$('canvas'), before[0]]);
  assert.equal(await picture(second), before[1]);
});

test('one WebGL context serves all cards', async () => {
  assert.equal(await page.evaluate(() => window.contexts), 1);
});

test('nothing fails and no other host is asked', () => assert.deepEqual(complaints, []));

test('a thumbnail that cannot be read costs its own card only', async () => {
  const broken = path.join(gallery, 'models/0.glb');
  fs.writeFileSync(broken, 'not a model');
  await page.reload();
  await page.waitForSelector('.card .problem');
  const cards = await page.$$('.card');
  await page.waitForFunction((c) => c.getContext('2d').getImageData(0, 0, c.width, c.height).data.some((x) => x > 0), await cards[1].$('canvas'));
  assert.equal((await page.$$('.card .problem')).length, 1);
});
