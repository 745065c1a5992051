// SPDX-License-Identifier: Apache-2.0
// The Pico's real image in the emulator, with what the tests of it share.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { CdcPort } from '../emulator/cdc.mjs';
import { Emulator } from '../emulator/rp2040.mjs';
import { FrameSplitter, encode } from '../emulator/wire.mjs';

export const root = path.resolve(path.dirname(new URL(import.meta.url).pathname), '../../..');
const build = process.env.PICO_BUILD ?? path.join(root, 'build/pico');
/** What a user copies to the board. */
export const image = path.join(build, 'penduline-pico.uf2');

export const kEmitterPin = 15, kLightPin = 25, kTemperatureChannel = 4;
export const kTopCode = 4095, kFullScale = 65535;
/** The chip at 27 degrees Celsius: 0.706 V of 3.3 V. */
export const kTemperatureCode = 876;

/** Flags of a sample (docs/formats.md). */
export const kSaturated = 1, kOverrun = 2, kRestarted = 4, kLate = 8;

/** Names of Reply.result, from docs/protocol.md. */
export const Result = {
  done: 0, unknownCommand: 1, wrongLength: 2, outOfRange: 3, notSupported: 4, busy: 5, storeFailed: 6, noUpload: 7,
  incomplete: 8, damaged: 9, invalidRig: 10,
};
export const EmitterMode = { switched: 0, lit: 1, dark: 2 };
export const ResetCause = { powerOn: 0, external: 1, watchdog: 2, software: 3, fault: 4, assertion: 5 };

/** Those of the test that runs. */
const boards = [];

/** No test passes over what silicon, the USB host or the emulator has to say against the firmware. */
if (process.argv[1].endsWith('_test.mjs')) { // elsewhere `node:test` would write to stdout
  const { afterEach } = await import('node:test');
  afterEach(() => {
    for (const board of boards.splice(0)) assert.deepEqual(board.emulator.problems, []);
  });
}

/**
 * A board with nothing on its USB.
 * @param {object} [options] of the Emulator, and
 * @param {(channel: number, seconds: number, lit: boolean) => number} [options.pins] code at a sensor's pin
 * @param {string} [options.file] another image than the user's
 */
export function bareBoard({ pins = () => 1000, file = image, ...options } = {}) {
  assert.ok(fs.existsSync(file), `found no ${file}: build it with cmake --preset pico && cmake --build --preset pico`);
  const emulator = new Emulator(file, options);
  emulator.analog((channel, seconds) =>
    channel === kTemperatureChannel ? kTemperatureCode : pins(channel, seconds, emulator.pinLevel(kEmitterPin)));
  return emulator;
}

/** A board with a USB host that reads it. */
export class Board {
  /** @param {object} [options] of `bareBoard` */
  constructor(options) {
    this.emulator = bareBoard(options);
    this.port = new CdcPort(this.emulator);
    this.splitter = new FrameSplitter();
    boards.push(this);
  }

  /** Runs for some virtual seconds; returns the messages that came by USB. */
  run(seconds) {
    this.emulator.run(seconds);
    return this.splitter.messages(this.port.read());
  }

  /** Sends a command and returns its Reply, with all that came meanwhile. */
  command(name, fields = {}) {
    const token = (this.token = ((this.token ?? 0) + 1) & 0xff);
    this.port.write(encode(name, { token, ...fields }));
    const messages = [];
    for (let waited = 0; waited < 1; waited += 0.02) {
      messages.push(...this.run(0.02));
      const reply = messages.find((message) => message.name === 'Reply' && message.token === token);
      if (reply) return { reply, messages };
    }
    throw new Error(`no Reply to ${name} within a second`);
  }

  /** A Status asked for now. */
  status() {
    return this.command('AskStatus').messages.find((message) => message.name === 'Status');
  }

  /** Fails on problems, and on a frame that came damaged. */
  assertSound() {
    assert.deepEqual(this.emulator.problems, []);
    assert.equal(this.splitter.damaged, 0);
  }
}

export const samplesOf = (messages) => messages.filter((message) => message.name === 'Sample');
export const only = (name, messages) => messages.filter((message) => message.name === name);

/** Each sample follows on the one before. */
export function assertUnbroken(samples) {
  for (let i = 1; i < samples.length; i++) {
    assert.equal(samples[i].seq, samples[i - 1].seq + 1n, `after sample ${samples[i - 1].seq}`);
  }
}
