// SPDX-License-Identifier: Apache-2.0
// A gallery of one object as `vitrine convert` leaves it (VITRINE_WEB_GALLERY): no decoder is worth it, so none is loaded.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import { bytesUntilFirst, openGallery, shown } from './gallery_page.mjs';

const folder = process.env.VITRINE_WEB_GALLERY;
const { objects: [object], page: weight } = JSON.parse(fs.readFileSync(path.join(folder, 'gallery.json'), 'utf8'));

test('one object is shown without Draco, and that is what the page says', async () => {
  const { page, complaints, close } = await openGallery(folder, { gzip: true });
  const card = page.locator('vitrine-thumbnail');
  await shown(card);
  assert.equal(await card.getAttribute('src'), object.plain.glb);
  assert.equal(await card.getAttribute('bytes'), String(object.plain.bytes));
  const loaded = await page.evaluate(() => performance.getEntriesByType('resource').map(({ name }) => name));
  assert.deepEqual(loaded.filter((name) => /draco|thumb\.glb/.test(name)), []);
  assert.ok(await bytesUntilFirst(page) < weight.viewer.gzip + weight.decoder.gzip + object.bytes);
  await page.click('#weight summary');
  const total = weight.viewer.gzip + object.plain.bytes;
  assert.equal(await page.locator('#weight tbody td').nth(1).textContent(), `${(total / 1e3).toFixed(1)} KB`);
  assert.deepEqual(complaints, []);
  await close();
});
