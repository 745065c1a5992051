// SPDX-License-Identifier: Apache-2.0
// The Pico resets itself where it must, comes back and says why.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Board, ResetCause, kRestarted, only, samplesOf } from './board.mjs';

const kTimerInterruptEnable = 0x40054038;
const kClearAlias = 0x3000;

/** What the board says after it has reset itself within some seconds. */
function afterReset(board, seconds) {
  const before = board.emulator.resets;
  const messages = [];
  for (let i = 0; i < seconds * 10 && board.emulator.resets === before; i++) messages.push(...board.run(0.1));
  assert.equal(board.emulator.resets, before + 1, 'no reset');
  messages.push(...board.run(1));
  const start = messages.findLastIndex((message) => message.name === 'Hello');
  const after = messages.slice(start);
  return { hello: after[0], status: only('Status', after)[0], samples: samplesOf(after) };
}

test('windows that stop coming: the watchdog resets within 10 s', () => {
  const board = new Board();
  const [hello] = only('Hello', board.run(1));
  board.emulator.mcu.writeUint32(kTimerInterruptEnable + kClearAlias, 1);
  const after = afterReset(board, 10);
  assert.equal(after.status.reset_cause, ResetCause.watchdog);
  assert.equal(after.status.resets, 1);
  assert.notEqual(after.hello.boot_id, hello.boot_id);
  assert.equal(after.samples[0].flags & kRestarted, kRestarted);
  assert.equal(after.samples[0].seq, 0n);
  assert.ok(after.samples.length > 10);
});

test('a UART that stops sending: the watchdog resets, too', () => {
  const board = new Board();
  board.run(1);
  const kUartCtrl = 0x40034030;
  board.emulator.mcu.writeUint32(kUartCtrl, 0);
  assert.equal(afterReset(board, 10).status.reset_cause, ResetCause.watchdog);
  for (const finding of board.emulator.findings.splice(0)) assert.match(finding, /UART0 sends while it is not enabled|into a full transmit FIFO/);
});

test('a fault is told with its place', () => {
  const board = new Board();
  board.run(1);
  const core = board.emulator.mcu.core;
  while (core.waiting) board.emulator.run(1e-4);
  const place = core.PC & ~1;
  core.registers[15] = 0x60000000; // where nothing is
  const { status } = afterReset(board, 5);
  assert.equal(status.reset_cause, ResetCause.fault);
  assert.notEqual(status.fault_pc, 0);
  assert.ok(place);
  assert.equal(board.emulator.faults.splice(0).length, 1);
});

test('the command Reboot restarts and says so', () => {
  const board = new Board();
  board.run(0.5);
  board.command('Reboot', { target: 0 });
  const { status } = afterReset(board, 1);
  assert.equal(status.reset_cause, ResetCause.software);
  board.assertSound();
});

test('a reset by the pin is told, and clears nothing that counts', () => {
  const board = new Board();
  board.run(0.5);
  board.emulator.pressReset();
  const [status] = only('Status', board.run(1));
  assert.equal(status.reset_cause, ResetCause.external);
  assert.equal(status.resets, 1);
  board.assertSound();
});

test('five resets in a row are counted', () => {
  const board = new Board();
  for (let i = 1; i <= 5; i++) {
    board.run(0.3);
    board.command('Reboot', { target: 0 });
    assert.equal(afterReset(board, 1).status.resets, i);
  }
});

test('the stack is never used up', () => {
  const board = new Board();
  board.run(1);
  for (const command of ['AskHello', 'AskStatus', 'EraseRig', 'EndRig']) board.command(command);
  board.command('SetRate', { rate_millihz: 1_000_000 });
  board.run(1);
  const { stack_free_bytes } = board.status();
  assert.ok(stack_free_bytes >= 512, `${stack_free_bytes} bytes were never used`);
});
