// SPDX-License-Identifier: Apache-2.0
// The gallery $VITRINE_WEB_GALLERY and its demonstration, on a desk and on a phone, light and dark: axe finds no fault, of whatever
// weight, keys reach every control, and nothing is wider than the screen.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import { after, before, describe, test } from 'node:test';
import { cardAt, decoded, openGallery, pictureOf, shown } from './gallery_page.mjs';

const folder = process.env.VITRINE_WEB_GALLERY;
const AXE = fs.readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const SCREENS = { desk: { width: 1280 }, phone: { width: 400, hasTouch: true, isMobile: true } };
const PAGES = { gallery: 'index.html', demonstration: 'viewer/embed.html' };

// Each fault, by the first element that has it. The first card has the focus, so that its tools are seen.
async function faults(page) {
  await pictureOf(cardAt(page, 0)).focus();
  await page.evaluate(AXE);
  const { violations } = await page.evaluate(() => window.axe.run({ resultTypes: ['violations'] }));
  return violations.map(({ id, impact, nodes }) => [id, impact, nodes[0].html]);
}

// Lightness of the page's margin on the screen, 0 to 255.
async function lightness(page) {
  const shot = await page.screenshot({ clip: { x: 0, y: 0, width: 4, height: 4 } });
  return (await decoded(page, `data:image/png;base64,${shot.toString('base64')}`))[1];
}

// What can be used but was not reached, after so many presses of the key as there are things to reach, and some.
async function unreached(page) {
  const count = await page.evaluate(() => {
    const within = (root) => [...root.querySelectorAll('*')].flatMap((element) => [element, ...(element.shadowRoot ? within(element.shadowRoot) : [])]);
    window.controls = new Set(within(document).filter((element) => element.matches('a[href], button, input, select, summary, [tabindex="0"]') && element.checkVisibility()));
    return window.controls.size;
  });
  await page.evaluate(() => document.activeElement.blur());
  for (let i = 0; i < count + 3; ++i) {
    await page.keyboard.press('Tab');
    await page.evaluate(() => {
      let { activeElement } = document;
      while (activeElement?.shadowRoot?.activeElement) activeElement = activeElement.shadowRoot.activeElement;
      window.controls.delete(activeElement);
    });
  }
  assert.ok(count > 8, `there are ${count} controls`);
  return page.evaluate(() => [...window.controls].map((element) => element.outerHTML));
}

for (const [screen, settings] of Object.entries(SCREENS))
  describe(`on a ${screen}`, () => {
    let page, close, home;

    before(async () => {
      ({ page, close } = await openGallery(folder, settings));
      home = page.url();
    });
    after(() => close?.());

    for (const [name, address] of Object.entries(PAGES)) {
      test(`axe finds no fault in the ${name}, light or dark`, async () => {
        await page.goto(new URL(address, home).href);
        await shown(cardAt(page, 0));
        if (name === 'gallery') await page.click('#weight summary');
        for (const [colorScheme, is] of [['light', (grey) => grey > 200], ['dark', (grey) => grey < 55]]) {
          await page.emulateMedia({ colorScheme });
          assert.deepEqual(await faults(page), [], colorScheme);
          assert.ok(is(await lightness(page)), colorScheme);
        }
        const { scrollWidth } = await page.evaluate(() => ({ scrollWidth: document.documentElement.scrollWidth }));
        assert.ok(scrollWidth <= settings.width, `${scrollWidth} pixels wide`);
      });

      test(`keys reach every control of the ${name}`, async () => assert.deepEqual(await unreached(page), []));
    }
  });
