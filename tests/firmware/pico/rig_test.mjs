// SPDX-License-Identifier: Apache-2.0
// A rig on the board: uploaded, stored, solved with, damaged.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import { crc32 } from '../emulator/wire.mjs';
import { Board, Result, assertUnbroken, only, samplesOf } from './board.mjs';
import { boardWithRig as boardWithRigFor, imageFor, partsOf, upload } from './rig.mjs';
import { Swing, penduline, readCsv, rig } from './swing.mjs';

const kStoreOffset = 2 * 1024 * 1024 - 4096;
const Store = { empty: 0, valid: 1, damaged: 2 };

const swing = new Swing(10);

const image = imageFor(swing);
const boardWithRig = () => boardWithRigFor(swing, image);

test('without a rig there are no angles', () => {
  const board = new Board();
  assert.equal(only('Angles', board.run(2)).length, 0);
  assert.equal(board.status().store, Store.empty);
});

test('with a rig the board solves: its angles are the host\'s on the same samples, to 1e-5 rad', () => {
  const board = boardWithRig();
  board.run(0.5);
  const messages = board.run(8);
  const samples = samplesOf(messages);
  assertUnbroken(samples);
  const recording = path.join(swing.folder, 'board.csv');
  fs.writeFileSync(recording, [
    '# penduline_recording = 1', '# rate_hz = 20.0', '# full_scale_counts = 65535', '# reference_v = 3.3',
    'seq,t_us,x_on,x_off,y_on,y_off,flags',
    ...samples.map((s) => [s.seq, s.t_us, s.x_on, s.x_off, s.y_on, s.y_off, s.flags].join(',')), ''].join('\n'));
  const output = path.join(swing.folder, 'host.csv');
  penduline('replay', recording, '--rig', rig, '--output', output);
  const host = new Map(readCsv(output).map((row) => [row.seq, row]));
  let worst = 0;
  let compared = 0;
  for (const angles of only('Angles', messages)) {
    const row = host.get(Number(angles.seq));
    if (!row || row.theta1_rad === null) continue; // the host's filter is still filling
    compared++;
    assert.equal(angles.flags, row.flags);
    assert.ok(Math.abs(Number(angles.t_us) - row.t_s * 1e6) <= 1);
    worst = Math.max(worst, Math.abs(angles.theta1_rad - row.theta1_rad), Math.abs(angles.theta2_rad - row.theta2_rad));
  }
  assert.ok(compared > 140, `${compared}`);
  assert.ok(worst <= 1e-5, `${worst} rad apart`);
  board.assertSound();
});

test('what the board says of the pendulum is true to a tenth of a degree', () => {
  const board = boardWithRig();
  const angles = only('Angles', board.run(8)).filter((each) => !Number.isNaN(each.theta1_rad));
  const truth = readCsv(swing.truthFile);
  let squares = 0;
  for (const each of angles) {
    const row = truth[Math.round(Number(each.t_us) * 1e-6 * swing.rate)];
    squares += (each.theta1_rad - row.theta1_rad) ** 2 + (each.theta2_rad - row.theta2_rad) ** 2;
  }
  const rmsDegrees = (Math.sqrt(squares / (2 * angles.length)) * 180) / Math.PI;
  assert.ok(angles.length > 130);
  assert.ok(rmsDegrees < 0.1, `${rmsDegrees} degrees RMS`);
});

test('a filter that fills gives no angles, as NaN', () => {
  const board = boardWithRig();
  const [first] = only('Angles', board.run(0.1));
  assert.ok(Number.isNaN(first.theta1_rad) && Number.isNaN(first.theta2_rad));
});

test('the rig survives a reset', () => {
  const board = boardWithRig();
  board.emulator.pressReset();
  const messages = board.run(2);
  assert.equal(only('Status', messages)[0].store, Store.valid);
  assert.ok(only('Angles', messages).length > 30);
  board.assertSound();
});

test('a rig that is erased is gone, also after a reset', () => {
  const board = boardWithRig();
  assert.equal(board.command('EraseRig').reply.result, Result.done);
  assert.equal(board.status().store, Store.empty);
  board.emulator.pressReset();
  const messages = board.run(1);
  assert.equal(only('Status', messages)[0].store, Store.empty);
  assert.equal(only('Angles', messages).length, 0);
});

test('a store with any damaged byte is reported and ignored', () => {
  const board = boardWithRig();
  for (const offset of [0, 3, 4, 5, 6, 9, 10, 20, 10 + image.length - 1]) {
    board.emulator.mcu.flash[kStoreOffset + offset] ^= 0x10;
    board.emulator.pressReset();
    const messages = board.run(0.5);
    assert.equal(only('Status', messages)[0].store, Store.damaged, `byte ${offset}`);
    assert.equal(only('Angles', messages).length, 0);
    assert.ok(samplesOf(messages).length > 5, 'sampling goes on');
    board.emulator.mcu.flash[kStoreOffset + offset] ^= 0x10;
  }
  board.emulator.pressReset();
  assert.equal(only('Status', board.run(0.5))[0].store, Store.valid);
  board.assertSound();
});

test('an upload is refused by name, and the stored rig stays', () => {
  const board = boardWithRig();
  const begin = (size) => board.command('BeginRig', { size_bytes: size, crc: 0 }).reply.result;
  const part = (offset, count) => board.command('RigPart', { offset, count, bytes: new Uint8Array(48) }).reply.result;
  const end = () => board.command('EndRig').reply.result;
  assert.equal(end(), Result.noUpload);
  assert.equal(part(0, 48), Result.noUpload);
  assert.equal(begin(0), Result.outOfRange);
  assert.equal(begin(1025), Result.outOfRange);
  assert.equal(begin(100), Result.done);
  assert.equal(end(), Result.incomplete);
  assert.equal(part(48, 48), Result.incomplete);
  assert.equal(part(0, 49), Result.outOfRange);
  assert.equal(part(96, 48), Result.outOfRange);
  assert.equal(upload(board, image, { crc: 1 }).reply.result, Result.damaged);
  assert.equal(upload(board, new Uint8Array(60).fill(7)).reply.result, Result.invalidRig);
  assert.equal(board.status().store, Store.valid);
  assert.ok(only('Angles', board.run(1)).length > 18);
});

test('uploading, storing and solving leave an eighth of the stack', () => {
  const board = boardWithRig();
  board.run(2);
  const { stack_free_bytes } = board.status();
  assert.ok(stack_free_bytes >= 512, `${stack_free_bytes} bytes were never used`);
});

test('a piece that comes twice changes nothing', () => {
  const board = new Board({ pins: swing.pins() });
  board.run(0.2);
  board.command('BeginRig', { size_bytes: image.length, crc: crc32(image) });
  for (const part of partsOf(image)) {
    for (let i = 0; i < 2; i++) board.command('RigPart', part);
  }
  assert.equal(board.command('EndRig').reply.result, Result.done);
});

test('one solve takes at most 5 % of a 20 Hz period', () => {
  const busy = (board) => {
    board.run(3);
    return only('Status', board.run(1.5)).at(-1).load_permille;
  };
  const without = new Board({ pins: swing.pins() });
  without.run(0.2);
  const solving = busy(boardWithRig()) - busy(without);
  assert.ok(solving <= 50, `${solving} thousandths of the time`);
});
