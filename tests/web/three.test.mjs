// SPDX-License-Identifier: Apache-2.0
// Every GLB of the folder $VITRINE_WEB_GLBS opens in three.js and shows something; those of make_fixtures what it expects.
import assert from 'node:assert/strict';
import path from 'node:path';
import test, { after, before } from 'node:test';
import { fileURLToPath } from 'node:url';

import { openBrowser, serve } from './browser.mjs';
import { expectations, folder, glbs } from './fixtures.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const PLACES = [[0.1, 0.2], [-0.6, 0.5], [0.7, -0.3]]; // where shading is compared

let server, browser, page;
const complaints = [];

before(async () => {
  server = await serve({ '/three/': path.join(here, 'node_modules/three'), '/tests/': here, '/glbs/': folder });
  browser = await openBrowser();
  page = await browser.newPage();
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error' || message.text().startsWith('THREE.')) complaints.push(message.text());
  });
  await page.goto(`${server.url}/tests/page.html`);
  await page.waitForFunction(() => window.draw);
});

after(async () => {
  await browser?.close();
  await server?.close();
});

const draw = (file, view) => {
  const url = `${server.url}/glbs/${path.relative(folder, file).split(path.sep).map(encodeURIComponent).join('/')}`;
  return page.evaluate(([u, v]) => window.draw(u, v), [url, view]);
};

const difference = (a, b) => Math.max(...a.map((value, k) => Math.abs(value - b[k])));

function assertColour(found, wanted, within, place) {
  assert.ok(difference(found, wanted) <= within, `at ${place}: ${found}, expected ${wanted} within ${within}`);
}

const expected = expectations();
for (const file of glbs()) {
  test(`${path.basename(file)} is drawn`, async () => {
    complaints.length = 0;
    const { centre, light, coverage, pixels = [], shadesAs, within } = expected.get(file) ?? { light: [0, 0, 1] };
    const places = shadesAs ? PLACES : pixels.map(({ at }) => at);
    const seen = await draw(file, { centre, light, places, geometric: shadesAs });
    assert.deepEqual(complaints, []);
    assert.ok(seen.triangles > 0 && seen.coverage > 0.02, `${seen.triangles} triangles cover ${seen.coverage}`);
    if (coverage) assert.ok(Math.abs(seen.coverage - coverage) < 0.01, `covers ${seen.coverage}, expected ${coverage}`);
    if (shadesAs) PLACES.forEach((place, i) => assertColour(seen.colours[i], seen.wanted[i], within, place));
    else pixels.forEach(({ at, rgb, within: w }, i) => assertColour(seen.colours[i], rgb, w, at));
  });
}

test('a normal map that is off by 3 degrees would be seen', async (t) => {
  const file = glbs().find((name) => expected.get(name)?.shadesAs);
  if (!file) {
    t.skip('no fixture here');
    return;
  }
  const { light, centre, shadesAs, within } = expected.get(file);
  const off = [shadesAs[0] - 0.055, shadesAs[1], shadesAs[2]];
  const seen = await draw(file, { centre, light, places: PLACES, geometric: off });
  PLACES.forEach((_, i) => assert.ok(difference(seen.colours[i], seen.wanted[i]) > within));
});
