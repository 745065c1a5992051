// SPDX-License-Identifier: Apache-2.0
// The Pico's image starts: second boot stage, USB enumeration, Hello, Status, first sample.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { FrameSplitter } from '../emulator/wire.mjs';
import { Board, ResetCause, assertUnbroken, kLightPin, kRestarted, only, samplesOf } from './board.mjs';

test('says who it is, in the first message', () => {
  const board = new Board({ uniqueId: Uint8Array.of(1, 2, 3, 4, 5, 6, 7, 8) });
  const [hello] = board.run(0.3);
  assert.equal(hello.name, 'Hello');
  assert.equal(hello.board, 'pico');
  assert.match(hello.firmware, /^\d+\.\d+\.\d+$/);
  assert.deepEqual([...hello.unique_id], [1, 2, 3, 4, 5, 6, 7, 8]);
  assert.equal(hello.protocol, 1);
  assert.equal(hello.rate_millihz, 20000);
  assert.equal(hello.full_scale_counts, 65535);
  assert.equal(hello.reference_uv, 3300000);
  assert.equal(hello.sensor_count, 2);
  board.assertSound();
});

test('is 1209:0001 "Penduline" on USB, with the unique id as serial number', () => {
  const board = new Board({ uniqueId: Uint8Array.of(0x0e, 0x66, 0, 0, 0xab, 0xcd, 0xef, 0x12) });
  const { device, strings } = board.port.attach();
  assert.deepEqual([...device.slice(8, 12)], [0x09, 0x12, 0x01, 0x00]);
  assert.deepEqual(strings.slice(1), ['Penduline', 'Penduline', '0E660000ABCDEF12']);
  board.assertSound();
});

test('samples within a tenth of a second of its start, the first one flagged restarted', () => {
  const board = new Board();
  const samples = samplesOf(board.run(0.5));
  assert.equal(samples[0].seq, 0n);
  assert.ok(samples[0].t_us < 100_000n);
  assert.deepEqual(samples.slice(0, 3).map((sample) => sample.flags), [kRestarted, 0, 0]);
  board.assertSound();
});

test('tells its state once a second', () => {
  const board = new Board();
  const [first, second] = only('Status', board.run(2.5));
  assert.equal(first.reset_cause, ResetCause.powerOn);
  assert.equal(second.resets, 0);
  assert.equal(second.fault_pc, 0);
  assert.equal(second.store, 0);
  assert.ok(Math.abs(second.temperature_cdeg - 2700) < 20, `${second.temperature_cdeg}`);
  board.assertSound();
});

test('sends the same frames by UART0', () => {
  const board = new Board();
  board.run(2);
  const messages = new FrameSplitter().messages(Uint8Array.from(board.emulator.uart.bytes));
  assert.equal(messages[0].name, 'Hello');
  const samples = samplesOf(messages);
  assert.ok(samples.length >= 38);
  assertUnbroken(samples);
  board.assertSound();
});

test('flashes its light once a second', () => {
  const board = new Board();
  let flashes = 0;
  let lit = false;
  for (let i = 0; i < 300; i++) {
    board.run(0.01);
    const now = board.emulator.pinLevel(kLightPin);
    flashes += now && !lit ? 1 : 0;
    lit = now;
  }
  assert.equal(flashes, 3);
});

for (const rate of [1, 20]) {
  test(`flickers when it is to be found, also at ${rate} Hz`, () => {
    const board = new Board();
    board.run(0.2);
    board.command('SetRate', { rate_millihz: 1000 * rate });
    board.command('Identify', { seconds: 2 });
    let changes = 0;
    let lit = board.emulator.pinLevel(kLightPin);
    for (let i = 0; i < 100; i++) {
      board.run(0.01);
      changes += board.emulator.pinLevel(kLightPin) !== lit ? 1 : 0;
      lit = board.emulator.pinLevel(kLightPin);
    }
    assert.ok(changes >= 8 && changes <= 12, `${changes}`);
  });
}
