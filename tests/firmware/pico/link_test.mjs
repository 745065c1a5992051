// SPDX-License-Identifier: Apache-2.0
// The Pico's links: hosts that are absent, deaf, noisy or in a hurry.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { FrameSplitter, encode, encodeBody } from '../emulator/wire.mjs';
import { Board, ResetCause, Result, assertUnbroken, only, samplesOf } from './board.mjs';

test('data flows whatever DTR says', () => {
  const board = new Board();
  for (const dtr of [false, true, false]) {
    board.run(0.2);
    board.port.setLineState({ dtr });
    assert.ok(samplesOf(board.run(1)).length >= 19, `DTR ${dtr}`);
  }
  board.assertSound();
});

test('nobody reads for a minute: the oldest whole frames go, are counted and told', () => {
  const board = new Board();
  const before = samplesOf(board.run(1));
  board.port.stopReading();
  board.run(60);
  board.port.resumeReading();
  const messages = board.run(2);
  const samples = samplesOf(messages);
  const status = only('Status', messages).at(-1);
  // What was on its way when the host went deaf still comes; then the newest.
  const all = [...before, ...samples];
  const gaps = all.slice(1).map((sample, i) => sample.seq - all[i].seq - 1n).filter((gap) => gap > 0n);
  assert.equal(gaps.length, 1, `${gaps}`);
  assert.ok(gaps[0] > 1000n, `${gaps}`);
  const gapAt = all.findIndex((sample, i) => i > 0 && sample.seq !== all[i - 1].seq + 1n);
  assert.ok(gapAt - before.length < 20, `the newest are kept, not ${gapAt - before.length} of the oldest`);
  assert.ok(BigInt(status.dropped_frames) >= gaps[0], `${status.dropped_frames} frames, ${gaps[0]} samples`);
  assert.ok(status.dropped_frames <= Number(gaps[0]) + 70, 'each frame that is missing is counted once');
  assert.equal(status.overruns, 0, 'sampling went on');
  board.assertSound();
});

test('a host that comes late finds the newest samples and learns the rest by asking', () => {
  const board = new Board();
  board.port.unplug();
  board.run(30);
  board.port.plug();
  board.port.attach();
  board.run(0.1); // what was on its way when it went, and what waited
  const { messages } = board.command('AskHello');
  assert.equal(only('Hello', messages).length, 1);
  const samples = samplesOf([...messages, ...board.run(1)]);
  assertUnbroken(samples);
  assert.ok(samples.at(-1).seq > 590n);
});

test('the host goes and comes back ten times', () => {
  const board = new Board();
  for (let i = 0; i < 10; i++) {
    board.run(0.3);
    board.port.unplug();
    board.run(0.5);
    board.port.plug();
    board.port.attach();
  }
  assertUnbroken(samplesOf(board.run(1)).slice(-15));
  assert.equal(board.status().resets, 0);
  board.assertSound();
});

for (const [what, restart] of [['clears the halts', (port) => port.clearHalts()],
  ['sets the data interface', (port) => port.setInterface(1)], ['sets the other interface', (port) => port.setInterface(0)]]) {
  test(`a host that ${what} loses nothing and goes on with DATA0`, () => {
    const board = new Board();
    for (let i = 0; i < 8; i++) { // with either turn of DATA0 and DATA1, and a packet that waits
      board.port.stopReading();
      board.run(0.05 + 0.013 * i);
      restart(board.port); // with the right turn of DATA0 and DATA1, or the strict host complains
      board.port.resumeReading();
      assert.equal(board.command('AskHello').reply.result, Result.done);
    }
    board.assertSound();
    assert.equal(board.status().dropped_frames, 0);
  });
}

test('whatever its length, what the board says is handed on at once', () => {
  const board = new Board();
  board.run(0.2);
  board.command('SetRate', { rate_millihz: 1_000 });
  board.run(0.1);
  for (let count = 1; count <= 40; count++) {
    board.port.stopReading(); // so that the answers wait for each other and fill their packets
    for (let i = 0; i < count; i++) board.port.write(encode('Ping', { token: i }));
    board.run(0.02);
    board.port.resumeReading();
    assert.equal(only('Pong', board.run(0.02)).length, count);
  }
  board.assertSound();
});

test('a bus that is suspended, or reset for long, is no fault', () => {
  const board = new Board();
  board.run(1);
  board.port.suspend();
  board.run(20);
  assert.equal(board.emulator.resets, 0);
  board.port.resume();
  board.run(1);
  board.port.stopReading();
  board.port.host.holdReset();
  board.run(20);
  assert.equal(board.emulator.resets, 0);
});

