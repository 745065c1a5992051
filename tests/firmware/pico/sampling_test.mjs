// SPDX-License-Identifier: Apache-2.0
// What the Pico samples: every window, at its time, the values that stood at its pins.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Board, EmitterMode, Result, assertUnbroken, kFullScale, kLate, kOverrun, kSaturated, kTopCode, samplesOf }
  from './board.mjs';
import { Swing } from './swing.mjs';

const kCountsPerCode = kFullScale / kTopCode;

test('60 s of a swing at 20 Hz: no sample lost or late, each what was at the pins', () => {
  const swing = new Swing(61);
  const board = new Board({ pins: swing.pins() });
  const samples = samplesOf(board.run(60.2));
  assert.ok(samples.length >= 1200, `${samples.length}`);
  assertUnbroken(samples);
  for (let i = 1; i < samples.length; i++) {
    const step = Number(samples[i].t_us - samples[i - 1].t_us);
    assert.ok(Math.abs(step - 50_000) <= 2, `sample ${i} came after ${step} us`);
  }
  let worst = 0;
  for (const sample of samples) {
    const seconds = Number(sample.t_us) * 1e-6;
    worst = Math.max(worst, Math.abs(sample.x_on - sample.x_off - swing.counts(0, seconds)),
      Math.abs(sample.y_on - sample.y_off - swing.counts(1, seconds)));
  }
  // Half a code for rounding each lit conversion, half for each dark one.
  assert.ok(worst <= kCountsPerCode, `${worst} counts`);
  assert.ok(board.status().late_max_us <= 20);
  board.assertSound();
});

test('both channels refer to one moment, the middle of the window', () => {
  // Ramps of 4 codes a microsecond: 2 us apart would be 8 codes.
  const ramp = (seconds) => (seconds * 1e6 * 4) % 200_000;
  const board = new Board({ pins: (channel, seconds) => ramp(seconds) / 50 });
  board.run(0.1);
  board.command('SetEmitter', { mode: EmitterMode.lit });
  const samples = samplesOf(board.run(2)).slice(3);
  let compared = 0;
  for (const sample of samples) {
    const middle = ramp(Number(sample.t_us) * 1e-6) / 50;
    if (middle < 100 || middle > 3900) continue; // the ramp turns round within the window
    compared++;
    const codes = [sample.x_on / kCountsPerCode, sample.y_on / kCountsPerCode];
    assert.ok(Math.abs(codes[0] - codes[1]) < 0.1, `${codes}`);
    assert.ok(Math.abs(codes[0] - middle) < 0.5, `${codes[0]}, expected ${middle}`);
  }
  assert.ok(compared > 20);
});

test('a rate of 1 kHz is held, and 1 Hz', () => {
  const board = new Board();
  board.run(0.2);
  for (const [rate, seconds, period] of [[1_000_000, 2, 1000n], [1000, 5, 1_000_000n]]) {
    assert.equal(board.command('SetRate', { rate_millihz: rate }).reply.result, Result.done);
    board.run(1.1);
    const samples = samplesOf(board.run(seconds));
    assert.ok(Math.abs(samples.length - (seconds * rate) / 1000) <= 1, `${samples.length}`);
    assertUnbroken(samples);
    for (let i = 1; i < samples.length; i++) {
      const off = samples[i].t_us - samples[i - 1].t_us - period;
      assert.ok(off >= -20n && off <= 20n, `${off} us off`);
    }
    assert.equal(board.status().rate_millihz, rate);
  }
  board.assertSound();
});

test('a rate out of range is refused and changes nothing', () => {
  const board = new Board();
  board.run(0.2);
  for (const rate of [0, 999, 1_000_001, 0xffffffff]) {
    assert.equal(board.command('SetRate', { rate_millihz: rate }).reply.result, Result.outOfRange);
  }
  assert.equal(board.status().rate_millihz, 20000);
});

test('the emitters are lit in the middle of a window only, and ambient light is measured beside', () => {
  // Ambient light that is there in the dark phase only ends up in x_off alone.
  const board = new Board({ pins: (channel, seconds, lit) => (lit ? 2000 : 300 + channel) });
  const [, sample] = samplesOf(board.run(0.3));
  assert.equal(sample.x_on, Math.round(2000 * kCountsPerCode));
  assert.equal(sample.y_on, Math.round(2000 * kCountsPerCode));
  assert.equal(sample.x_off, Math.round(300 * kCountsPerCode));
  assert.equal(sample.y_off, Math.round(301 * kCountsPerCode));
});

