// SPDX-License-Identifier: Apache-2.0
// Every button of a card and every field of the gallery's form, used by mouse and keys; what they change about objects is seen in pixels.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { cardAt, change, choose, coverage, hue, middle, pixels, shown } from './gallery_page.mjs';
import { drag, files, handsOn, openHands, place } from './hands.mjs';

let page, complaints, close;

before(async () => { ({ page, complaints, close } = await openHands()); });
after(() => close?.());

const PAINTED = place('painted_facets');
const press = (card, name) => card.getByRole('button', { name }).click();
const MODES = [['shaded', 'white'], ['white', 'normals'], ['normals', 'shaded']];

// Share of the pixels that differ much between the pointer at the picture's left and at its right.
async function litFrom({ card, box, y }) {
  const pictures = [];
  for (const x of [box.x + 10, box.x + box.width - 10]) {
    await page.mouse.move(x, y);
    pictures.push(await pixels(card));
  }
  return change(...pictures, 20);
}

// What is seen after a hand has turned the object over the top, where a turntable stops.
async function overTheTop(hands) {
  for (let i = 0; i < 2; ++i) await drag(page, hands, 0, 90);
  return pixels(hands.card);
}

test('zoom in, zoom out, reset', async () => {
  const hands = await handsOn(page, PAINTED);
  const first = await pixels(hands.card);
  await press(hands.card, 'Zoom in');
  await press(hands.card, 'Zoom in');
  assert.ok(coverage(await pixels(hands.card)) > 1.2 * coverage(first));
  await press(hands.card, 'Zoom out');
  await press(hands.card, 'Zoom out');
  assert.ok(change(first, await pixels(hands.card)) < 0.001);
  await drag(page, hands, 50, 30);
  assert.ok(change(first, await pixels(hands.card)) > 0.05);
  await press(hands.card, 'Reset');
  assert.ok(change(first, await pixels(hands.card)) < 0.001);
});

test('the surface goes round through its three modes', async () => {
  const { card } = await handsOn(page, PAINTED);
  const seen = {};
  for (const [mode] of MODES) {
    seen[mode] = await pixels(card);
    await press(card, `Surface: ${mode}`);
  }
  assert.ok(hue(seen.shaded) > 30 && hue(seen.white) <= 1);
  assert.ok(change(seen.normals, seen.shaded) > 0.3 && change(seen.normals, seen.white) > 0.3);
  assert.ok(change(seen.shaded, await pixels(card)) < 0.001);
});

test('a card turns freely, or not', async () => {
  const hands = await handsOn(page, PAINTED);
  const turntable = await overTheTop(hands);
  await press(hands.card, 'Reset');
  await press(hands.card, 'Rotate freely');
  assert.ok(change(turntable, await overTheTop(hands)) > 0.1);
  await press(hands.card, 'Rotate freely');
  await press(hands.card, 'Reset');
  assert.ok(change(turntable, await overTheTop(hands)) < 0.001);
});

test('the light of a card follows the pointer, or not', async () => {
  const hands = await handsOn(page, PAINTED);
  assert.equal(await litFrom(hands), 0);
  await press(hands.card, 'Light follows the pointer');
  assert.ok(await litFrom(hands) > 0.1);
  await press(hands.card, 'Light follows the pointer');
  assert.equal(await litFrom(hands), 0);
});

test('the surface chosen above goes for every card', async () => {
  const cards = [PAINTED, place('unlit')];
  const seen = {};
  for (const mode of ['white', 'normals', 'shaded']) {
    await choose(page, 'select[name="mode"]', mode);
    assert.deepEqual(new Set(await page.locator('vitrine-thumbnail').evaluateAll((all) => all.map((e) => e.mode))), new Set([mode]));
    seen[mode] = [];
    for (const i of cards) {
      await shown(cardAt(page, i));
      seen[mode].push(await pixels(cardAt(page, i)));
    }
  }
  for (const i of cards.keys()) {
    assert.ok(hue(seen.shaded[i]) > 30 && hue(seen.white[i]) <= 1);
    assert.ok(change(seen.normals[i], seen.shaded[i]) > 0.3 && change(seen.normals[i], seen.white[i]) > 0.3);
  }
  const [red, green, blue] = middle(seen.normals[1]);
  assert.ok(Math.abs(red - 127) < 3 && green < 115 && blue > 245, 'it faces the viewer, and points a little downwards');
});

test('rotation and light chosen above go for every card', async () => {
  const hands = await handsOn(page, PAINTED);
  const turntable = await overTheTop(hands);
  await page.getByLabel('Rotate freely').first().check();
  await page.getByLabel('Light follows the pointer').first().check();
  const states = () => page.locator('vitrine-thumbnail').evaluateAll((all) => [...new Set(all.map((e) => `${e.getAttribute('rotation')} ${e.getAttribute('light')}`))]);
  assert.deepEqual(await states(), ['free pointer']);
  for (const i of [PAINTED, PAINTED + 1]) assert.ok(await litFrom(await handsOn(page, i)) > 0.1);
  assert.ok(change(turntable, await overTheTop(await handsOn(page, PAINTED))) > 0.1);
  await page.getByLabel('Rotate freely').first().uncheck();
  await page.getByLabel('Light follows the pointer').first().uncheck();
  assert.deepEqual(await states(), [' ']);
  const again = await handsOn(page, PAINTED);
  assert.equal(await litFrom(again), 0);
  assert.ok(change(turntable, await overTheTop(again)) < 0.001);
});

test('search', async () => {
  const titles = () => page.locator('.card h2').allTextContents();
  await page.locator('#search').pressSequentially('CUBE web');
  assert.ok((await titles()).length > 0 && (await titles()).every((title) => /cube.*web/.test(title)));
  assert.match(await page.textContent('#summary'), new RegExp(`of ${files.length}`));
  await page.keyboard.press('x');
  assert.equal(await page.textContent('#summary'), 'No object fits.');
  await page.keyboard.press('Enter'); // sends no form
  for (let i = 0; i < 'CUBE webx'.length; ++i) await page.keyboard.press('Backspace');
  assert.equal((await titles()).length, files.length);
});

test('sort', async () => {
  const titles = () => page.locator('.card h2').allTextContents();
  const numbers = (name) => page.locator('vitrine-thumbnail').evaluateAll((all, attribute) => all.map((e) => Number(e.getAttribute(attribute))), name);
  const byName = await titles();
  assert.deepEqual(byName, [...byName].sort());
  await choose(page, '#sort', 'triangles');
  assert.deepEqual(await titles(), [...byName].reverse());
  await page.click('#order');
  assert.deepEqual(await titles(), byName);
  await page.click('#order');
  for (const name of ['bytes', 'error']) {
    await choose(page, '#sort', name);
    const found = await numbers(name);
    assert.deepEqual(found, [...found].sort((a, b) => a - b));
  }
  await choose(page, '#sort', 'name');
  assert.deepEqual(await titles(), byName);
});

test('nothing fails and no other host is asked', () => assert.deepEqual(complaints, []));