for (const [when, wait] of [['idle', 0], ['with a packet on its way', 0.2]]) {
  test(`a controller that hangs ${when} is one: the watchdog begins anew`, () => {
    const board = new Board();
    board.run(1);
    board.port.stopReading();
    board.run(wait);
    board.port.hang();
    board.run(10);
    assert.equal(board.emulator.resets, 1);
    board.port.resumeReading();
    board.port.attach();
    board.run(1);
    assert.equal(board.status().reset_cause, ResetCause.watchdog);
  });
}

test('a ping is answered by the clock', () => {
  const board = new Board();
  board.run(0.5);
  board.port.write(encode('Ping', { token: 0xdeadbeef }));
  const [pong] = only('Pong', board.run(0.02));
  assert.equal(pong.token, 0xdeadbeef);
  const now = board.emulator.seconds * 1e6;
  assert.ok(Number(pong.t_us) > now - 25_000 && Number(pong.t_us) < now);
});

test('garbage costs nothing but itself', () => {
  const board = new Board();
  board.run(0.2);
  let seed = 1;
  const noise = Uint8Array.from({ length: 4096 }, () => (seed = (seed * 1103515245 + 12345) >>> 0) >>> 24);
  board.port.write(noise);
  board.port.write(Uint8Array.of(0));
  board.port.flush();
  assert.equal(board.command('AskHello').reply.result, Result.done);
  assert.ok(board.status().bad_frames > 0);
  assertUnbroken(samplesOf(board.run(1)));
  board.assertSound();
});

test('a command cut at any byte costs itself only', () => {
  const board = new Board();
  board.run(0.2);
  const command = encode('SetRate', { token: 99, rate_millihz: 50_000 });
  for (let length = 1; length < command.length - 1; length++) {
    board.port.write(Uint8Array.of(...command.slice(0, length), 0));
  }
  const { reply, messages } = board.command('AskStatus');
  assert.equal(reply.result, Result.done);
  assert.equal(messages.filter((message) => message.token === 99).length, 0);
  assert.equal(only('Status', messages).at(-1).bad_frames, command.length - 2);
  assert.equal(board.status().rate_millihz, 20000);
});

test('a command with one bit wrong costs itself only', () => {
  const board = new Board();
  board.run(0.2);
  const command = encode('SetRate', { token: 99, rate_millihz: 50_000 });
  for (let bit = 0; bit < 8 * (command.length - 1); bit++) {
    const damaged = Uint8Array.from(command);
    damaged[bit >> 3] ^= 1 << (bit & 7);
    board.port.write(damaged);
  }
  board.port.flush();
  assert.equal(board.command('AskStatus').reply.result, Result.done);
  assert.equal(board.status().rate_millihz, 20000);
});

test('a flood of commands is answered one by one, and no sample is lost', () => {
  const board = new Board();
  board.run(0.2);
  for (let i = 0; i < 500; i++) board.port.write(encode('AskStatus', { token: i & 0xff }));
  const messages = board.run(5);
  assert.equal(only('Reply', messages).length, only('Reply', messages).filter((r) => r.result === 0).length);
  assert.ok(only('Reply', messages).length === 500, `${only('Reply', messages).length} replies`);
  assert.equal(board.status().overruns, 0);
  board.assertSound();
});

test('a command that is unknown or too short is refused by name', () => {
  const board = new Board();
  board.run(0.2);
  const { reply } = board.command('AskHello');
  assert.equal(reply.command, 0x42);
  const frames = [
    [[0x7f, 5], Result.unknownCommand],
    [[0x44, 5, 1], Result.wrongLength],
  ];
  for (const [body, result] of frames) {
    board.port.write(encodeBody(Uint8Array.from(body)));
    const [refusal] = only('Reply', board.run(0.02));
    assert.deepEqual([refusal.command, refusal.token, refusal.result], [body[0], 5, result]);
  }
});

test('commands come by UART0, too, and are answered there', () => {
  const board = new Board();
  board.run(0.2);
  board.emulator.uart.bytes.length = 0;
  board.emulator.uart.write(encode('AskHello', { token: 3 }));
  board.run(0.1);
  const messages = new FrameSplitter().messages(Uint8Array.from([0, ...board.emulator.uart.bytes]));
  assert.equal(only('Hello', messages).length, 1);
  assert.equal(only('Reply', messages)[0].token, 3);
  board.assertSound();
});

test('1200 baud and DTR let go lead to the bootloader, any other rate does not', () => {
  const board = new Board();
  board.run(0.2);
  board.port.setLineCoding(115200);
  board.port.setLineState({ dtr: true });
  board.port.setLineState({ dtr: false });
  board.run(0.3);
  assert.equal(board.emulator.bootloader, false);
  board.port.touch1200();
  board.emulator.run(0.3);
  assert.equal(board.emulator.bootloader, true);
});

test('the command Reboot leads to the bootloader after its reply', () => {
  const board = new Board();
  board.run(0.2);
  assert.equal(board.command('Reboot', { target: 1 }).reply.result, Result.done);
  board.emulator.run(0.3);
  assert.equal(board.emulator.bootloader, true);
});
