// SPDX-License-Identifier: Apache-2.0
// A rig for the board: its image, made by the host's code, and its upload, piece by piece.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { crc32 } from '../emulator/wire.mjs';
import { Board, Result, root } from './board.mjs';
import { rig } from './swing.mjs';

const kPartBytes = 48;

/** The image of the rig that swings are made with, for `gn` or `ekf`; the file goes into the swing's folder. */
export function imageFor(swing, estimator = 'gn') {
  const program = process.env.RIG_IMAGE ?? path.join(root, 'build/release/rig_image');
  const output = path.join(swing.folder, 'rig.image');
  execFileSync(program, [rig, output, estimator]);
  return fs.readFileSync(output);
}

/** The fields of each RigPart that an image takes. */
export function partsOf(image) {
  const parts = [];
  for (let offset = 0; offset < image.length; offset += kPartBytes) {
    const bytes = new Uint8Array(kPartBytes);
    const piece = image.subarray(offset, offset + kPartBytes);
    bytes.set(piece);
    parts.push({ offset, count: piece.length, bytes });
  }
  return parts;
}

/** Sends an image whole; returns what became of EndRig. */
export function upload(board, image, { crc = crc32(image) } = {}) {
  assert.equal(board.command('BeginRig', { size_bytes: image.length, crc }).reply.result, Result.done);
  for (const part of partsOf(image)) assert.equal(board.command('RigPart', part).reply.result, Result.done);
  return board.command('EndRig');
}

/** A board that knows the rig and sees the swing. */
export function boardWithRig(swing, image = imageFor(swing)) {
  const board = new Board({ pins: swing.pins() });
  board.run(0.2);
  assert.equal(upload(board, image).reply.result, Result.done);
  return board;
}
