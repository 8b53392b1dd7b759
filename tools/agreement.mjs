#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
// Does the measure of `vitrine evaluate` agree with an independent referee in a browser? Compares both over a gallery's thumbnails.
// The referee is any program that is called and answers as docs/agreement.md says. Exit code 0: they agree, 1: not everywhere.
import { execFile } from 'node:child_process';
import crypto from 'node:crypto';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs, promisify } from 'node:util';
import { putInto, table } from './marked_page.mjs';

const USAGE = `usage: tools/agreement.mjs --referee SCRIPT.mjs --models ARCHIVE --gallery GALLERY [OPTION...]
  --vitrine PROGRAM  the program (build/release/vitrine)
  --page FILE        put the table between the marks of this page (docs/agreement.md)
  --cache FOLDER     keep the referee's answers there
  --only TEXT        only inputs whose path contains this; the page is left alone`;
const ROOT = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
const SETTINGS = [
  { name: 'turntable', set: 'turntable', views: '32', light: 'head' },
  { name: 'sphere', set: 'sphere', views: '24', light: 'head' },
  { name: 'sphere, side light', set: 'sphere', views: '24', light: 'side' },
];
const LIMITS = { mse: (theirs) => Math.max(0.05, 0.05 * theirs), ssim: () => 0.005 };

function options() {
  const text = { type: 'string' };
  const { values } = parseArgs({
    options: {
      referee: text, models: text, gallery: text, cache: text, only: text,
      vitrine: { ...text, default: path.join(ROOT, 'build/release/vitrine') }, page: { ...text, default: path.join(ROOT, 'docs/agreement.md') },
    },
  });
  if (!values.referee || !values.models || !values.gallery) throw new Error(USAGE);
  return values;
}

async function answer(program, args) {
  const { stdout } = await promisify(execFile)(program, args, { maxBuffer: 1 << 28 });
  return JSON.parse(stdout);
}

async function ours({ vitrine }, original, thumb, { set, views, light }) {
  const { measure } = await answer(vitrine, ['evaluate', original, thumb, '--json', '--views', set, '--count', views, '--light', light]);
  return { mse: measure.mse1e4, ssim: measure.ssim };
}

async function theirs({ referee, cache }, original, thumb, { set, views, light }) {
  const args = ['--original', original, '--set', set, '--views', views, '--light', light];
  const key = crypto.createHash('sha256').update(JSON.stringify(args)).update(fs.readFileSync(thumb)).digest('hex').slice(0, 32);
  const kept = cache && path.join(cache, `${key}.json`);
  if (kept && fs.existsSync(kept)) return JSON.parse(fs.readFileSync(kept, 'utf8'));
  const { thumbs: [found] } = await answer(process.execPath, [referee, ...args, '--thumb', thumb, '--json']);
  const figures = { mse: found.mse1e4, ssim: found.ssim };
  if (kept) {
    fs.mkdirSync(cache, { recursive: true });
    fs.writeFileSync(kept, JSON.stringify(figures));
  }
  return figures;
}

async function measured(given, input, thumb, setting) {
  const [a, b] = [await ours(given, input.file, thumb, setting), await theirs(given, input.file, thumb, setting)];
  const off = Object.keys(LIMITS).filter((k) => Math.abs(a[k] - b[k]) > LIMITS[k](b[k]));
  const row = { name: input.name, setting: setting.name, ours: a, theirs: b, off };
  process.stderr.write(`${cells(row).join('  ')}\n`);
  return row;
}

function cells({ name, setting, ours: a, theirs: b, off }) {
  const part = b.mse > 0 ? `${(100 * (a.mse / b.mse - 1)).toFixed(1)} %` : '';
  return [name, setting, a.mse.toFixed(3), b.mse.toFixed(3), part, a.ssim.toFixed(4), b.ssim.toFixed(4), (a.ssim - b.ssim).toFixed(4), off.length ? `**${off.join(', ')}**` : 'yes'];
}

function answers(rows) {
  const head = ['input', 'views', 'MSE', "referee's", 'difference', 'SSIM', "referee's", 'difference', 'agree'];
  const apart = rows.filter((r) => r.off.length).length;
  return `${table(head, rows.map(cells), 2)}\n\n${rows.length - apart} of ${rows.length} agree.`;
}

async function main() {
  const given = options();
  const report = JSON.parse(fs.readFileSync(path.join(given.gallery, 'report.json'), 'utf8'));
  const rows = [];
  for (const { input, thumb, status } of report.rows) {
    if (status !== 'done' || (given.only && !input.includes(given.only))) continue;
    for (const setting of SETTINGS)
      rows.push(await measured(given, { name: input, file: path.join(given.models, input) }, path.join(given.gallery, thumb), setting));
  }
  const text = answers(rows);
  console.log(text);
  if (!given.only) putInto(given.page, 'tools/agreement.mjs', text);
  process.exitCode = rows.some((r) => r.off.length) ? 1 : 0;
}

main().catch((e) => {
  console.error(e.message);
  process.exitCode = 2;
});
