// SPDX-License-Identifier: Apache-2.0
// pico_on_usb.mjs SOCKET FOLDER: runs the Pico's image in real time on the USB of the virtual machine that listens on
// SOCKET, with a pendulum on its ADC pins, whose truth goes to FOLDER/truth.csv. Ends with the machine; fails if silicon
// or the USB host had anything to say against the firmware.

import fs from 'node:fs';
import path from 'node:path';
import { bareBoard } from '../../firmware/pico/board.mjs';
import { Swing } from '../../firmware/pico/swing.mjs';
import { RedirectedBoard } from './redirected_board.mjs';

const kSliceMillis = 5, kMostMillis = 50; // a stall of this process is not caught up with
const [socket, folder] = process.argv.slice(2);
const swing = new Swing(30);
fs.copyFileSync(swing.truthFile, path.join(folder, 'truth.csv'));
const emulator = bareBoard({ pins: swing.pins() });

new RedirectedBoard(emulator, socket, () => {
  for (const problem of emulator.problems) console.error(problem);
  process.exit(emulator.problems.length === 0 ? 0 : 1);
});

let last = performance.now();
setInterval(() => {
  const now = performance.now();
  emulator.run(Math.min(now - last, kMostMillis) / 1000);
  last = now;
}, kSliceMillis);
