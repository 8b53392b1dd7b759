// SPDX-License-Identifier: Apache-2.0
// The pages of docs/embedding/ show thumbnails of the gallery $VITRINE_WEB_GALLERY in other viewers, and there, too, they are as near
// to their originals, of $VITRINE_WEB_ARCHIVE, as their certificates say. With $VITRINE_WEB_PICTURES the screenshots stay there.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import test, { after, before } from 'node:test';
import { fileURLToPath } from 'node:url';

import { openBrowser, serve, WHITE_PIXEL } from './browser.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const docs = path.join(here, '../../docs');
const { VITRINE_WEB_GALLERY: gallery, VITRINE_WEB_ARCHIVE: archive, VITRINE_WEB_PICTURES: pictures } = process.env;
const VIEWERS = ['three', 'babylon', 'model-viewer'];
const MODELS = ['metal/mask.glb', 'stone/knot.glb']; // a colour map, colours per vertex
const AZIMUTHS = [0, 120];
const TIMES = 2; // screenshots are so many times larger, and antialiased
const FRAMES = 4; // between screenshots
const PATIENCE = 120e3; // milliseconds

const rows = JSON.parse(fs.readFileSync(path.join(gallery, 'report.json'), 'utf8')).rows;
let server, browser, context, judge, blank;
const complaints = [], answers = { '/favicon.ico': () => '' };

before(async () => {
  server = await serve({
    '/node_modules/': path.join(here, 'node_modules'), '/three/': path.join(here, 'node_modules/three'), '/tests/': here,
    '/gallery/': gallery, '/archive/': archive,
  }, { answers });
  browser = await openBrowser();
  judge = await browser.newPage();
  await judge.goto(`${server.url}/tests/page.html`);
  await judge.addScriptTag({ type: 'module', url: '/tests/viewers_page.mjs' });
  await judge.waitForFunction(() => window.apart);
  context = await browser.newContext({ viewport: { width: 700, height: 300 }, deviceScaleFactor: TIMES });
  blank = (await (await context.newPage()).screenshot({ clip: { x: 0, y: 0, width: 200, height: 200 } })).toString('base64');
});

after(async () => {
  await browser?.close();
  await server?.close();
});

const read = (viewer) => fs.readFileSync(path.join(docs, 'embedding', `${viewer}.html`), 'utf8');

// The page as somebody makes it of the example: its element once for each azimuth, with this object's place.
function pageOf(viewer, { centre, radius }) {
  const text = read(viewer);
  const [element] = /<(canvas|model-viewer) [^]*?<\/\1>/.exec(text);
  const own = (azimuth) => element
    .replace('data-sphere="0 0 0 1"', `data-sphere="${centre.join(' ')} ${radius}"`).replace('data-azimuth="0"', `data-azimuth="${azimuth}"`)
    .replace('0m 0m 0m', centre.map((x) => `${x}m`).join(' ')).replace('0deg 80deg 3.864m', `${azimuth}deg 80deg ${radius / Math.sin(Math.PI / 12)}m`)
    .replace('auto auto 8m', `auto auto ${8 * radius}m`);
  return text.replace(element, AZIMUTHS.map(own).join('\n'));
}

// In the page: whether all of its elements have drawn their model.
const READY = {
  three: () => [...document.querySelectorAll('canvas')].every((canvas) => canvas.width === canvas.clientWidth * devicePixelRatio), // its size comes last
  babylon: async () => {
    const { EngineStore } = await import('/node_modules/@babylonjs/core/Engines/engineStore.js');
    const scenes = EngineStore.Instances.flatMap((engine) => engine.scenes);
    return scenes.length === document.querySelectorAll('canvas').length && scenes.every((scene) => scene.meshes.length > 0 && scene.isReady());
  },
  'model-viewer': () => [...document.querySelectorAll('model-viewer')].every((element) => element.modelIsVisible),
};

