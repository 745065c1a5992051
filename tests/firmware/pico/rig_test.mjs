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

const images = { gn: imageFor(swing), ekf: imageFor(swing, 'ekf') };
const image = images.gn;
const boardWithRig = (estimator = 'gn') => boardWithRigFor(swing, images[estimator]);

test('without a rig there are no angles', () => {
  const board = new Board();
  assert.equal(only('Angles', board.run(2)).length, 0);
  assert.equal(board.status().store, Store.empty);
});

/** A board that begins to estimate now, and all that it says of `seconds`. */
function estimated(estimator, seconds) {
  const board = boardWithRig(estimator);
  const { reply, messages } = board.command('SetRate', { rate_millihz: 20000 }); // has it read its rig anew
  return { board, messages: [...messages.slice(messages.indexOf(reply) + 1), ...board.run(seconds)] };
}

/** The rows that the host makes of the samples, by their seq. */
function hostRows(estimator, samples) {
  const recording = path.join(swing.folder, 'board.csv');
  fs.writeFileSync(recording, [
    '# penduline_recording = 1', '# rate_hz = 20.0', '# full_scale_counts = 65535', '# reference_v = 3.3',
    'seq,t_us,x_on,x_off,y_on,y_off,flags',
    ...samples.map((s) => [s.seq, s.t_us, s.x_on, s.x_off, s.y_on, s.y_off, s.flags].join(',')), ''].join('\n'));
  const output = path.join(swing.folder, 'host.csv');
  penduline('replay', recording, '--rig', rig, '--estimator', estimator, '--output', output);
  return new Map(readCsv(output).map((row) => [row.seq, row]));
}

const kAngles = ['theta1_rad', 'theta2_rad'];
const kRatesAndSigmas = ['omega1_rad_s', 'omega2_rad_s', 'sigma1_rad', 'sigma2_rad'];
const kColumns = { gn: kAngles, ekf: [...kAngles, ...kRatesAndSigmas] };

for (const [estimator, columns] of Object.entries(kColumns)) {
  test(`with a rig the board solves by ${estimator}: its angles are the host's on the same samples, to 1e-5 rad`, () => {
    const { board, messages } = estimated(estimator, 8);
    const samples = samplesOf(messages);
    assertUnbroken(samples);
    const host = hostRows(estimator, samples);
    const worst = { theta_rad: 0, omega_rad_s: 0, sigma_rad: 0 };
    let compared = 0;
    for (const angles of only('Angles', messages)) {
      const row = host.get(Number(angles.seq));
      assert.equal(angles.flags, row.flags);
      if (row.theta1_rad === null) continue; // the filter is filling
      compared++;
      assert.ok(Math.abs(Number(angles.t_us) - row.t_s * 1e6) <= 1);
      for (const name of columns) {
        const kind = name.replace(/[12]/, '');
        worst[kind] = Math.max(worst[kind], Math.abs(angles[name] - row[name]));
      }
      for (const name of kRatesAndSigmas.filter((name) => !columns.includes(name))) {
        assert.ok(Number.isNaN(angles[name]) && row[name] === null, name);
      }
    }
    assert.ok(compared > 140, `${compared}`);
    assert.ok(worst.theta_rad <= 1e-5 && worst.omega_rad_s <= 1e-4 && worst.sigma_rad <= 1e-5, JSON.stringify(worst));
    board.assertSound();
  });
}

