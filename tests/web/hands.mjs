// SPDX-License-Identifier: Apache-2.0
// A gallery of small known thumbnails of all profiles, and hands on its cards.
import fs from 'node:fs';
import path from 'node:path';
import { glbs } from './fixtures.mjs';
import { cardAt, openGallery, pictureOf, shown, writeGallery } from './gallery_page.mjs';

export const LINK = 'https://museum.example/view?eye={eye}&from={azimuth}';

// Some of all, and those that are looked at.
export const files = glbs().filter((file, i) => i % 6 === 0 || /\/(cube|unlit|painted_facets)[^/]*$/.test(file));
export const place = (name) => files.findIndex((file) => path.basename(file).startsWith(name));

// Opens it; the first object has this metadata.
export async function openHands(metadata = {}) {
  const gallery = writeGallery(files.map((file, i) => ({
    slug: `object-${i}`, title: `${String(i).padStart(2, '0')} ${path.basename(file)}`, thumb: `models/${i}.glb`, poster: '',
    bytes: fs.statSync(file).size, triangles: 100 - i, mse1e4: (i * 7) % 5, metadata: i === 0 ? metadata : { link: 'javascript:alert(1)' },
  })));
  fs.mkdirSync(path.join(gallery, 'models'));
  files.forEach((file, i) => fs.copyFileSync(file, path.join(gallery, `models/${i}.glb`)));
  const { page, complaints, close } = await openGallery(gallery);
  await page.waitForFunction((count) => document.querySelectorAll('.card').length === count, files.length);
  return { gallery, page, complaints, close: async () => { await close(); fs.rmSync(gallery, { recursive: true }); } };
}

// The card, which has the focus and its first view, and the middle of its picture on the screen.
export async function handsOn(page, index) {
  const card = cardAt(page, index);
  await shown(card);
  await pictureOf(card).focus();
  await page.keyboard.press('Home');
  const box = await pictureOf(card).boundingBox();
  return { card, box, x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

export async function drag(page, { x, y }, right, down) {
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + right, y + down, { steps: 4 });
  await page.mouse.up();
}
