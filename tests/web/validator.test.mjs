// SPDX-License-Identifier: Apache-2.0
// Every GLB of the folder $VITRINE_WEB_GLBS is free of errors and warnings in the Khronos validator, but for one warning.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import { validateBytes } from 'gltf-validator';

import { glbs } from './fixtures.mjs';

// Said of any normal map without TANGENT. The bake reckons with the frame that clients then build (stages/tangent_frame.h).
const ACCEPTED = 'MESH_PRIMITIVE_GENERATED_TANGENT_SPACE';

const SEVERITIES = ['error', 'warning'];

async function issues(bytes) {
  const report = await validateBytes(new Uint8Array(bytes), { maxIssues: 100 });
  return report.issues.messages
    .filter(({ severity, code }) => severity <= 1 && code !== ACCEPTED)
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