for (const [estimator, mostDegrees] of [['gn', 0.1], ['ekf', 0.05]]) {
  test(`what the board says of the pendulum by ${estimator} is true to ${mostDegrees} degrees`, () => {
    const board = boardWithRig(estimator);
    board.run(1);
    const angles = only('Angles', board.run(7)).filter((each) => !Number.isNaN(each.theta1_rad));
    const truth = readCsv(swing.truthFile);
    let squares = 0;
    for (const each of angles) {
      const row = truth[Math.round(Number(each.t_us) * 1e-6 * swing.rate)];
      squares += (each.theta1_rad - row.theta1_rad) ** 2 + (each.theta2_rad - row.theta2_rad) ** 2;
    }
    const rmsDegrees = (Math.sqrt(squares / (2 * angles.length)) * 180) / Math.PI;
    assert.ok(angles.length > 130);
    assert.ok(rmsDegrees < mostDegrees, `${rmsDegrees} degrees RMS`);
  });

  test(`the rig for ${estimator} survives a reset, and that it is for ${estimator}`, () => {
    const board = boardWithRig(estimator);
    board.emulator.pressReset();
    const messages = board.run(2);
    assert.equal(only('Status', messages)[0].store, Store.valid);
    const angles = only('Angles', messages);
    assert.ok(angles.length > 30);
    assert.equal(Number.isNaN(angles.at(-1).sigma1_rad), estimator === 'gn');
    board.assertSound();
  });
}

test('a filter that fills gives no angles, as NaN; the Kalman filter has none to fill', () => {
  const first = (estimator) => only('Angles', boardWithRig(estimator).run(0.1))[0];
  assert.ok(Number.isNaN(first('gn').theta1_rad) && Number.isNaN(first('gn').theta2_rad));
  assert.ok(Math.abs(first('ekf').theta1_rad) < 0.2);
});

test('a rig of the first version is taken, for gn', () => {
  const kAppended = 1 + 2 * 8 + 6 * 4; // the estimator, two sensors' noise, the trust
  const old = Buffer.from(images.ekf.subarray(0, -kAppended));
  old[0] = 1;
  const angles = only('Angles', boardWithRigFor(swing, old).run(2));
  assert.ok(!Number.isNaN(angles.at(-1).theta1_rad) && Number.isNaN(angles.at(-1).sigma1_rad));
});

test('the Kalman filter runs up to 100 Hz; faster the samples go first', () => {
  const board = boardWithRig('ekf');
  for (const [rate, angles] of [[100, 100], [101, 0], [1000, 0]]) {
    assert.equal(board.command('SetRate', { rate_millihz: rate * 1000 }).reply.result, Result.done);
    board.run(0.5);
    const messages = board.run(1);
    assertUnbroken(samplesOf(messages));
    assert.ok(Math.abs(samplesOf(messages).length - rate) <= 1);
    assert.ok(Math.abs(only('Angles', messages).length - angles) <= 1, `${rate} Hz`);
  }
  assert.equal(board.status().overruns, 0);
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

for (const estimator of ['gn', 'ekf']) {
  test(`uploading, storing and solving by ${estimator} leave an eighth of the stack`, () => {
    const board = boardWithRig(estimator);
    board.run(2);
    const { stack_free_bytes } = board.status();
    assert.ok(stack_free_bytes >= 512, `${stack_free_bytes} bytes were never used`);
  });
}

test('a piece that comes twice changes nothing', () => {
  const board = new Board({ pins: swing.pins() });
  board.run(0.2);
  board.command('BeginRig', { size_bytes: image.length, crc: crc32(image) });
  for (const part of partsOf(image)) {
    for (let i = 0; i < 2; i++) board.command('RigPart', part);
  }
  assert.equal(board.command('EndRig').reply.result, Result.done);
});

for (const [estimator, mostPercent] of [['gn', 5], ['ekf', 10]]) {
  test(`angles by ${estimator} take at most ${mostPercent} % of a 20 Hz period`, () => {
    const busy = (board) => {
      board.run(3);
      return only('Status', board.run(1.5)).at(-1).load_permille;
    };
    const without = new Board({ pins: swing.pins() });
    without.run(0.2);
    const solving = busy(boardWithRig(estimator)) - busy(without);
    assert.ok(solving > 0 && solving <= 10 * mostPercent, `${solving} thousandths of the time`);
  });
}