// The page opened, in a tab that complains; what would change its pictures by itself is turned off.
async function open(viewer, sphere, glb) {
  const page = await context.newPage();
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('console', (message) => { if (message.type() === 'error') complaints.push(message.text()); });
  page.on('request', (request) => { if (!/^(blob|data):/.test(request.url()) && !request.url().startsWith(server.url)) complaints.push(`foreign: ${request.url()}`); });
  Object.assign(answers, {
    '/example.html': () => pageOf(viewer, sphere), '/gallery/models/lion/thumb.glb': () => glb, '/gallery/models/lion/poster.jpg': () => WHITE_PIXEL,
  });
  await page.goto(`${server.url}/example.html`, { timeout: PATIENCE });
  await page.evaluate(() => {
    const Viewer = customElements.get('model-viewer');
    if (Viewer) Viewer.minimumRenderScale = 1; // no smaller pictures where the machine is slow
    for (const element of document.querySelectorAll('model-viewer')) element.interactionPrompt = 'none'; // it would wave the object
  });
  return page;
}

// Screenshots of all elements once each has drawn its model, none is blank, and two in a row are the same. What is on the screen
// is older than what has been drawn, by some frames where the machine is slow.
async function show(viewer, sphere, glb) {
  const page = await open(viewer, sphere, glb);
  await page.waitForFunction(READY[viewer], null, { timeout: PATIENCE });
  const boxes = await page.evaluate(() => [...document.querySelectorAll('canvas[data-src], model-viewer')].map((element) => element.getBoundingClientRect().toJSON()));
  const shoot = async () => {
    for (let i = 0; i < FRAMES; ++i) await page.evaluate(() => new Promise(requestAnimationFrame));
    const shots = [];
    for (const clip of boxes) shots.push((await page.screenshot({ clip, animations: 'disabled', timeout: PATIENCE })).toString('base64'));
    return shots;
  };
  for (let last = []; ;) {
    const shots = await shoot();
    if (shots.every((shot, i) => shot === last[i] && shot !== blank)) {
      await page.close();
      return shots;
    }
    last = shots;
  }
}

// How far apart two rows of screenshots are, on average.
async function apart(a, b) {
  const found = await Promise.all(a.map((shot, i) => judge.evaluate(
    ([x, y, times]) => window.apart(`data:image/png;base64,${x}`, `data:image/png;base64,${y}`, times), [shot, b[i], TIMES],
  )));
  const mean = (key) => found.reduce((sum, one) => sum + one[key], 0) / found.length;
  return { mse1e4: mean('mse1e4'), filled: mean('filled') };
}

function keep(name, shots) {
  if (pictures) shots.forEach((shot, i) => fs.writeFileSync(path.join(pictures, `${name}-${AZIMUTHS[i]}.png`), Buffer.from(shot, 'base64')));
}

for (const input of MODELS)
  for (const viewer of VIEWERS)
    test(`${input} in ${viewer} is as near to its original as its certificate says`, async (t) => {
      complaints.length = 0;
      const row = rows.find((one) => one.input === input);
      const original = await judge.evaluate((url) => window.asMeasured(url), `/archive/${input}`);
      const wanted = await show(viewer, row.sphere, Buffer.from(original.split(',')[1], 'base64'));
      const seen = await show(viewer, row.sphere, fs.readFileSync(path.join(gallery, row.thumb)));
      keep(`${path.basename(input)}-${viewer}-original`, wanted);
      keep(`${path.basename(input)}-${viewer}-thumb`, seen);
      const { mse1e4, filled } = await apart(seen, wanted);
      t.diagnostic(`error ${mse1e4.toFixed(2)}, certificate ${row.measure.mse1e4.toFixed(2)}`);
      assert.deepEqual(complaints, []);
      assert.ok(Math.abs(filled - row.measure.coverage) < 0.1, `fills ${filled}, by its certificate ${row.measure.coverage}`);
      assert.ok(mse1e4 < 2 * row.measure.mse1e4, `error ${mse1e4}, by its certificate ${row.measure.mse1e4}`);
    });
