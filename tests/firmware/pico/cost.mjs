// SPDX-License-Identifier: Apache-2.0
// cost.mjs: what a sample and its angles by each estimator cost the Pico, in cycles of the emulated processor (cycle
// timing of the Cortex-M0+, without the flash cache's misses). Fails where a bar is passed.

import assert from 'node:assert/strict';
import { Board, only } from './board.mjs';
import { boardWithRig, imageFor } from './rig.mjs';
import { Swing } from './swing.mjs';

const kHz = 125e6, kPeriodSeconds = 0.05, kSeconds = 20;
const kMostPercent = { gn: 5, ekf: 10 };

const swing = new Swing(kSeconds + 4);
/** The same, that somebody pushes halfway: it goes on at another place, at another speed. */
const pushed = { pins: () => (channel, seconds, lit) =>
  swing.pins()(channel, seconds < kSeconds / 2 ? seconds : seconds + 0.4, lit) };

/** Cycles that are not slept through in each sample's period, but for those about a Status. */
function cyclesOf(board) {
  board.run(2);
  const periods = Array.from({ length: kSeconds / kPeriodSeconds }, () => {
    const slept = board.emulator.sleptNanos;
    const messages = board.run(kPeriodSeconds);
    const cycles = (kPeriodSeconds - (board.emulator.sleptNanos - slept) * 1e-9) * kHz;
    return { cycles, samples: only('Sample', messages).length, statuses: only('Status', messages).length };
  });
  assert.equal(periods.reduce((sum, period) => sum + period.samples, 0), periods.length);
  return periods.filter(({ statuses }, i) => statuses + (periods[i + 1]?.statuses ?? 1) === 0)
    .map(({ cycles }) => cycles);
}

const mean = (numbers) => numbers.reduce((sum, number) => sum + number, 0) / numbers.length;

/** Percent of a period. */
function row(what, cycles) {
  const percent = (100 * cycles) / kHz / kPeriodSeconds;
  console.log(`${what.padEnd(62)} ${cycles.toFixed(0).padStart(8)} ${((cycles / kHz) * 1e6).toFixed(0).padStart(6)} ` +
    `${percent.toFixed(2).padStart(6)}`);
  return percent;
}

console.log(`${''.padEnd(62)}   cycles     us  % of 50 ms`);
const sampling = cyclesOf(new Board({ pins: swing.pins() }));
row('a sample: window, frame, USB and UART', mean(sampling));
const stackFree = [];
for (const [estimator, what] of [
  ['gn', 'filter, response, Gauss-Newton, frame'],
  ['ekf', 'response, Kalman filter, frame'],
]) {
  const board = boardWithRig(pushed, imageFor(swing, estimator));
  const all = cyclesOf(board);
  const percent = row(`its angles by ${estimator}: ${what}`, mean(all) - mean(sampling));
  const longest = row(`  the longest, of a pendulum that is pushed`, Math.max(...all) - mean(sampling));
  if (!(percent > 0.1 && Math.max(percent, longest) <= kMostPercent[estimator])) {
    console.error(`error: ${estimator}: expected ${kMostPercent[estimator]} % at most`);
    process.exitCode = 1;
  }
  stackFree.push(`${estimator} ${board.status().stack_free_bytes}`);
}
console.log(`\nstack never used, a rig uploaded and solved with: ${stackFree.join(', ')} bytes`);
