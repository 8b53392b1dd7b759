// SPDX-License-Identifier: Apache-2.0
// node build.mjs OUT: the page as static files, with everything that it needs offline. index.html goes to a gallery's root,
// the rest into its viewer/; x3dom/ only where thumbnails have X3DOM pages.
import { build } from 'esbuild';
import { cp, mkdir } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2];
if (!out) {
  console.error('usage: node build.mjs OUT');
  process.exit(2);
}

await build({
  entryPoints: [join(here, 'gallery.js')],
  outfile: join(out, 'viewer.js'),
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  logLevel: 'warning',
});
await mkdir(join(out, 'draco'), { recursive: true });
for (const file of ['index.html', 'gallery.css']) await cp(join(here, file), join(out, file));
await cp(join(here, 'node_modules/three/LICENSE'), join(out, 'three.LICENSE.txt'));
const draco = join(here, 'node_modules/three/examples/jsm/libs/draco/gltf');
for (const file of ['draco_decoder.wasm', 'draco_wasm_wrapper.js', 'draco_decoder.js']) await cp(join(draco, file), join(out, 'draco', file));

// X3DOM's package brings no text of its licence.
await mkdir(join(out, 'x3dom'), { recursive: true });
await cp(join(here, 'node_modules/x3dom/x3dom.js'), join(out, 'x3dom', 'x3dom.js'));
await cp(join(here, 'x3dom.LICENSE.txt'), join(out, 'x3dom', 'LICENSE.txt'));
