// SPDX-License-Identifier: Apache-2.0
// From the pendulum at the Pico's pins to the host's angles.

import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import { root } from './board.mjs';
import { Swing, penduline, readCsv, rig } from './swing.mjs';

const folder = new Swing(1).folder;
const stream = execFileSync('node', [path.join(root, 'tests/firmware/pico/stream.mjs'), '10', folder]);
const bytes = path.join(folder, 'board.bytes');
const angles = path.join(folder, 'angles.csv');
fs.writeFileSync(bytes, stream);

test('the host\'s angles are the pendulum\'s, to a tenth of a degree', () => {
  penduline('run', `serial:${bytes}`, '--rig', rig, '--output', angles);
  const rows = readCsv(angles).filter((row) => row.theta1_rad !== null);
  const truth = readCsv(path.join(folder, 'truth.csv'));
  assert.ok(rows.length > 180);
  let squares = 0;
  for (const row of rows) {
    const at = truth[Math.round(row.t_s * 2000)];
    squares += (row.theta1_rad - at.theta1_rad) ** 2 + (row.theta2_rad - at.theta2_rad) ** 2;
  }
  const rmsDegrees = (Math.sqrt(squares / (2 * rows.length)) * 180) / Math.PI;
  assert.ok(rmsDegrees < 0.1, `${rmsDegrees} degrees RMS`);
});

test('a recording of the board replays byte for byte', () => {
  const recording = path.join(folder, 'board.csv');
  const live = penduline('run', `serial:${bytes}`, '--rig', rig, '--record', recording);
  assert.equal(penduline('replay', recording, '--rig', rig), live);
  assert.match(fs.readFileSync(recording, 'utf8'), /^# board = "pico"$/m);
});

test('noise before and within the stream costs the frames that it hits, and is told', () => {
  const noisy = path.join(folder, 'noisy.bytes');
  const at = 3000;
  fs.writeFileSync(noisy, Buffer.concat([Buffer.from('AT\r\n'), stream.subarray(0, at), Buffer.from([1, 2, 3]),
    stream.subarray(at)]));
  const done = spawnSync(process.env.PENDULINE ?? path.join(root, 'build/release/penduline'),
    ['run', `serial:${noisy}`, '--rig', rig, '--strict', '--output', '/dev/null'], { encoding: 'utf8' });
  assert.match(done.stderr, /noisy.bytes: [12] damaged frames/);
  assert.match(done.stderr, / [01] lost,/);
  assert.equal(done.status, 3);
});
