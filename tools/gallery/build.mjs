// SPDX-License-Identifier: Apache-2.0
// node build.mjs OUT: the page as static files, with everything that it needs offline. index.html goes to a gallery's root,
// the rest into its viewer/; x3dom/ only where thumbnails have X3DOM pages. sizes.json says what a visitor loads.
import { build } from 'esbuild';
import { cp, mkdir, readFile, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2];
if (!out) {
  console.error('usage: node build.mjs OUT');
  process.exit(2);
}

await build({
  entryPoints: {
    'vitrine-thumbnail': join(here, 'thumbnail.js'),
    gallery: join(here, 'gallery.js'),
    embed: join(here, 'embed.js'),
    meshopt: join(here, 'node_modules/three/examples/jsm/libs/meshopt_decoder.module.js'),
  },
  outdir: out,
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  loader: { '.css': 'text' },
  logLevel: 'warning',
});
const head = (await readFile(join(here, 'head.html'), 'utf8')).trim();
for (const file of ['index.html', 'embed.html'])
  await writeFile(join(out, file), (await readFile(join(here, file), 'utf8')).replace('<!-- head -->', () => head));
await cp(join(here, 'gallery.css'), join(out, 'gallery.css'));
await cp(join(here, 'node_modules/three/LICENSE'), join(out, 'three.LICENSE.txt'));

const DRACO = ['draco_decoder.wasm', 'draco_wasm_wrapper.js'];
await mkdir(join(out, 'draco'), { recursive: true });
for (const file of DRACO) await cp(join(here, 'node_modules/three/examples/jsm/libs/draco/gltf', file), join(out, 'draco', file));

// X3DOM's package brings no text of its licence.
await mkdir(join(out, 'x3dom'), { recursive: true });
await cp(join(here, 'node_modules/x3dom/x3dom.js'), join(out, 'x3dom', 'x3dom.js'));
await cp(join(here, 'x3dom.LICENSE.txt'), join(out, 'x3dom', 'LICENSE.txt'));

/** Bytes of files, as they are and by gzip. @param {string[]} names */
async function weigh(names) {
  const files = await Promise.all(names.map((name) => readFile(join(out, name))));
  const sum = (/** @type {(file: Buffer) => number} */ size) => files.reduce((total, file) => total + size(file), 0);
  return { bytes: sum((file) => file.length), gzip: sum((file) => gzipSync(file, { level: 9 }).length) };
}
/** @param {string[]} files */
const decoder = async (files) => ({ files, ...(await weigh(files)) });
const sizes = {
  viewer: await weigh(['index.html', 'gallery.css', 'gallery.js', 'vitrine-thumbnail.js']),
  decoders: { web: await decoder(DRACO.map((file) => `draco/${file}`)), meshopt: await decoder(['meshopt.js']) }, // by profile
};
await writeFile(join(out, 'sizes.json'), `${JSON.stringify(sizes, null, 1)}\n`);
