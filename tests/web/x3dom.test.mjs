// SPDX-License-Identifier: Apache-2.0
// Every X3DOM page of the gallery $VITRINE_WEB_GALLERY opens in X3DOM, reaches nothing else, and shows what three.js shows of the
// thumbnail beside it. With $VITRINE_WEB_PICTURES the screenshots stay there.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import test, { after, before } from 'node:test';
import { fileURLToPath } from 'node:url';

import { openBrowser, serve } from './browser.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const gallery = process.env.VITRINE_WEB_GALLERY;
const SIDE = 250; // pixels, as page.mjs draws

const models = fs.readdirSync(path.join(gallery, 'models')).sort();
let server, browser, judge, page;
const complaints = [];

before(async () => {
  server = await serve({ '/three/': path.join(here, 'node_modules/three'), '/tests/': here, '/some/where/': gallery });
  browser = await openBrowser();
  judge = await browser.newPage();
  await judge.goto(`${server.url}/tests/page.html`);
  await judge.waitForFunction(() => window.against);
  page = await browser.newPage({ viewport: { width: SIDE, height: SIDE } });
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('console', (message) => { if (message.type() === 'error') complaints.push(message.text()); });
  page.on('requestfailed', (request) => complaints.push(`failed: ${request.url()}`));
  page.on('response', (response) => { if (response.status() >= 400) complaints.push(`${response.status()}: ${response.url()}`); });
});

after(async () => {
  await browser?.close();
  await server?.close();
});

async function screenshot(url) {
  await page.goto(url);
  await page.waitForFunction(() => document.querySelector('x3d').runtime?.canvas?.doc);
  await page.evaluate(() => document.querySelector('background').setAttribute('skyColor', '1 0 1'));
  await page.waitForFunction(() => {
    const { doc } = document.querySelector('x3d').runtime.canvas;
    return doc.downloadCount === 0 && !doc.needRender;
  });
  for (let last; ;) { // textures arrive when they are decoded
    await page.waitForTimeout(300);
    const picture = (await page.screenshot()).toString('base64');
    if (picture === last) return picture;
    last = picture;
  }
}

async function difference(model, picture) {
  const glb = `${server.url}/some/where/models/${model}/thumb.glb`;
  return judge.evaluate(([p, g]) => window.against(p, g), [`data:image/png;base64,${picture}`, glb]);
}

const painted = (model) => JSON.parse(fs.readFileSync(path.join(gallery, 'report.json'), 'utf8')).rows.find((row) => row.thumb.includes(model)).source.coloured;
const address = (model) => `${server.url}/some/where/models/${model}/x3d/index.html`;
const errors = new Map();

for (const model of models)
  test(`${model} is shown`, async () => {
    const picture = await screenshot(address(model));
    if (process.env.VITRINE_WEB_PICTURES)
      fs.writeFileSync(path.join(process.env.VITRINE_WEB_PICTURES, `${model}.png`), Buffer.from(picture, 'base64'));
    const seen = await difference(model, picture);
    errors.set(model, seen.error);
    assert.ok(seen.share > 0.02, `the model covers ${seen.share} of the picture`);
    assert.ok(seen.overlap > 0.95, `the silhouettes overlap by ${seen.overlap}`);
    assert.ok(Math.abs(seen.bias) < 12 && seen.error < 16, `colours differ by ${seen.bias}, ${seen.error} without sign`);
    assert.deepEqual(complaints, []);
  });

test('normal maps are made for the frame of X3DOM', async () => {
  await page.route('**/index.html', async (route) => {
    const response = await route.fetch();
    await route.fulfill({ response, body: (await response.text()).replace('normalBias="-1 1 1"', 'normalBias="-1 -1 1"') });
  });
  let [right, turned] = [0, 0];
  for (const model of models.filter((name) => !painted(name))) { // where normals are all that is to be seen
    right += errors.get(model);
    turned += (await difference(model, await screenshot(address(model)))).error;
  }
  assert.ok(turned > 1.1 * right, `errors: ${right}, with green turned round ${turned}`);
});
