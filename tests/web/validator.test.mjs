// SPDX-License-Identifier: Apache-2.0
// Every GLB of the folder $VITRINE_WEB_GLBS is free of errors and warnings in the Khronos validator.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import { validateBytes } from 'gltf-validator';

import { glbs } from './fixtures.mjs';

const SEVERITIES = ['error', 'warning'];

/** The validator knows no AVIF, and says so twice of each such image. */
function isOfAvif({ code, pointer }, json) {
  const image = /^\/images\/(\d+)/.exec(pointer ?? '');
  return Boolean(image) && json.images[image[1]].mimeType === 'image/avif' && ['VALUE_NOT_IN_LIST', 'IMAGE_UNRECOGNIZED_FORMAT'].includes(code);
}

function jsonOf(bytes) {
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
}

async function issues(bytes) {
  const json = jsonOf(bytes);
  const report = await validateBytes(new Uint8Array(bytes), { maxIssues: 100 });
  return report.issues.messages
    .filter((message) => message.severity <= 1 && !isOfAvif(message, json))
    .map(({ severity, code, pointer, message }) => `${SEVERITIES[severity]}: ${code} ${pointer ?? ''}: ${message}`);
}

for (const file of glbs()) {
  test(`${path.basename(file)} is valid`, async () => {
    assert.deepEqual(await issues(fs.readFileSync(file)), []);
  });
}

test('the validator sees a wrong bound', async (t) => {
  const plain = glbs().find((file) => file.endsWith('cube.plain.glb'));
  if (!plain) {
    t.skip('no fixture here');
    return;
  }
  const bytes = fs.readFileSync(plain);
  const digit = bytes.indexOf('"max":[') + '"max":['.length;
  bytes[digit] = bytes[digit] === 0x31 ? 0x32 : 0x31;
  assert.notDeepEqual(await issues(bytes), []);
});
