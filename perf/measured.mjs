// SPDX-License-Identifier: Apache-2.0
// Programs run and measured, and what is kept of it for each machine.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

export const ROOT = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '..');
export const PROGRAMS = path.join(ROOT, 'build/release');

/// CPU seconds (user and system) and wall time of a program and its children.
export function timed(command, args) {
  const shell = 'TIMEFORMAT="%U %S %R"; time "$@" >"$0" 2>&1';
  const log = path.join(os.tmpdir(), `vitrine-perf-${process.pid}.log`);
  const run = spawnSync('bash', ['-c', shell, log, command, ...args], { encoding: 'utf8' });
  const said = fs.readFileSync(log, 'utf8');
  fs.rmSync(log);
  const [user, system, wall] = run.stderr.trim().split('\n').pop().split(' ').map(Number);
  return { cpu: user + system, wall, said, status: run.status };
}

/// One conversion into a new gallery, with the figures of its report.
export function convert(vitrine, archive, gallery, options = []) {
  fs.rmSync(gallery, { recursive: true, force: true });
  const run = timed(vitrine, ['convert', archive, '--out', gallery, ...options]);
  if (run.status !== 0) throw new Error(`vitrine convert ended with ${run.status}:\n${run.said}`);
  const report = JSON.parse(fs.readFileSync(path.join(gallery, 'report.json'), 'utf8'));
  return { ...run, report, models: report.done, peak: report.peakMemory };
}

export const fixed = (number, digits = 1) => number.toFixed(digits);
export const percent = (share) => `${(100 * share).toFixed(1)} %`;
export const gigabytes = (bytes) => `${(bytes / 1e9).toFixed(2)} GB`;
export const table = (rows) => ['| | |', '|---|---|', ...rows.map(([what, figure]) => `| ${what} | ${figure} |`)].join('\n');

/// Prints, and with `keep` puts it under its heading in results/<cpu model>.md, in place of what stood there.
export function tell(heading, command, body, keep) {
  const section = `## ${heading}\n\n    ${command}\n\n${body}\n`;
  console.log(section);
  if (!keep) return;
  const cpu = os.cpus()[0].model.trim();
  const file = path.join(ROOT, 'perf/results', `${cpu.toLowerCase().replace(/[^a-z0-9]+/g, '-')}.md`);
  const title = `# ${cpu}, ${os.cpus().length} cores, ${Math.round(os.totalmem() / 2 ** 30)} GB\n\n`;
  const old = fs.existsSync(file) ? fs.readFileSync(file, 'utf8') : title;
  const kept = old.split(/^(?=## )/m).filter((part) => !part.startsWith(`## ${heading}\n`)).map((part) => part.trimEnd());
  fs.mkdirSync(path.dirname(file), { recursive: true });
  fs.writeFileSync(file, [...kept, section].join('\n\n'));
}
