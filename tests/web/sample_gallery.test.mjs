// SPDX-License-Identifier: Apache-2.0
// A gallery as `vitrine convert --series` leaves it (VITRINE_WEB_GALLERY): what visitors load, see and can switch to.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { bytesUntilFirst, cardOf, change, choose, decoded, MOST_FIRST, mse1e4, openGallery, overWhite, pictureOf, pixels, shiftOf, shown } from './gallery_page.mjs';

const folder = process.env.VITRINE_WEB_GALLERY;
const { objects, page: weight } = JSON.parse(fs.readFileSync(path.join(folder, 'gallery.json'), 'utf8'));

let page, complaints, close;

before(async () => { ({ page, complaints, close } = await openGallery(folder, { gzip: true })); });
after(async () => { await close?.(); });

test('gallery.json has what is documented', () => {
  const documented = fs.readFileSync(new URL('../../docs/outputs.md', import.meta.url), 'utf8').split('\n## gallery.json\n')[1].split('\n## ')[0];
  const keys = documented.match(/^\| `[^|]+/gm).flatMap((row) => [...row.matchAll(/`(\w+)`/g)].map(([, key]) => key));
  for (const object of objects) assert.deepEqual(Object.keys(object).sort(), [...keys].sort());
  for (const key of Object.keys(weight)) assert.ok(documented.includes(`\`${key}\``), key);
});

test('the first object is there after 350 KB', async () => {
  const bytes = await bytesUntilFirst(page);
  assert.ok(bytes > 200e3 && bytes <= MOST_FIRST, `${bytes} bytes`);
});

test('posters stand at their final size, and nothing moves', async () => {
  for (const object of objects) await shown(cardOf(page, object));
  const shift = await shiftOf(page);
  assert.ok(shift < 0.02, `layout shift ${shift}`);
});

test('the first picture is the poster, and as near to the original as the certificate says', async () => {
  for (const object of objects) {
    const card = cardOf(page, object);
    await shown(card);
    const picture = await pixels(card);
    assert.equal(picture.side, 200);
    const drawn = overWhite(picture);
    const poster = mse1e4(drawn, await decoded(page, object.poster));
    assert.ok(poster < 3, `${object.slug}: ${poster} from its poster, a JPEG`);
    const certificate = JSON.parse(fs.readFileSync(path.join(folder, `models/${object.slug}/certificate.json`), 'utf8'));
    const original = mse1e4(drawn, await decoded(page, object.series.manifest.replace('series.json', 'frame-00-00.jpg')));
    assert.ok(original < certificate.measure.worstMse1e4 + 2, `${object.slug}: ${original} from its original`);
  }
});

test('a card switches to pictures of one axis and of two, and says what they cost', async () => {
  const [object] = objects;
  const card = cardOf(page, object);
  await shown(card);
  const facts = () => card.locator('[part="facts"]').textContent();
  const threeD = [await facts(), await pixels(card)];
  await card.getByRole('button', { name: '1 axis' }).click();
  await page.waitForFunction(([e, old]) => e.shadowRoot.querySelector('[part="facts"]').textContent !== old, [await card.elementHandle(), threeD[0]]);
  const manifest = JSON.parse(fs.readFileSync(path.join(folder, object.series.manifest), 'utf8'));
  const one = manifest.files.slice(0, manifest.frames).reduce((sum, { bytes }) => sum + bytes, 0);
  await page.waitForTimeout(300);
  assert.equal(await facts(), `${(one / 1e3).toFixed(1)} KB, error ${manifest.turningMse1e4.toFixed(2)}`);
  const frame = await pixels(card);
  assert.ok(mse1e4(frame.data, await decoded(page, object.series.manifest.replace('series.json', 'frame-00-00.jpg'))) === 0);
  const hand = await pictureOf(card).boundingBox();
  const drag = async (right, down) => {
    await page.mouse.move(hand.x + 100, hand.y + 100);
    await page.mouse.down();
    await page.mouse.move(hand.x + 100 + right, hand.y + 100 + down, { steps: 3 });
    await page.mouse.up();
    return pixels(card);
  };
  const turned = await drag(60, 0);
  assert.ok(change(frame, turned) > 0.02);
  assert.equal(change(turned, await drag(0, 60)), 0, 'one axis has no second');
  await card.getByRole('button', { name: '2 axes' }).click();
  assert.ok(change(turned, await pixels(card)) > 0.02);
  assert.equal(await facts(), `${(object.series.bytes / 1e3).toFixed(1)} KB, error ${manifest.turningMse1e4.toFixed(2)}`);
  await card.getByRole('button', { name: '3D' }).click();
  await pictureOf(card).focus();
  await page.keyboard.press('Home');
  await shown(card);
  assert.ok(change(threeD[1], await pixels(card)) < 0.001);
});

