#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
// How many models an hour: makes an archive, converts it, and says what bound that; beside it, today's way by Blender.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { parseArgs } from 'node:util';
import { makeArchive, sizes } from './archive.mjs';
import { convert, fixed, gigabytes, percent, PROGRAMS, ROOT, table, tell, timed } from './measured.mjs';

const USAGE = `usage: perf/throughput.mjs [--models N] [--scale S] [--scratch DIR] [--blender TRIANGLES] [--keep] [-- CONVERT OPTIONS]
  --models N           in the archive (40): lognormal sizes, median 500,000 triangles, the largest 28 million
  --scale S            all sizes times S (1)
  --scratch DIR        where archive and gallery go; the archive stays there for the next time
  --blender TRIANGLES  instead, bake the models of at most so many triangles with Blender, and convert the same ones
  --keep               enter the figures into perf/results/
needs: tools/build release vitrine vitrine-sample perf_make_scan`;

/// Of one conversion. The rate that the stages' CPU seconds allow is that of cores which are never idle.
function figures(run) {
  const { cores, bound, memory } = run.report.run;
  const width = cores.available / cores.seconds;
  const ours = width * run.wall - cores.taken;
  return [
    ['models', run.models],
    ['wall time', `${fixed(run.wall)} s, ${width} cores`],
    ['models an hour', fixed((run.models / run.wall) * 3600, 0)],
    ['CPU seconds a model', fixed(run.cpu / run.models, 2)],
    ['of the rate that CPU seconds allow', percent(run.cpu / (width * run.wall))],
    ['the same without what other programs took of the cores', percent(run.cpu / ours)],
    ['cores busy while models were converted, without what others took', percent(cores.computed / (cores.available - cores.taken))],
    ['idle, by reason', Object.entries(cores.idle).map(([why, seconds]) => `${why} ${percent(seconds / cores.available)}`).join(', ')],
    ['peak memory', `${gigabytes(run.peak)}, ${gigabytes(memory.admittedAtPeak)} estimated`],
    ['bound by', bound],
    ['stages, by time', run.report.stages.map(({ stage, share }) => `${stage} ${percent(share)}`).join(', ')],
  ];
}

/// Models of at most so many triangles, as Blender reads them, in an archive of their own.
function smaller(archive, folder, models, scale, most) {
  fs.rmSync(folder, { recursive: true, force: true });
  const readable = /\.(ply|obj|glb|stl)$/;
  return sizes(models, scale).flatMap((triangles, i) => {
    const name = String(i).padStart(5, '0');
    const file = fs.readdirSync(path.join(archive, name), { recursive: true }).find((each) => readable.test(each));
    if (triangles > most || !file) return [];
    fs.cpSync(path.join(archive, name), path.join(folder, name), { recursive: true });
    return [path.join(folder, name, file)];
  });
}

/// One bake, and how far its file is from the original; that is not timed.
function bakeByBlender(file, out, vitrine) {
  const script = path.join(ROOT, 'perf/peers/blender_bake.py');
  const bake = timed('blender', ['--background', '--factory-startup', '--python-exit-code', '3', '--python', script, '--', file, out]);
  if (bake.status !== 0) throw new Error(`Blender failed at ${file}:\n${bake.said.slice(-2000)}`);
  const { mse1e4 } = JSON.parse(execFileSync(vitrine, ['evaluate', file, out, '--json'], { encoding: 'utf8', maxBuffer: 1 << 26 })).measure;
  console.error(`Blender: ${path.basename(file)} ${fixed(bake.cpu)} CPU s, ${fixed(bake.wall)} s, MSE x 10^4 ${fixed(mse1e4, 2)}`);
  return { cpu: bake.cpu, wall: bake.wall, bytes: fs.statSync(out).size, mse: mse1e4 };
}

/// One model after the other: each bake is parallel inside. By CPU seconds, the ratio grants Blender cores that are never idle.
function againstBlender(files, scratch, run, vitrine) {
  const sums = { cpu: 0, wall: 0, bytes: 0, ratio: 0 };
  for (const file of files) {
    const bake = bakeByBlender(file, path.join(scratch, 'blender.glb'), vitrine);
    const ours = run.report.rows.find(({ input }) => file.endsWith(`/${input}`));
    for (const key of ['cpu', 'wall', 'bytes']) sums[key] += bake[key];
    sums.ratio += Math.log(bake.mse / ours.measure.mse1e4);
  }
  const n = files.length;
  const bytes = run.report.rows.reduce((sum, row) => sum + row.bytes.total, 0);
  return [
    ['models', n],
    ['Blender: CPU seconds a model, wall time', `${fixed(sums.cpu / n, 2)}, ${fixed(sums.wall / n, 2)} s`],
    ['Vitrine, search and certificate: CPU seconds a model, wall time', `${fixed(run.cpu / n, 2)}, ${fixed(run.wall / n, 2)} s`],
    ['models an hour, Vitrine : Blender, by wall time', fixed(sums.wall / run.wall)],
    ['the same by CPU seconds', fixed(sums.cpu / run.cpu)],
    ['KB a thumbnail, Blender and Vitrine', `${fixed(sums.bytes / n / 1e3)}, ${fixed(bytes / n / 1e3)}`],
    ['image error, Blender : Vitrine, geometric mean', fixed(Math.exp(sums.ratio / n))],
  ];
}

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    models: { type: 'string', default: '40' },
    scale: { type: 'string', default: '1' },
    scratch: { type: 'string', default: path.join(os.tmpdir(), 'vitrine-throughput') },
    blender: { type: 'string' },
    keep: { type: 'boolean', default: false },
    help: { type: 'boolean', default: false },
  },
});
if (values.help || !(values.models >= 2) || !(values.scale > 0)) {
  console.error(USAGE);
  process.exit(2);
}
const [models, scale, scratch] = [Number(values.models), Number(values.scale), path.resolve(values.scratch)];
const archive = path.join(scratch, 'archive');
const vitrine = path.join(PROGRAMS, 'vitrine');
const options = positionals.length ? ` -- ${positionals.join(' ')}` : '';
fs.mkdirSync(scratch, { recursive: true });
makeArchive(archive, models, scale, PROGRAMS);
if (!values.blender) {
  const run = convert(vitrine, archive, path.join(scratch, 'gallery'), positionals);
  tell('Throughput', `perf/throughput.mjs --models ${models} --scale ${scale}${options}`, table(figures(run)), values.keep);
} else {
  const files = smaller(archive, path.join(scratch, 'smaller'), models, scale, Number(values.blender));
  const same = convert(vitrine, path.join(scratch, 'smaller'), path.join(scratch, 'gallery'), positionals);
  tell('Against Blender', `perf/throughput.mjs --models ${models} --scale ${scale} --blender ${values.blender}${options}`, table(againstBlender(files, scratch, same, vitrine)), values.keep);
}
