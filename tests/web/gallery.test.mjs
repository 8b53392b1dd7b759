// SPDX-License-Identifier: Apache-2.0
// The gallery page as built (VITRINE_VIEWER), over thumbnails of all profiles, in a browser that reaches nothing else: what hands do
// to a card is seen in its pixels.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { glbs } from './fixtures.mjs';
import { cardAt, change, drawn, middle, openGallery, pictureOf, pixels, shown, writeGallery } from './gallery_page.mjs';

const HOSTILE = '<img src=x onerror="document.title=\'broken in\'">';
const LINK = 'https://museum.example/view?eye={eye}&from={azimuth}';

// Some of all, and those that are looked at below.
const files = glbs().filter((file, i) => i % 6 === 0 || /\/(cube|unlit|painted_facets)[^/]*$/.test(file));
const place = (name) => files.findIndex((file) => path.basename(file).startsWith(name));
let gallery, page, complaints, close;

before(async () => {
  gallery = writeGallery(files.map((file, i) => ({
    slug: `object-${i}`, title: `${String(i).padStart(2, '0')} ${path.basename(file)}`, thumb: `models/${i}.glb`, poster: '',
    bytes: fs.statSync(file).size, triangles: 100 - i, mse1e4: (i * 7) % 5, metadata: i === 0 ? { credit: HOSTILE, licence: 'CC0-1.0', link: LINK } : { link: 'javascript:alert(1)' },
  })));
  fs.mkdirSync(path.join(gallery, 'models'));
  files.forEach((file, i) => fs.copyFileSync(file, path.join(gallery, `models/${i}.glb`)));
  ({ page, complaints, close } = await openGallery(gallery));
  await page.waitForFunction((count) => document.querySelectorAll('.card').length === count, files.length);
});

after(async () => {
  await close?.();
  if (gallery) fs.rmSync(gallery, { recursive: true });
});

