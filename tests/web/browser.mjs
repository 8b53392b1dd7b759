// SPDX-License-Identifier: Apache-2.0
// A file server on 127.0.0.1 and a headless Chromium with a software GPU, which reaches nothing else.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import zlib from 'node:zlib';
import { chromium } from 'playwright-core';

const TYPES = {
  '.html': 'text/html', '.css': 'text/css', '.json': 'application/json', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.glb': 'model/gltf-binary',
  '.jpg': 'image/jpeg',
};

// A poster that is no more to be seen than an empty page.
export const WHITE_PIXEL = Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGP4DwABAQEAG7buVgAAAABJRU5ErkJggg==', 'base64');

// Packages stay what they are: pages that are opened again need not load their hundreds of modules again.
const headersOf = (url) => ({
  'content-type': TYPES[path.extname(url)] ?? 'application/octet-stream', ...(/^\/(node_modules|three)\//.test(url) && { 'cache-control': 'max-age=3600' }),
});

// Serves the files of each folder in { '/prefix/': folder }, compressed where `gzip` says so; before them what functions in
// { '/path': () => body } answer.
export async function serve(mounts, { gzip = false, answers = {} } = {}) {
  const server = http.createServer(async (request, response) => {
    const url = decodeURIComponent(new URL(request.url, 'http://127.0.0.1').pathname);
    const send = (body) => response.writeHead(200, gzip ? { ...headersOf(url), 'content-encoding': 'gzip' } : headersOf(url)).end(gzip ? zlib.gzipSync(body, { level: 9 }) : body);
    if (answers[url]) {
      send(await answers[url]());
      return;
    }
    const prefix = Object.keys(mounts).find((p) => url.startsWith(p));
    const file = prefix && path.join(mounts[prefix], path.normalize(`/${url.slice(prefix.length)}`));
    if (!file || !fs.statSync(file, { throwIfNoEntry: false })?.isFile()) {
      response.writeHead(404).end();
      return;
    }
    send(fs.readFileSync(file));
  });
  await new Promise((done, fail) => server.once('error', fail).listen(0, '127.0.0.1', done));
  return {
    url: `http://127.0.0.1:${server.address().port}`,
    close: () => new Promise((done) => { server.close(done); server.closeAllConnections(); }),
  };
}

export async function openBrowser() {
  const root = process.getuid?.() === 0;
  return chromium.launch({
    executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
    chromiumSandbox: !root,
    args: [
      '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-watchdog', '--disable-dev-shm-usage',
      '--force-color-profile=srgb', '--no-proxy-server', '--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1',
    ],
  });
}
