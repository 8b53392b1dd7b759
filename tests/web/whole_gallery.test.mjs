// SPDX-License-Identifier: Apache-2.0
// The gallery of the whole sample archive (VITRINE_WEB_GALLERY, of VITRINE_WEB_ARCHIVE) as `vitrine serve` (VITRINE) gives it to visitors.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { blockMeans, bytesUntilFirst, cardOf, decoded, MOST_FIRST, mse1e4, openGallery, overWhite, pixels, shiftOf, shown } from './gallery_page.mjs';

const SIDE = 200; // pixels of a picture
const { VITRINE: program, VITRINE_WEB_GALLERY: folder, VITRINE_WEB_ARCHIVE: archive } = process.env;
const { objects, page: weight } = JSON.parse(fs.readFileSync(path.join(folder, 'gallery.json'), 'utf8'));
const { rows } = JSON.parse(fs.readFileSync(path.join(folder, 'report.json'), 'utf8'));
const lines = fs.readFileSync(path.join(archive, 'archive.csv'), 'utf8').trim().split(/\r?\n/);

let server, page, complaints, close;

// The first view as the measure draws it: the original, the thumbnail, and how far apart they are.
async function measured({ thumb }) {
  const { input } = rows.find((row) => row.thumb === thumb);
  const up = lines.find((line) => line.startsWith(`${input},`)).split(',').at(-1);
  const sheet = path.join(os.tmpdir(), `sheet-${process.pid}.png`);
  const asked = ['--count', '1', '--up', up, '--json', '--sheet', sheet];
  const { views: [{ mse1e4: error }] } = JSON.parse(execFileSync(program, ['evaluate', path.join(archive, input), path.join(folder, thumb), ...asked]));
  const pictures = await decoded(page, `data:image/png;base64,${fs.readFileSync(sheet, 'base64')}`);
  fs.rmSync(sheet);
  const [original, thumbnail] = [0, 1].map((column) => pictures.filter((_, i) => Math.floor(i / 4 / SIDE) % 3 === column)); // a difference follows
  return { original, thumbnail, error };
}

// The address that the program prints.
async function started() {
  server = spawn(program, ['serve', folder, '--port', '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  for await (const chunk of server.stdout) return /http:\S+\//.exec(String(chunk))[0];
}

before(async () => { ({ page, complaints, close } = await openGallery(folder, { url: await started() })); });
after(async () => {
  await close?.();
  server?.kill();
});

test('every object is there, with what archive.csv says of it', async () => {
  assert.equal(await page.locator('.card').count(), objects.length);
  assert.ok(objects.length >= 10 && lines.length > objects.length / 2);
  for (const { slug, title, metadata } of objects) {
    const text = await page.locator(`[id="${slug}"]`).textContent();
    for (const value of [title, metadata.credit, metadata.licence]) if (value) assert.ok(text.includes(value), `${text} lacks ${value}`);
  }
  const told = objects.filter(({ title, metadata }) => lines.some((line) => line.includes(title) && line.includes(metadata.credit)));
  assert.ok(told.length >= lines.length - 1, `${told.length} of ${lines.length - 1} lines are shown`);
});

test('each first picture is its poster, and nothing moves on the way', async () => {
  for (const object of objects) {
    const card = cardOf(page, object);
    await shown(card);
    const error = mse1e4(blockMeans(overWhite(await pixels(card))), blockMeans(await decoded(page, object.poster)));
    assert.ok(error < 0.5, `${object.slug}: ${error} from its poster`);
  }
  assert.ok(await shiftOf(page) < 0.02);
});

test('each first picture is the one that its certificate was measured on', async () => {
  for (const object of objects) {
    await shown(cardOf(page, object));
    const picture = overWhite(await pixels(cardOf(page, object)));
    const { original, thumbnail, error } = await measured(object);
    assert.ok(mse1e4(picture, thumbnail) < 0.1, `${object.slug}: ${mse1e4(picture, thumbnail)} from the measure's picture`);
    const found = mse1e4(picture, original);
    assert.ok(Math.abs(found - error) < Math.max(0.05, 0.05 * error), `${object.slug}: ${found} from its original, measured ${error}`);
  }
});

test('nothing fails and no other host is asked', () => assert.deepEqual(complaints, []));

test('the first object is there after 350 KB; the decoder is asked for ahead, and nothing twice', async () => {
  const packed = await openGallery(folder, { gzip: true });
  const bytes = await bytesUntilFirst(packed.page);
  assert.ok(bytes > 200e3 && bytes <= MOST_FIRST, `${bytes} bytes`);
  const asked = await packed.page.evaluate(() => performance.getEntriesByType('resource').map(({ name, initiatorType }) => ({ name, by: initiatorType })));
  const by = (file) => asked.filter(({ name }) => name.endsWith(file)).map((one) => one.by);
  for (const file of ['gallery.json', ...weight.decoder.files]) assert.deepEqual(by(file), ['link'], file);
  assert.equal(by('vitrine-thumbnail.js').length, 1);
  await packed.close();
});