// The card and the middle of its picture on the screen, after a reset.
async function handsOn(index) {
  const card = cardAt(page, index);
  await shown(card);
  await pictureOf(card).focus();
  await page.keyboard.press('Home');
  const box = await pictureOf(card).boundingBox();
  return { card, box, x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

async function drag({ x, y }, right, down) {
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + right, y + down, { steps: 4 });
  await page.mouse.up();
}

test('every card gets its picture', async () => {
  for (let i = 0; i < files.length; ++i) {
    await shown(cardAt(page, i));
    const { data } = await drawn(cardAt(page, i));
    const filled = data.filter((value, k) => k % 4 === 3 && value > 0).length / (data.length / 4);
    assert.ok(filled > 0.03, `${files[i]} fills ${filled}`);
  }
});

test('names are text, and only links to the web are links', async () => {
  assert.match(await page.locator('.card').first().textContent(), /<img src=x/);
  assert.notEqual(await page.title(), 'broken in');
  assert.equal(await page.locator('.card a').count(), 1);
});

test('dragging turns an object and no other; across and down differ', async () => {
  const hands = await handsOn(place('painted_facets'));
  const other = cardAt(page, place('painted_facets') + 1);
  const before = [await pixels(hands.card), await pixels(other)];
  await drag(hands, 40, 0);
  const turned = await pixels(hands.card);
  assert.ok(change(before[0], turned) > 0.05);
  assert.equal(change(before[1], await pixels(other)), 0);
  assert.deepEqual(await hands.card.evaluate((e) => [e.camera.azimuth, e.camera.elevation]), [324, 10]);
  await drag(hands, 0, 40);
  assert.ok(change(turned, await pixels(hands.card)) > 0.05);
  assert.equal(await hands.card.evaluate((e) => e.camera.elevation), 46);
});

test('on the turntable up stays up, freely turned it does not', async () => {
  const hands = await handsOn(place('cube'));
  const up = () => hands.card.evaluate((e) => e.camera.up[1]);
  await drag(hands, 0, 95);
  await drag(hands, 0, 95);
  assert.ok(await up() > 0);
  await page.keyboard.press('Home');
  await hands.card.getByRole('button', { name: 'Rotate freely' }).click();
  await drag(hands, 0, 95);
  await drag(hands, 0, 95);
  assert.ok(await up() < -0.5);
  await hands.card.getByRole('button', { name: 'Rotate freely' }).click();
  assert.ok(await up() > 0);
});

test('keys turn and zoom, and say where one is', async () => {
  const { card } = await handsOn(place('cube'));
  const before = await pixels(card);
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowLeft');
  assert.equal(await pictureOf(card).getAttribute('aria-valuetext'), '23 degrees around, 10 above');
  assert.ok(change(before, await pixels(card)) > 0.02);
  await page.keyboard.press('+');
  const zoomed = await pixels(card);
  await page.keyboard.press('Home');
  assert.ok(change(before, await pixels(card)) < 0.001);
  assert.ok(change(before, zoomed) > 0.1);
});

test('the wheel scrolls the page, and zooms where a picture has been chosen', async () => {
  const hands = await handsOn(place('cube'));
  await page.mouse.move(hands.x, hands.y);
  await page.mouse.wheel(0, -200);
  await page.waitForFunction((e) => e.orbit.zoom > 1.2, await hands.card.elementHandle());
  const scroll = await page.evaluate(() => scrollY);
  await page.evaluate(() => /** @type {any} */ (document.activeElement).blur());
  await page.mouse.wheel(0, 50);
  await page.waitForFunction((before) => scrollY !== before, scroll);
});

test('one finger turns', async () => {
  const { card, x, y } = await handsOn(place('painted_facets'));
  const before = await pixels(card);
  const client = await page.context().newCDPSession(page);
  const touch = (type, points) => client.send('Input.dispatchTouchEvent', { type, touchPoints: points });
  await touch('touchStart', [{ x, y }]);
  for (const right of [20, 40]) await touch('touchMove', [{ x: x + right, y }]);
  await touch('touchEnd', []);
  assert.ok(change(before, await pixels(card)) > 0.05);
  assert.equal(await card.evaluate((e) => e.camera.azimuth), 324);
});

test('two fingers zoom', async () => {
  const { card, x, y } = await handsOn(place('cube'));
  const client = await page.context().newCDPSession(page);
  const touch = (type, apart) => client.send('Input.dispatchTouchEvent', { type, touchPoints: apart === null ? [] : [{ x: x - apart, y, id: 0 }, { x: x + apart, y, id: 1 }] });
  await touch('touchStart', 20);
  for (const apart of [30, 40, 50]) await touch('touchMove', apart);
  await touch('touchEnd', null);
  assert.ok(Math.abs(await card.evaluate((e) => e.orbit.zoom) - 2.5) < 0.2);
});

test('white has no hue', async () => {
  const { card } = await handsOn(place('painted_facets'));
  const hue = ({ data }) => data.reduce((most, value, i) => (i % 4 === 3 ? most : Math.max(most, Math.abs(value - data[i - (i % 4)]))), 0);
  assert.ok(hue(await pixels(card)) > 30);
  await card.getByRole('button', { name: 'Surface: shaded' }).click();
  const white = await pixels(card);
  assert.ok(hue(white) <= 1);
  assert.ok(new Set(white.data.filter((_, i) => i % 4 === 0)).size > 10, 'it is shaded');
  await page.keyboard.press('m');
  await page.keyboard.press('m');
});

test('the normal mode shows the normal of a flat patch', async () => {
  const { card } = await handsOn(place('unlit'));
  await page.selectOption('select[name="mode"]', 'normals');
  // Seen from 10 degrees above, a patch that faces +Z points a little downwards.
  const expected = [127.5, 127.5 * (1 - Math.sin(Math.PI / 18)), 127.5 * (1 + Math.cos(Math.PI / 18))];
  const found = middle(await pixels(card));
  expected.forEach((value, k) => assert.ok(Math.abs(value - found[k]) <= 2, `${found}, expected ${expected}`));
  await page.selectOption('select[name="mode"]', 'shaded');
});

test('the light follows the pointer, and returns', async () => {
  const hands = await handsOn(place('painted_facets'));
  await page.mouse.move(1, 1);
  const ahead = await pixels(hands.card);
  await page.keyboard.press('l');
  await page.mouse.move(hands.box.x + 10, hands.y);
  const left = await pixels(hands.card);
  await page.mouse.move(hands.box.x + hands.box.width - 10, hands.y);
  const right = await pixels(hands.card);
  await page.mouse.move(1, 1);
  assert.ok(change(left, right, 20) > 0.1);
  const half = ({ side, data }, right) => data.reduce((sum, value, i) => sum + (i % 4 < 3 && ((i >> 2) % side >= side / 2) === right ? value : 0), 0);
  assert.ok(half(left, false) > 1.2 * half(right, false) && half(right, true) > 1.2 * half(left, true), 'the lit side is the pointer\'s');
  assert.ok(change(ahead, await pixels(hands.card)) < 0.001);
  await page.keyboard.press('l');
});

test('search and sort', async () => {
  const titles = () => page.locator('.card h2').allTextContents();
  await page.fill('#search', 'cube');
  assert.ok((await titles()).every((title) => title.includes('cube')));
  assert.match(await page.textContent('#summary'), new RegExp(`of ${files.length}`));
  await page.fill('#search', 'no such thing');
  assert.equal(await page.textContent('#summary'), 'No object fits.');
  await page.fill('#search', '');
  await page.selectOption('#sort', 'triangles');
  const byTriangles = await titles();
  assert.deepEqual(byTriangles, [...byTriangles].sort().reverse());
  await page.click('#order');
  assert.deepEqual(await titles(), [...byTriangles].reverse());
  await page.click('#order');
  await page.selectOption('#sort', 'bytes');
  const bytes = await page.locator('vitrine-thumbnail').evaluateAll((all) => all.map((e) => Number(e.getAttribute('bytes'))));
  assert.deepEqual(bytes, [...bytes].sort((a, b) => a - b));
  await page.selectOption('#sort', 'error');
  const errors = await page.locator('vitrine-thumbnail').evaluateAll((all) => all.map((e) => Number(e.getAttribute('error'))));
  assert.deepEqual(errors, [...errors].sort((a, b) => a - b));
  await page.selectOption('#sort', 'name');
  assert.deepEqual(await titles(), [...byTriangles].sort());
});

test('what is chosen above goes for every card', async () => {
  const states = async () => [...new Set(await page.locator('vitrine-thumbnail').evaluateAll((all) =>
    all.map((e) => [e.mode, e.getAttribute('rotation'), e.getAttribute('light')].join(' '))))];
  await page.selectOption('select[name="mode"]', 'white');
  await page.check('input[name="rotation"]');
  await page.check('input[name="light"]');
  assert.deepEqual(await states(), ['white free pointer']);
  await page.selectOption('select[name="mode"]', 'shaded');
  await page.uncheck('input[name="rotation"]');
  await page.uncheck('input[name="light"]');
  assert.deepEqual(await states(), ['shaded  ']);
});

test('the link to the full model takes the camera along', async () => {
  const { card } = await handsOn(0);
  await page.keyboard.press('ArrowLeft');
  const href = await page.locator('.card a').getAttribute('href');
  const eye = await card.evaluate((e) => e.camera.eye);
  const found = new URL(href).searchParams.get('eye').split(',').map(Number);
  eye.forEach((value, k) => assert.ok(Math.abs(value - found[k]) < 1e-3));
  assert.equal(new URL(href).searchParams.get('from'), '11');
});

test('one WebGL context serves all cards', async () => {
  assert.equal(await page.evaluate(() => window.contexts), 1);
});

test('nothing fails and no other host is asked', () => assert.deepEqual(complaints, []));

test('a thumbnail that cannot be read costs its own card only', async () => {
  fs.writeFileSync(path.join(gallery, 'models/0.glb'), 'not a model');
  await page.reload();
  await page.locator('vitrine-thumbnail[problem]').waitFor();
  await shown(cardAt(page, 1));
  assert.match(await cardAt(page, 0).locator('[part="facts"]').textContent(), /^Cannot be shown/);
  assert.equal(await page.locator('vitrine-thumbnail[problem]').count(), 1);
});
