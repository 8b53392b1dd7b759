#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
// Whether twice the models take twice the time: the same small model 1, 10, 100, 1,000 times over, each in a folder of its own.
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { execFileSync } from 'node:child_process';
import { parseArgs } from 'node:util';
import { convert, fixed, percent, PROGRAMS, tell } from './measured.mjs';

const USAGE = `usage: perf/scaling.mjs [--triangles N] [--most N] [--scratch DIR] [--keep] [-- CONVERT OPTIONS]
  --triangles N  of the model (4,000)
  --most N       of the models (1,000)
  --keep         enter the figures into perf/results/
needs: tools/build release vitrine perf_make_scan`;
const STEP = 10;
const REPEATED = 10; // models; runs of no more take less than what they differ by

/// Models from..to of the archive: the same bytes each.
function grow(archive, model, from, to) {
  for (let i = from; i < to; ++i) {
    const folder = path.join(archive, String(i % 100).padStart(2, '0'), String(i).padStart(6, '0'));
    fs.mkdirSync(folder, { recursive: true });
    fs.copyFileSync(model, path.join(folder, 'scan.ply'));
  }
}

/// The run of median CPU seconds.
function typical(runs) {
  return runs.sort((a, b) => a.cpu - b.cpu)[runs.length >> 1];
}

/// Beyond those before it, so that starting up counts for none.
function row(run, before) {
  const cost = before ? (run.cpu - before.cpu) / (run.models - before.models) : NaN;
  const wall = before ? (run.wall - before.wall) / (run.models - before.models) : NaN;
  return { models: run.models, cpu: run.cpu, cost, wall, peak: run.peak };
}

function text(rows) {
  const first = rows.find(({ cost }) => cost > 0).cost;
  const lines = rows.map(({ models, cpu, cost, wall, peak }) =>
    `| ${models} | ${fixed(cpu, 2)} | ${cost > 0 ? `${fixed(cost, 4)} | ${percent(cost / first)} | ${fixed(wall, 4)}` : '| |'} | ${fixed(peak / 1e6, 0)} MB |`);
  return ['| models | CPU seconds | for each beyond the line above | of the first such | wall seconds, likewise | peak memory |', '|---|---|---|---|---|---|', ...lines].join('\n');
}

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    triangles: { type: 'string', default: '4000' },
    most: { type: 'string', default: '1000' },
    scratch: { type: 'string', default: path.join(os.tmpdir(), 'vitrine-scaling') },
    keep: { type: 'boolean', default: false },
    help: { type: 'boolean', default: false },
  },
});
if (values.help || !(values.most >= STEP)) {
  console.error(USAGE);
  process.exit(2);
}
const scratch = path.resolve(values.scratch);
const [archive, gallery, model] = ['archive', 'gallery', 'scan.ply'].map((name) => path.join(scratch, name));
fs.rmSync(archive, { recursive: true, force: true });
fs.mkdirSync(archive, { recursive: true });
execFileSync(path.join(PROGRAMS, 'perf_make_scan'), [model, '--triangles', values.triangles]);
const rows = [];
for (let models = 1, before; models <= values.most; models *= STEP) {
  grow(archive, model, before ? before.models : 0, models);
  const runs = Array.from({ length: models <= REPEATED ? 5 : 1 }, () => convert(path.join(PROGRAMS, 'vitrine'), archive, gallery, positionals));
  const run = typical(runs);
  rows.push(row(run, before));
  console.error(`${models}: ${fixed(run.cpu, 2)} CPU s`);
  before = run;
}
const options = positionals.length ? ` -- ${positionals.join(' ')}` : '';
tell(`One model many times${options && `,${options.slice(3)}`}`, `perf/scaling.mjs --triangles ${values.triangles} --most ${values.most}${options}`, text(rows), values.keep);