test('emitters always lit measure no ambient light, never lit nothing else', () => {
  const board = new Board({ pins: (channel, seconds, lit) => (lit ? 2000 : 300) });
  board.run(0.2);
  for (const [mode, on, off] of [[EmitterMode.lit, 2000, 0], [EmitterMode.dark, 300, 300]]) {
    assert.equal(board.command('SetEmitter', { mode }).reply.result, Result.done);
    board.run(0.1);
    const [sample] = samplesOf(board.run(0.3));
    assert.equal(sample.x_on, Math.round(on * kCountsPerCode));
    assert.equal(sample.x_off, Math.round(off * kCountsPerCode));
  }
  assert.equal(board.command('SetEmitter', { mode: 3 }).reply.result, Result.outOfRange);
});

test('a conversion at the end of the range is flagged', () => {
  const board = new Board({ pins: (channel, seconds) => (seconds > 0.3 && seconds < 0.4 ? 5000 : 1000) });
  const flags = samplesOf(board.run(0.6)).map((sample) => sample.flags & kSaturated);
  assert.equal(flags.filter((flag) => flag !== 0).length, 2);
});

test('a window that an interrupt lock swallowed is a gap of seq, flagged and counted', () => {
  const board = new Board();
  board.run(0.2);
  board.command('SetRate', { rate_millihz: 1_000_000 });
  const before = samplesOf(board.run(0.05));
  // Erasing the store keeps interrupts off for as long as the flash takes.
  const { messages } = board.command('EraseRig');
  const samples = [...before.slice(-1), ...samplesOf([...messages, ...board.run(0.2)])];
  const gaps = samples.slice(1).map((sample, i) => sample.seq - samples[i].seq - 1n);
  gaps.forEach((lost, i) => assert.equal((samples[i + 1].flags & kOverrun) !== 0, lost > 0n));
  const after = gaps.findIndex((lost) => lost > 0n) + 1;
  assert.ok(gaps[after - 1] > 30n, 'the lock was shorter than thought');
  assert.equal(BigInt(board.status().overruns), gaps.reduce((sum, lost) => sum + lost, 0n));
  // The first one is late by a period at most; soon they are in step again.
  const lateOf = (sample) => sample.t_us - samples[0].t_us - (sample.seq - samples[0].seq) * 1000n;
  assert.ok(samples[after].flags & kLate);
  assert.ok(lateOf(samples[after]) > 125n && lateOf(samples[after]) <= 1020n);
  samples.slice(after + 2).forEach((sample) => assert.ok(lateOf(sample) <= 20n && sample.flags === 0));
});

test('a window that is held up half-way is flagged, and only that one', () => {
  const board = new Board();
  board.run(0.2);
  board.command('SetRate', { rate_millihz: 5_000 });
  const seen = new Set();
  // Erasing takes some 50 ms with interrupts off. Its command comes a little later against the windows each time.
  for (let early = 1.4e-3; early > 0; early -= 0.1e-3) {
    const last = samplesOf(board.run(0.5)).at(-1);
    board.run(Number(last.t_us) / 1e6 + 0.2 - early - board.emulator.seconds);
    const { messages } = board.command('EraseRig');
    const flags = samplesOf([...messages, ...board.run(0.5)]).map((sample) => sample.flags);
    assert.ok(flags.filter((flag) => flag !== 0).length <= 1);
    flags.forEach((flag) => seen.add(flag));
  }
  assert.deepEqual([...seen].sort(), [0, kLate]);
  assert.equal(board.status().overruns, 0);
});

test('the 32-bit microsecond counter wraps after 71.6 minutes without a trace', () => {
  const wrap = 2 ** 32;
  const board = new Board({ timerMicros: wrap - 5e6 });
  const samples = samplesOf(board.run(10));
  assertUnbroken(samples);
  assert.ok(samples.at(-1).t_us > BigInt(wrap) + 4_000_000n);
  for (let i = 1; i < samples.length; i++) {
    assert.ok(samples[i].t_us - samples[i - 1].t_us <= 50_020n);
  }
  board.assertSound();
});
