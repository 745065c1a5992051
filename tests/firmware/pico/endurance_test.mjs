// SPDX-License-Identifier: Apache-2.0
// Hours of streaming at 20 Hz in virtual time: every sample is accounted for. 3 hours take two to three
// minutes of an idle core; PENDULINE_HOURS=24 node --test endurance_test.mjs runs a day.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Board, only, samplesOf } from './board.mjs';

const kHours = Number(process.env.PENDULINE_HOURS ?? 3);
const kPieceSeconds = 60;

test(`${kHours} hours at 20 Hz: no sample lost, late or out of step`, () => {
  const board = new Board();
  let next = 0n;
  let firstUs = 0n;
  let status = null;
  for (let piece = 0; piece < (kHours * 3600) / kPieceSeconds; piece++) {
    const messages = board.run(kPieceSeconds);
    board.emulator.uart.bytes.length = 0;
    for (const sample of samplesOf(messages)) {
      assert.equal(sample.seq, next);
      firstUs = next === 0n ? sample.t_us : firstUs;
      const off = sample.t_us - firstUs - next * 50_000n;
      assert.ok(off >= -20n && off <= 20n, `sample ${next} is ${off} us out of step`);
      next++;
    }
    status = only('Status', messages).at(-1);
  }
  assert.ok(next >= BigInt(kHours * 3600 * 20 - 20), `${next} samples`);
  assert.equal(status.overruns, 0);
  assert.equal(status.dropped_frames, 0);
  assert.equal(status.resets, 0);
  board.assertSound();
});