test('"Show as" goes for every card', async () => {
  const texts = () => Promise.all(objects.map((object) => cardOf(page, object).locator('[part="facts"]').textContent()));
  const pictures = async () => {
    const seen = [];
    for (const object of objects) {
      await shown(cardOf(page, object));
      seen.push(await pixels(cardOf(page, object)));
    }
    return seen;
  };
  const [before, facts] = [await pictures(), await texts()];
  for (const view of ['series', 'series-2']) {
    await choose(page, 'select[name="view"]', view);
    const seen = await pictures();
    for (const [i, object] of objects.entries())
      assert.equal(mse1e4(seen[i].data, await decoded(page, object.series.manifest.replace('series.json', 'frame-00-00.jpg'))), 0, `${view} of ${object.slug}`);
    (await texts()).forEach((text, i) => assert.notEqual(text, facts[i]));
    assert.equal(await page.getByRole('button', { name: 'Zoom in' }).count(), 0, 'pictures have no surface, light or zoom');
  }
  await choose(page, 'select[name="view"]', '3d');
  (await pictures()).forEach((one, i) => assert.ok(change(before[i], one) < 0.001));
  assert.deepEqual(await texts(), facts);
});

test('the page says what it weighs', async () => {
  await page.click('#weight summary');
  const rows = await page.locator('#weight tbody tr').evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
  const total = weight.thumbnails + weight.viewer.gzip + weight.decoder.gzip;
  assert.equal(rows[0][2], `${(total / 1e3).toFixed(1)} KB`);
  const jpeg = rows.find(([name]) => name.startsWith('32 pictures, JPEG'));
  assert.equal(jpeg[2], weight.series.jpeg90[32] < 999950 ? `${(weight.series.jpeg90[32] / 1e3).toFixed(1)} KB` : `${(weight.series.jpeg90[32] / 1e6).toFixed(1)} MB`);
  await page.getByText(/first object was there after [\d.]+ s; decoding one took \d+ ms/).waitFor();
  const { visits } = weight.measured; // of tools/page_speed.mjs
  const waits = await page.locator('table').nth(1).locator('tbody tr').evaluateAll((all) => all.map((row) => row.children[3].textContent));
  assert.deepEqual(visits.map(({ view, megabits }) => [view, megabits]), ['3d', 'series'].flatMap((view) => [1.6, 10, 50].map((line) => [view, line])));
  visits.forEach(({ first }, i) => assert.ok(first > 0 && Math.abs(parseFloat(waits[i]) / first - 1) < 0.1, `${waits[i]} for ${first}`));
  assert.ok(visits[0].bytes.first > visits[3].bytes.first + weight.decoder.gzip / 2, 'pictures need no decoder');
});

test('nothing moves by itself where that is not wanted', async () => {
  const duration = () => page.evaluate(() => getComputedStyle(document.querySelector('vitrine-thumbnail').shadowRoot.querySelector('[part="tools"]')).transitionDuration);
  assert.equal(await duration(), '0.15s');
  await page.emulateMedia({ reducedMotion: 'reduce' });
  assert.equal(await duration(), '0s');
});

test('on a touch screen the tools come with the first tap, which presses none of them', async () => {
  const touch = await openGallery(folder, { width: 400, hasTouch: true, isMobile: true });
  const card = touch.page.locator('vitrine-thumbnail').first();
  await shown(card);
  const tools = card.locator('[part="tools"]');
  const { x, y, height } = await tools.boundingBox();
  const tap = () => touch.page.touchscreen.tap(x + 30, y + height / 2);
  assert.equal(await tools.evaluate((e) => getComputedStyle(e).pointerEvents), 'none');
  await tap();
  assert.equal(await card.getAttribute('mode'), null);
  await touch.page.waitForFunction((e) => getComputedStyle(e).opacity === '1' && getComputedStyle(e).pointerEvents === 'auto', await tools.elementHandle());
  await tap();
  assert.equal(await card.getAttribute('mode'), 'white');
  await touch.close();
});

test('without script there are posters with names', async () => {
  const silent = await openGallery(folder, { javaScriptEnabled: false });
  const images = silent.page.locator('figure img');
  assert.equal(await images.count(), objects.length);
  assert.deepEqual(new Set(await images.evaluateAll((all) => all.map((image) => image.alt))), new Set(objects.map(({ title }) => title)));
  await images.first().scrollIntoViewIfNeeded();
  await silent.page.waitForFunction(() => document.querySelector('figure img').naturalWidth === 200);
  await silent.close();
});

test('nothing fails and no other host is asked', () => assert.deepEqual(complaints, []));
