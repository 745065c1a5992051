// SPDX-License-Identifier: Apache-2.0
// stream.mjs SECONDS FOLDER: runs the Pico's image with a pendulum on its ADC pins; its USB bytes go to the
// standard output, the pendulum's truth to FOLDER/truth.csv.

import fs from 'node:fs';
import path from 'node:path';
import { Board } from './board.mjs';
import { Swing } from './swing.mjs';

const [seconds, folder] = [Number(process.argv[2]), process.argv[3]];
const swing = new Swing(seconds + 0.1);
fs.copyFileSync(swing.truthFile, path.join(folder, 'truth.csv'));
const board = new Board({ pins: swing.pins() });
for (let i = 0; i < seconds * 10; i++) {
  board.emulator.run(0.1);
  fs.writeSync(process.stdout.fd, board.port.read());
}
board.assertSound();
