#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
// How long visitors of a gallery wait: its page, opened in headless Chromium over slow lines, with objects in 3D and with the same
// objects as series of pictures. Files travel compressed by gzip where that helps, as web servers do it. What is found goes into
// the gallery, as page.measured of gallery.json and report.json: the page states it, and vitrine report prints it.
import fs from 'node:fs';
import path from 'node:path';
import { parseArgs } from 'node:util';
import { openBrowser, serve } from '../tests/web/browser.mjs';
import { putInto, table } from './marked_page.mjs';

const USAGE = `usage: tools/page_speed.mjs GALLERY [--page FILE]
  GALLERY      made by vitrine convert, with --series for the pictures
  --page FILE  put the table between the marks of this page, such as docs/embedding.md`;
const LINES = [{ megabits: 1.6, latency: 150 }, { megabits: 10, latency: 40 }, { megabits: 50, latency: 20 }]; // latency: milliseconds
const VIEWPORT = { width: 1280, height: 800 };
const PATIENCE = 300e3; // milliseconds

// Runs in the page before its own scripts: chooses the view, and notes when what was first painted, drawn, and drawn in full.
function watch(view) {
  const times = { poster: 0, first: 0, all: 0, bytes: {} };
  window.times = times;
  const loaded = () => [...performance.getEntriesByType('navigation'), ...performance.getEntriesByType('resource')].reduce((sum, entry) => sum + entry.encodedBodySize, 0);
  new MutationObserver((records) => {
    for (const { addedNodes } of records)
      for (const node of addedNodes)
        if (node.nodeType === 1) for (const card of node.querySelectorAll('vitrine-thumbnail')) card.setAttribute('view', view);
  }).observe(document, { childList: true, subtree: true });
  const note = (name, is) => {
    if (times[name] || !is) return;
    times[name] = performance.now();
    times.bytes[name] = loaded();
  };
  const look = () => {
    const cards = [...document.querySelectorAll('vitrine-thumbnail')].filter((card) => card.getBoundingClientRect().top < innerHeight);
    const drawn = cards.filter(({ canvas }) => canvas && !canvas.hidden && canvas.width > 0);
    note('poster', [...document.querySelectorAll('vitrine-thumbnail img')].some(({ complete, naturalWidth }) => complete && naturalWidth > 0));
    note('first', drawn.length > 0);
    note('all', cards.length > 0 && drawn.length === cards.length);
    if (!times.all) setTimeout(look, 10);
  };
  look();
}

// gallery.json as for a page that shows pictures and has no decoder to load.
function ofPictures(gallery) {
  const { page, ...rest } = JSON.parse(fs.readFileSync(path.join(gallery, 'gallery.json'), 'utf8'));
  delete page.decoder;
  return JSON.stringify({ ...rest, page });
}

async function visit(browser, url, view, { megabits, latency }) {
  const context = await browser.newContext({ viewport: VIEWPORT });
  const page = await context.newPage();
  const client = await context.newCDPSession(page);
  await client.send('Network.enable');
  await client.send('Network.emulateNetworkConditions', { offline: false, latency, downloadThroughput: (megabits * 1e6) / 8, uploadThroughput: (megabits * 1e6) / 8 });
  await page.addInitScript(watch, view);
  await page.goto(`${url}/${view}/index.html`, { timeout: PATIENCE });
  await page.waitForFunction(() => window.times.all, null, { timeout: PATIENCE });
  const times = await page.evaluate(() => ({ ...window.times, decodings: customElements.get('vitrine-thumbnail').statistics.decodings }));
  await context.close();
  return times;
}

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const seconds = (milliseconds) => `${(milliseconds / 1000).toFixed(1)} s`;
const kilobytes = (bytes) => `${(bytes / 1000).toFixed(0)} KB`;

// What goes into the gallery: milliseconds of decoding, seconds of waiting, bytes loaded by then.
function findings(visits) {
  const inSeconds = (milliseconds) => Number((milliseconds / 1000).toFixed(2));
  return {
    decoding: Number(median(visits.flatMap(({ decodings }) => decodings)).toFixed(1)),
    visits: visits.map(({ view, megabits, latency, poster, first, all, bytes }) => ({
      view, megabits, latency, poster: inSeconds(poster), first: inSeconds(first), all: inSeconds(all), bytes: { first: bytes.first, all: bytes.all },
    })),
  };
}

function record(gallery, measured) {
  for (const name of ['gallery.json', 'report.json']) {
    const file = path.join(gallery, name);
    const json = JSON.parse(fs.readFileSync(file, 'utf8'));
    json.page.measured = measured;
    fs.writeFileSync(`${file}.new`, `${JSON.stringify(json, null, 1)}\n`);
    fs.renameSync(`${file}.new`, file);
  }
}

function report(visits, objects) {
  const rows = visits.map(({ view, megabits, poster, first, all, bytes }) =>
    [view === '3d' ? '3D' : 'pictures, one axis', `${megabits} Mbit/s`, seconds(poster), seconds(first), kilobytes(bytes.first), seconds(all), kilobytes(bytes.all)]);
  const head = ['objects as', 'line', 'first poster', 'first object', 'loaded by then', 'all in view', 'loaded by then'];
  const decodings = visits.flatMap((visit) => visit.decodings);
  return `${table(head, rows, 2)}\n\n${objects} objects, posters included. Decoding one took ${median(decodings).toFixed(0)} ms (median).`;
}

async function main() {
  const { values: { page }, positionals: [gallery] } = parseArgs({ options: { page: { type: 'string' } }, allowPositionals: true });
  if (!gallery) throw new Error(USAGE);
  const { objects } = JSON.parse(fs.readFileSync(path.join(gallery, 'gallery.json'), 'utf8'));
  const server = await serve({ '/3d/': gallery, '/series/': gallery }, { gzip: true, answers: { '/series/gallery.json': () => ofPictures(gallery) } });
  const browser = await openBrowser();
  try {
    const visits = [];
    for (const view of objects.some(({ series }) => series) ? ['3d', 'series'] : ['3d'])
      for (const line of LINES) {
        visits.push({ view, ...line, ...(await visit(browser, server.url, view, line)) });
        process.stderr.write(`${view}, ${line.megabits} Mbit/s: ${seconds(visits.at(-1).all)}\n`);
      }
    record(gallery, findings(visits));
    const text = report(visits, objects.length);
    console.log(text);
    if (page) putInto(page, 'tools/page_speed.mjs', text);
  } finally {
    await browser.close();
    await server.close();
  }
}

main().catch((error) => {
  console.error(error.message);
  process.exitCode = 2;
});
