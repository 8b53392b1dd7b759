// SPDX-License-Identifier: Apache-2.0
// 500 cards, a hundred of them with hostile names: contexts, memory and names hold. With $VITRINE_WEB_FULL every card is passed.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { WHITE_PIXEL } from './browser.mjs';
import { glbs } from './fixtures.mjs';
import { bytesUntilFirst, MOST_FIRST, openGallery, writeGallery } from './gallery_page.mjs';

const COUNT = 500, HOSTILE = 100;
const STEP = process.env.VITRINE_WEB_FULL ? 800 : 8000; // pixels a scroll

// Markup, scripts, control and direction characters, links, templates; each with its number so that all differ.
const KINDS = [
  '<script>window.broken=1</script>', '"><img src=x onerror=window.broken=1>', "' onmouseover='window.broken=1", '</h2><iframe src="//evil.example">', '&lt;b&gt;&amp;amp;',
  'javascript:window.broken=1', '{{constructor.constructor("window.broken=1")()}}', '\u202egnp.exe', 'a\u0000b\u0007c\u001b[31m', '../../../../etc/passwd',
  '<svg/onload=window.broken=1>', '${window.broken=1}', '<!-- -->', ']]>', '%3Cscript%3E', '\ud83c\udffa'.repeat(30), 'x'.repeat(2000), '\n\n\t', 'ｆｕｌｌ\u0301\u0301\u0301\u0301', '=HYPERLINK("http://evil.example")',
];

let gallery, page, complaints, close, names;

before(async () => {
  const files = glbs();
  names = Array.from({ length: HOSTILE }, (_, i) => `${KINDS[i % KINDS.length]} ${i}`);
  gallery = writeGallery(Array.from({ length: COUNT }, (_, i) => ({
    slug: `o-${i}`, title: names[i] ?? `Object ${i}`, thumb: `models/${i % files.length}.glb`, poster: 'poster.png', bytes: 1000 + i, triangles: i, mse1e4: i / 100,
    metadata: i < HOSTILE ? { credit: names[i], licence: names[i], link: names[i], [names[i]]: names[i] } : {},
  })));
  fs.mkdirSync(path.join(gallery, 'models'));
  files.forEach((file, i) => fs.copyFileSync(file, path.join(gallery, `models/${i}.glb`)));
  fs.writeFileSync(path.join(gallery, 'poster.png'), WHITE_PIXEL);
  ({ page, complaints, close } = await openGallery(gallery, { gzip: true }));
  await page.waitForFunction((count) => document.querySelectorAll('.card').length === count, COUNT);
});

after(async () => {
  await close?.();
  if (gallery) fs.rmSync(gallery, { recursive: true });
});

const statistics = () => page.evaluate(() => customElements.get('vitrine-thumbnail').statistics);

// Scrolls to the end; returns the largest figures on the way.
async function scrollThrough() {
  const most = { live: 0, geometries: 0, textures: 0 };
  const end = await page.evaluate(() => document.documentElement.scrollHeight);
  for (let y = 0; y < end; y += STEP) {
    await page.evaluate((top) => scrollTo({ top, behavior: 'instant' }), y);
    await page.waitForFunction(() => [...document.querySelectorAll('vitrine-thumbnail')].some((card) => {
      const { top, bottom } = card.getBoundingClientRect();
      return card.model && bottom > 0 && top < innerHeight;
    }), null, { timeout: 60000 });
    const now = await statistics();
    for (const key of Object.keys(most)) most[key] = Math.max(most[key], now[key]);
  }
  return most;
}

async function heap() {
  const client = await page.context().newCDPSession(page);
  await client.send('HeapProfiler.collectGarbage');
  return (await client.send('Runtime.getHeapUsage')).usedSize;
}

test('the first object is there after 350 KB', async () => {
  const bytes = await bytesUntilFirst(page);
  assert.ok(bytes > 150e3 && bytes <= MOST_FIRST, `${bytes} bytes`);
});

test('names and metadata are text', async () => {
  const shown = await page.locator('.card h2').allTextContents();
  assert.deepEqual(new Set(shown), new Set([...names, ...Array.from({ length: COUNT - HOSTILE }, (_, i) => `Object ${i + HOSTILE}`)]));
  assert.equal(await page.evaluate(() => window.broken), undefined);
  assert.equal(await page.locator('.card iframe, .card script, .card svg:not([viewBox])').count(), 0);
  for (const href of await page.locator('.card a').evaluateAll((all) => all.map((link) => link.href))) assert.match(href, /^https?:/);
});

test('cards that leave give back what they took', async () => {
  const first = await scrollThrough();
  const before = await heap();
  const second = await scrollThrough();
  const after = await heap();
  assert.ok(first.live < 80, `${first.live} objects are live at once`);
  assert.ok(second.live <= first.live + 20 && second.geometries <= first.geometries + 20 && second.textures <= first.textures + 20, JSON.stringify([first, second]));
  assert.ok(after < 1.1 * before + 2e6, `heap ${before} then ${after}`);
  assert.ok(await page.evaluate(() => window.contexts) <= 2);
});

test('nothing fails and no other host is asked', () => assert.deepEqual(complaints, []));

test('names are text in the demonstration, and in the lines that it gives', async () => {
  await page.goto(new URL('viewer/embed.html', page.url()).href);
  await page.waitForFunction((count) => document.querySelectorAll('option').length === count, COUNT);
  complaints.length = 0; // of the page that was left while it loaded
  await page.focus('#object');
  const valid = (name) => name.replaceAll('\0', '\ufffd'); // as HTML has it
  for (const name of names.slice(0, KINDS.length)) {
    const alt = await page.evaluate(() => {
      const { body } = new DOMParser().parseFromString(document.getElementById('code').textContent, 'text/html');
      return body.querySelector('vitrine-thumbnail:only-child')?.getAttribute('alt');
    });
    assert.equal(alt, valid(name));
    await page.keyboard.press('ArrowDown');
  }
  assert.equal(await page.evaluate(() => window.broken), undefined);
  assert.deepEqual(complaints, []);
});
