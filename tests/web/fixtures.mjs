// SPDX-License-Identifier: Apache-2.0
// The GLBs under test, and what is expected of those that make_fixtures wrote.
import fs from 'node:fs';
import path from 'node:path';

export const folder = process.env.VITRINE_WEB_GLBS ?? '';

// All GLBs of the folder, sorted; a folder without any is a mistake.
export function glbs() {
  if (!folder) throw new Error('set VITRINE_WEB_GLBS to a folder of GLB files');
  const names = fs.readdirSync(folder, { recursive: true }).filter((name) => name.endsWith('.glb')).sort();
  if (!names.length) throw new Error(`no GLB in ${folder}`);
  return names.map((name) => path.join(folder, name));
}

export function expectations() {
  const file = path.join(folder, 'fixtures.json');
  const list = fs.existsSync(file) ? JSON.parse(fs.readFileSync(file, 'utf8')) : [];
  return new Map(list.map((entry) => [path.join(folder, entry.file), entry]));
}
