// SPDX-License-Identifier: Apache-2.0
// cost.mjs: what a sample and a solve cost the Pico, in cycles of the emulated processor (cycle timing of the
// Cortex-M0+, without the flash cache's misses).

import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { crc32 } from '../emulator/wire.mjs';
import { Board, root, samplesOf } from './board.mjs';
import { Swing, rig } from './swing.mjs';

const kHz = 125e6, kPeriodSeconds = 0.05, kSeconds = 20, kPartBytes = 48;

const swing = new Swing(kSeconds + 3);

/** Cycles that are not slept through, for each sample. */
function cyclesPerSample(board) {
  board.run(2);
  const slept = board.emulator.sleptNanos;
  const samples = samplesOf(board.run(kSeconds)).length;
  return ((kSeconds - (board.emulator.sleptNanos - slept) * 1e-9) * kHz) / samples;
}

function boardWithRig() {
  const file = path.join(swing.folder, 'rig.image');
  execFileSync(path.join(root, 'build/release/rig_image'), [rig, file]);
  const image = fs.readFileSync(file);
  const board = new Board({ pins: swing.pins() });
  board.run(0.2);
  board.command('BeginRig', { size_bytes: image.length, crc: crc32(image) });
  for (let offset = 0; offset < image.length; offset += kPartBytes) {
    const bytes = new Uint8Array(kPartBytes);
    const piece = image.subarray(offset, offset + kPartBytes);
    bytes.set(piece);
    board.command('RigPart', { offset, count: piece.length, bytes });
  }
  board.command('EndRig');
  return board;
}

const sampling = cyclesPerSample(new Board({ pins: swing.pins() }));
const solvingBoard = boardWithRig();
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
