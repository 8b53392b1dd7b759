// SPDX-License-Identifier: Apache-2.0
// What is loaded when, seen on the screen, while each model waits until the test lets it through: posters stand, the nearest two are
// asked for, the card that is pointed at has not to wait for its turn, and what leaves gives back its place.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { after, before, test } from 'node:test';
import { serve } from './browser.mjs';
import { glbs } from './fixtures.mjs';
import { cardAt, decoded, openGallery, pictureOf, shown, writeGallery } from './gallery_page.mjs';

const COUNT = 40, AT_ONCE = 2;
// One red pixel: no model here has that colour.
const POSTER = 'iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR42mP4z8AAAAMBAQD3A0FDAAAAAElFTkSuQmCC';

let gallery, server, page, complaints, close;
const asked = []; // numbers of cards, in the order of their requests
const waiting = new Map();
let held = true;

before(async () => {
  const model = fs.readFileSync(glbs().find((file) => file.endsWith('/cube.web.glb')));
  const numbers = Array.from({ length: COUNT }, (_, i) => i);
  gallery = writeGallery(numbers.map((i) => ({
    slug: `object-${i}`, title: `Object ${i}`, thumb: `${i}.glb`, poster: 'poster.png', bytes: model.length, triangles: 12, metadata: {},
  })));
  fs.writeFileSync(`${gallery}/poster.png`, Buffer.from(POSTER, 'base64'));
  const answers = Object.fromEntries(numbers.map((i) => [`/${i}.glb`, () => {
    asked.push(i);
    return held ? new Promise((done) => waiting.set(i, () => done(model))) : model;
  }]));
  server = await serve({ '/': gallery }, { answers });
  ({ page, complaints, close } = await openGallery(gallery, { width: 1000, url: `${server.url}/` }));
});

after(async () => {
  await close?.();
  await server?.close();
  if (gallery) fs.rmSync(gallery, { recursive: true });
});

async function until(is) {
  for (const deadline = Date.now() + 60e3; !is(); await new Promise((done) => setTimeout(done, 10)))
    if (Date.now() > deadline) throw new Error(`never: ${is}`);
}

const letThrough = (i) => {
  waiting.get(i)();
  waiting.delete(i);
};

// Share of the card's picture, its tools apart, that is its poster on the screen.
async function posterOn(i) {
  const { x, y, width, height } = await pictureOf(cardAt(page, i)).boundingBox();
  const shot = await page.screenshot({ clip: { x: x + 2, y: y + 2, width: width - 4, height: height - 40 } });
  const data = await decoded(page, `data:image/png;base64,${shot.toString('base64')}`);
  let red = 0;
  for (let k = 0; k < data.length; k += 4) red += data[k] > 250 && data[k + 1] < 5;
  return red / (data.length / 4);
}

// The card comes through before its neighbour, which is a poster still.
async function comesFirst(i, neighbour = i + 1) {
  await until(() => waiting.has(i));
  letThrough(i);
  await shown(cardAt(page, i));
  assert.equal(await posterOn(i), 0, `card ${i} is in 3D`);
  assert.equal(await posterOn(neighbour), 1, `card ${neighbour} is not`);
}

test('posters stand while two models are on their way', async () => {
  await until(() => asked.length >= AT_ONCE);
  for (let i = 0; i < 8; ++i) assert.equal(await posterOn(i), 1);
  assert.equal(asked.length, AT_ONCE);
  assert.ok(asked.every((i) => i < 12), `${asked} are near the middle of the page`);
});

test('a card that is pointed at becomes 3D at once', async () => {
  const i = [0, 2].find((one) => !asked.includes(one));
  const { x, y, width, height } = await pictureOf(cardAt(page, i)).boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await comesFirst(i);
  assert.equal(asked.length, AT_ONCE + 1);
});

test('so does one whose name, or tools, are pointed at', async () => {
  const name = await cardAt(page, 4).locator('h2').boundingBox();
  await page.mouse.move(name.x + 5, name.y + name.height / 2);
  await comesFirst(4);
  const { x, y, width, height } = await pictureOf(cardAt(page, 6)).boundingBox();
  await page.mouse.move(x + width / 2, y + height - 5);
  await comesFirst(6);
});

test('so does one that keys come to', async () => {
  await page.mouse.move(1, 1);
  await page.locator('footer a').focus();
  await until(() => asked.filter((i) => i > 20).length === AT_ONCE);
  await page.keyboard.press('Shift+Tab');
  await comesFirst(COUNT - 1, COUNT - 2);
});

test('what has left is a poster when it comes back, and loads again', async () => {
  waiting.clear();
  await page.mouse.wheel(0, -1e5);
  await page.waitForFunction(() => scrollY === 0);
  await until(() => waiting.size === AT_ONCE);
  for (let i = 0; i < 8; ++i) assert.equal(await posterOn(i), 1);
  held = false;
  for (const i of waiting.keys()) letThrough(i);
  for (let i = 0; i < 8; ++i) {
    await shown(cardAt(page, i));
    assert.equal(await posterOn(i), 0);
  }
});

test('nothing fails and no other host is asked', () => assert.deepEqual(complaints, []));
