// SPDX-License-Identifier: Apache-2.0
// The gallery page as built (VITRINE_VIEWER), over thumbnails of all profiles, in a browser that reaches nothing else: what hands do
// to a card is seen in its pixels.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { cardAt, change, choose, coverage, drawn, hue, middle, pictureOf, pixels, shown } from './gallery_page.mjs';
import { drag, files, handsOn, LINK, openHands, place } from './hands.mjs';

let gallery, page, complaints, close;

before(async () => { ({ gallery, page, complaints, close } = await openHands({ credit: '<img src=x onerror="document.title=\'broken in\'">', licence: 'CC0-1.0', link: LINK })); });
after(() => close?.());

test('every card gets its picture', async () => {
  for (let i = 0; i < files.length; ++i) {
    await shown(cardAt(page, i));
    const filled = coverage(await drawn(cardAt(page, i)));
    assert.ok(filled > 0.03, `${files[i]} fills ${filled}`);
  }
});

test('names are text, and only links to the web are links', async () => {
  assert.match(await page.locator('.card').first().textContent(), /<img src=x/);
  assert.notEqual(await page.title(), 'broken in');
  assert.equal(await page.locator('.card a').count(), 1);
});

test('dragging turns an object and no other; across and down differ', async () => {
  const hands = await handsOn(page, place('painted_facets'));
  const other = cardAt(page, place('painted_facets') + 1);
  const before = [await pixels(hands.card), await pixels(other)];
  await drag(page, hands, 40, 0);
  const turned = await pixels(hands.card);
  assert.ok(change(before[0], turned) > 0.05);
  assert.equal(change(before[1], await pixels(other)), 0);
  assert.deepEqual(await hands.card.evaluate((e) => [e.camera.azimuth, e.camera.elevation]), [324, 10]);
  await drag(page, hands, 0, 40);
  assert.ok(change(turned, await pixels(hands.card)) > 0.05);
  assert.equal(await hands.card.evaluate((e) => e.camera.elevation), 46);
});

test('on the turntable up stays up, freely turned it does not', async () => {
  const hands = await handsOn(page, place('painted_facets'));
  const up = () => hands.card.evaluate((e) => e.camera.up[1]);
  await drag(page, hands, 0, 95);
  await drag(page, hands, 0, 95);
  assert.ok(await up() > 0);
  const above = await pixels(hands.card);
  await page.keyboard.press('Home');
  await hands.card.getByRole('button', { name: 'Rotate freely' }).click();
  await drag(page, hands, 0, 95);
  await drag(page, hands, 0, 95);
  assert.ok(await up() < -0.5);
  assert.ok(change(above, await pixels(hands.card)) > 0.1);
  await hands.card.getByRole('button', { name: 'Rotate freely' }).click();
  assert.ok(await up() > 0);
});

test('keys turn and zoom, and say where one is', async () => {
  const { card } = await handsOn(page, place('painted_facets'));
  const before = await pixels(card);
  const after = async (...keys) => {
    for (const key of ['Home', ...keys]) await page.keyboard.press(key);
    return pixels(card);
  };
  const left = await after('ArrowLeft', 'ArrowLeft');
  assert.equal(await pictureOf(card).getAttribute('aria-valuetext'), '23 degrees around, 10 above');
  const others = [left, await after('ArrowRight', 'ArrowRight'), await after('ArrowUp', 'ArrowUp'), await after('ArrowDown', 'ArrowDown'), await after('+'), await after('=', '=')];
  others.forEach((one, i) => [before, ...others.slice(0, i)].forEach((other) => assert.ok(change(one, other) > 0.05)));
  assert.ok(change(before, await after('+', '-')) < 0.001);
  assert.ok(change(before, await after()) < 0.001);
  await after('f', ...Array(8).fill('ArrowDown'));
  assert.ok(await card.evaluate((e) => e.camera.up[1]) < 0, 'freely turned, over the top');
  await page.keyboard.press('f');
  assert.ok(await card.evaluate((e) => e.camera.up[1]) > 0);
});

test('the wheel scrolls the page, and zooms where a picture has been chosen', async () => {
  const hands = await handsOn(page, place('cube'));
  const before = await pixels(hands.card);
  await page.mouse.move(hands.x, hands.y);
  await page.mouse.wheel(0, -200);
  await page.waitForFunction((e) => e.orbit.zoom > 1.2, await hands.card.elementHandle());
  assert.ok(coverage(await pixels(hands.card)) > 1.3 * coverage(before));
  const scroll = await page.evaluate(() => scrollY);
  await page.evaluate(() => /** @type {any} */ (document.activeElement).blur());
  await page.mouse.wheel(0, 50);
  await page.waitForFunction((before) => scrollY !== before, scroll);
});

test('one finger turns', async () => {
  const { card, x, y } = await handsOn(page, place('painted_facets'));
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
  const { card, x, y } = await handsOn(page, place('cube'));
  const before = await pixels(card);
  const client = await page.context().newCDPSession(page);
  const touch = (type, apart) => client.send('Input.dispatchTouchEvent', { type, touchPoints: apart === null ? [] : [{ x: x - apart, y, id: 0 }, { x: x + apart, y, id: 1 }] });
  await touch('touchStart', 20);
  for (const apart of [30, 40, 50]) await touch('touchMove', apart);
  await touch('touchEnd', null);
  assert.ok(Math.abs(await card.evaluate((e) => e.orbit.zoom) - 2.5) < 0.2);
  assert.ok(coverage(await pixels(card)) > 2 * coverage(before));
});

test('white has no hue', async () => {
  const { card } = await handsOn(page, place('painted_facets'));
  assert.ok(hue(await pixels(card)) > 30);
  await card.getByRole('button', { name: 'Surface: shaded' }).click();
  const white = await pixels(card);
  assert.ok(hue(white) <= 1);
  assert.ok(new Set(white.data.filter((_, i) => i % 4 === 0)).size > 10, 'it is shaded');
  await page.keyboard.press('m');
  await page.keyboard.press('m');
});

test('the normal mode shows the normal of a flat patch', async () => {
  await choose(page, 'select[name="mode"]', 'normals');
  const { card } = await handsOn(page, place('unlit'));
  // Seen from 10 degrees above, a patch that faces +Z points a little downwards.
  const expected = [127.5, 127.5 * (1 - Math.sin(Math.PI / 18)), 127.5 * (1 + Math.cos(Math.PI / 18))];
  const found = middle(await pixels(card));
  expected.forEach((value, k) => assert.ok(Math.abs(value - found[k]) <= 2, `${found}, expected ${expected}`));
  await choose(page, 'select[name="mode"]', 'shaded');
});

test('the light follows the pointer, and returns', async () => {
  const hands = await handsOn(page, place('painted_facets'));
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

test('the link to the full model takes the camera along', async () => {
  const { card } = await handsOn(page, 0);
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
