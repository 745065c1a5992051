// SPDX-License-Identifier: Apache-2.0
// A swing of the simulated rig as codes at the ADC's pins, made by `penduline simulate`.

import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { kFullScale, kTopCode, root } from './board.mjs';

const program = process.env.PENDULINE ?? path.join(root, 'build/release/penduline');
export const rig = path.join(root, 'docs/rigs/tcrt5000.toml');

/** Rows of a CSV file as objects of numbers. */
export function readCsv(file) {
  const [names, ...rows] = fs.readFileSync(file, 'utf8').split('\n').filter((line) => line && !line.startsWith('#'))
    .map((line) => line.split(','));
  return rows.map((row) => Object.fromEntries(names.map((name, i) => [name, row[i] === '' ? null : Number(row[i])])));
}

export class Swing {
  /** @param {number} seconds how long; @param {string[]} start options of `penduline simulate` */
  constructor(seconds, start = ['--theta-deg', '10', '--phi-deg', '30', '--psi', '3']) {
    this.folder = fs.mkdtempSync(path.join(os.tmpdir(), 'penduline-swing-'));
    process.on('exit', () => fs.rmSync(this.folder, { recursive: true }));
    this.rate = 2000;
    this.truthFile = path.join(this.folder, 'truth.csv');
    const recording = path.join(this.folder, 'recording.csv');
    execFileSync(program, ['simulate', ...start, '--ideal', '--rate', `${this.rate}`, '--seconds', `${seconds}`,
      '--rig', rig, '--output', recording, '--truth', this.truthFile], { stdio: ['ignore', 'ignore', 'pipe'] });
    const rows = readCsv(recording);
    this.signals = [rows.map((row) => row.x_on), rows.map((row) => row.y_on)];
  }

  /** What a lit sensor adds to the ambient light, in counts of full scale. */
  counts(channel, seconds) {
    const place = Math.min(seconds * this.rate, this.signals[channel].length - 1.001);
    const before = Math.floor(place);
    const [low, high] = this.signals[channel].slice(before, before + 2);
    return low + (place - before) * (high - low);
  }

  /** For `Board`: the swing with some ambient light, in codes. */
  pins(ambientCode = 100) {
    return (channel, seconds, lit) =>
      ambientCode + (lit ? (this.counts(channel, seconds) * kTopCode) / kFullScale : 0);
  }
}

/** Runs the host's program; returns its output. */
export function penduline(...options) {
  return execFileSync(program, options, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
}
