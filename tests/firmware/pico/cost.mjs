// SPDX-License-Identifier: Apache-2.0
// cost.mjs: what a sample and a solve cost the Pico, in cycles of the emulated processor (cycle timing of the
// Cortex-M0+, without the flash cache's misses).

import { Board, samplesOf } from './board.mjs';
import { boardWithRig } from './rig.mjs';
import { Swing } from './swing.mjs';

const kHz = 125e6, kPeriodSeconds = 0.05, kSeconds = 20;

const swing = new Swing(kSeconds + 3);

/** Cycles that are not slept through, for each sample. */
function cyclesPerSample(board) {
  board.run(2);
  const slept = board.emulator.sleptNanos;
  const samples = samplesOf(board.run(kSeconds)).length;
  return ((kSeconds - (board.emulator.sleptNanos - slept) * 1e-9) * kHz) / samples;
}

const sampling = cyclesPerSample(new Board({ pins: swing.pins() }));
const solvingBoard = boardWithRig(swing);
const all = cyclesPerSample(solvingBoard);
const stackFree = solvingBoard.status().stack_free_bytes;

function row(what, cycles) {
  const microseconds = (cycles / kHz) * 1e6;
  const percent = (100 * cycles) / kHz / kPeriodSeconds;
  console.log(`${what.padEnd(52)} ${cycles.toFixed(0).padStart(8)} ${microseconds.toFixed(0).padStart(6)} ` +
    `${percent.toFixed(2).padStart(6)}`);
}
console.log(`${''.padEnd(52)}   cycles     us  % of 50 ms`);
row('a sample: window, frame, USB and UART', sampling);
row('its angles: filter, response, Gauss-Newton, frame', all - sampling);
console.log(`\nstack never used, a rig uploaded and solved with: ${stackFree} bytes`);
