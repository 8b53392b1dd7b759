// SPDX-License-Identifier: Apache-2.0
// An archive to measure with: sizes as in real ones, a lognormal body and one huge scan; all of it the same at each call.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

const MEDIAN = 500e3; // triangles
const SIGMA = 1.2; // of the logarithm: nine of ten scans lie between 70,000 and 3.6 million
const LARGEST = 28e6;
const SCAN_ABOVE = 2e6; // objects beyond it would take minutes to make, and scans of that size are rough as these rings are
const OBJECTS = ['amphora', 'bowl', 'sherd', 'coin', 'mask', 'necklace', 'ring', 'sword', 'bust', 'column', 'knot', 'fossil', 'mosaic', 'tablet'];

// Where a share p of the normal distribution lies below: Newton's method on the series of its integral.
function normalQuantile(p) {
  const density = (x) => Math.exp((-x * x) / 2) / Math.sqrt(2 * Math.PI);
  const below = (x) => {
    let term = x;
    let sum = x;
    for (let k = 3; Math.abs(term) > 1e-12; k += 2) sum += term *= (x * x) / k;
    return 0.5 + sum * density(x);
  };
  let x = 0;
  for (let i = 0; i < 50; ++i) x -= Math.max(-1, Math.min(1, (below(x) - p) / density(x)));
  return x;
}

/// Triangles of each model: the quantiles of the distribution, in an order that mixes them, and one of the largest in their midst.
export function sizes(models, scale) {
  const body = models - 1;
  const all = Array.from({ length: body }, (_, i) => Math.min(LARGEST, MEDIAN * Math.exp(SIGMA * normalQuantile((i + 0.5) / body))));
  let step = Math.max(1, Math.round(body * 0.618));
  while (gcd(step, body) > 1) ++step;
  const mixed = all.map((_, i) => all[(i * step) % body]);
  mixed.splice(body >> 1, 0, LARGEST);
  return mixed.map((triangles) => Math.max(200, Math.round(triangles * scale)));
}

const gcd = (a, b) => (b ? gcd(b, a % b) : a);

/// Writes the models below `folder`, unless they are there. `programs`: folder of vitrine-sample and perf_make_scan.
export function makeArchive(folder, models, scale, programs) {
  const mark = path.join(folder, '..', `${path.basename(folder)}.made`);
  const wanted = JSON.stringify({ models, scale });
  if (fs.existsSync(mark) && fs.readFileSync(mark, 'utf8') === wanted) return;
  fs.rmSync(folder, { recursive: true, force: true });
  sizes(models, scale).forEach((triangles, i) => {
    const place = path.join(folder, String(i).padStart(5, '0'));
    fs.mkdirSync(place, { recursive: true });
    if (triangles > SCAN_ABOVE) execFileSync(path.join(programs, 'perf_make_scan'), [path.join(place, 'scan.ply'), '--triangles', String(triangles)]);
    else execFileSync(path.join(programs, 'vitrine-sample'), ['--out', place, '--object', OBJECTS[i % OBJECTS.length], '--triangles', String(triangles), '--seed', String(i + 1)]);
  });
  fs.writeFileSync(mark, wanted);
}
