// SPDX-License-Identifier: Apache-2.0
// <vitrine-thumbnail> by its demonstration in the gallery $VITRINE_WEB_GALLERY, in a page of somebody's own, and by docs/embedding.md.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { serve } from './browser.mjs';
import { cardAt, change, choose, openGallery, pictureOf, pixels, shown } from './gallery_page.mjs';

const folder = process.env.VITRINE_WEB_GALLERY;
const { objects } = JSON.parse(fs.readFileSync(path.join(folder, 'gallery.json'), 'utf8'));
const docs = fs.readFileSync(new URL('../../docs/embedding.md', import.meta.url), 'utf8');
const section = (title) => docs.split(`\n## ${title}\n`)[1].split('\n## ')[0];
const namesIn = (text) => [...text.matchAll(/`([^`]+)`/g)].map(([, name]) => name);
const firstColumn = (title) => section(title).match(/^\| `[^|]+/gm).flatMap(namesIn).sort();
const policy = section('Content security policy').match(/^ {4}.*$/gm).map((line) => line.trim()).join(' ');

let server, page, complaints, close, element;
const answers = {};

before(async () => {
  server = await serve({ '/some/where/': folder }, { answers });
  ({ page, complaints, close } = await openGallery(folder, { url: `${server.url}/some/where/` }));
  for (const i of objects.keys()) await shown(cardAt(page, i)); // who leaves earlier leaves textures half loaded
  await page.getByText('Put one into your own page').click();
  element = cardAt(page, 0);
  await page.getByText('vitrine-load').waitFor();
  await shown(element);
});

after(async () => {
  await close?.();
  await server?.close();
});

const told = (event) => page.locator('#events').getByText(event).waitFor();

test('the lines that it gives show the same object in any page, under the policy that is documented', async () => {
  const lines = await page.textContent('#code');
  assert.match(lines, /^<script type="module" src="\/some\/where\/viewer\/vitrine-thumbnail.js"><\/script>\n<vitrine-thumbnail/);
  const here = await pixels(element);
  answers['/mine.html'] = () => `<!doctype html><title>Mine</title><link rel="icon" href="data:,">
    <meta http-equiv="Content-Security-Policy" content="${policy}"><p>Before</p>${lines}<p>After</p>`;
  await page.goto(`${server.url}/mine.html`);
  await shown(element);
  assert.equal(change(here, await pixels(element)), 0);
  const scripts = await page.evaluate(() => performance.getEntriesByType('resource').map(({ name }) => name.split('/').at(-1)).filter((name) => /\.m?js$/.test(name)));
  assert.deepEqual(scripts, ['vitrine-thumbnail.js', 'draco_wasm_wrapper.js']);
  await page.goBack();
  await shown(element);
});

test('another object can be chosen, and has other lines', async () => {
  const [before, lines] = [await pixels(element), await page.textContent('#code')];
  await choose(page, '#object', '1');
  await told('vitrine-load');
  await shown(element);
  assert.ok(change(before, await pixels(element)) > 0.05);
  const others = await page.textContent('#code');
  assert.ok(others !== lines && others.includes(`src="/some/where/${objects[1].thumb}"`) && others.includes(objects[1].title));
});

test('it tells all that is documented', async () => {
  await pictureOf(element).focus();
  await page.keyboard.press('ArrowLeft');
  await told('vitrine-change {"azimuth":11');
  await element.getByRole('button', { name: '1 axis' }).click();
  await told('vitrine-view {"view":"series"}');
  await told('vitrine-free');
  await element.getByRole('button', { name: '3D' }).click();
  assert.deepEqual(complaints, []);
  await element.evaluate((e) => e.setAttribute('src', 'missing.glb'));
  await told('vitrine-error {"reason":"404 Not Found"}');
  assert.equal(await element.locator('[part="facts"]').textContent(), 'Cannot be shown: 404 Not Found');
  const seen = new Set((await page.textContent('#events')).match(/vitrine-\w+/g));
  assert.deepEqual([...seen.add('vitrine-load')].sort(), firstColumn('Events, properties'));
});

test('attributes, parts and properties are those that are documented', async () => {
  const found = await element.evaluate((e) => ({
    attributes: [...e.constructor.observedAttributes, 'problem'].sort(),
    parts: [...new Set([...e.shadowRoot.querySelectorAll('[part]')].map((part) => part.getAttribute('part')))].sort(),
    properties: [...new Set([...e.shadowRoot.adoptedStyleSheets[0].cssRules].flatMap(({ cssText }) => cssText.match(/--vitrine-\w+/g) ?? []))].sort(),
  }));
  assert.deepEqual(found.attributes, firstColumn('Attributes'));
  const [parts, properties] = /Parts, for `::part\(\)`: (.*?)\. Properties: (.*?)\.\n\n/s.exec(section('Style')).slice(1).map((text) => namesIn(text).sort());
  assert.deepEqual(found.parts, parts);
  assert.deepEqual(found.properties, properties);
});

test('a page can style it, as the documentation does', async () => {
  answers['/styled.css'] = () => section('Style').match(/^ {4}.*$/gm).join('\n');
  await page.addStyleTag({ url: '/styled.css' });
  assert.equal((await pictureOf(element).boundingBox()).width, 320);
  assert.equal(await element.locator('[part="tools"]').isVisible(), false);
});

test('every page of the gallery has that policy', async () => {
  for (const name of ['index.html', 'viewer/embed.html']) assert.ok(fs.readFileSync(path.join(folder, name), 'utf8').includes(`content="${policy}"`), name);
});

test('back to the gallery', async () => {
  await page.getByText('Back to the gallery').click();
  await page.locator('.card').nth(objects.length - 1).waitFor();
  assert.equal(new URL(page.url()).pathname, '/some/where/index.html');
});
