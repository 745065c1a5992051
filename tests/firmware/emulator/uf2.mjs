// SPDX-License-Identifier: Apache-2.0
// Reads a UF2 file, what a user copies to the board's drive (github.com/microsoft/uf2).

import fs from 'node:fs';

const kBlockBytes = 512, kPayloadAt = 32, kFamilyRp2040 = 0xe48bff56;
const kMagics = [[0, 0x0a324655], [4, 0x9e5d5157], [508, 0x0ab16f30]];

/**
 * @param {string} path
 * @returns {{address: number, bytes: Uint8Array}[]} the blocks' payloads
 */
export function readUf2(path) {
  const file = fs.readFileSync(path);
  if (file.length === 0 || file.length % kBlockBytes) {
    throw new Error(`${path}: ${file.length} bytes, expected whole blocks of 512`);
  }
  const count = file.length / kBlockBytes;
  return Array.from({ length: count }, (_, number) => {
    const block = file.subarray(number * kBlockBytes, (number + 1) * kBlockBytes);
    const field = (offset, expected, what) => {
      const found = block.readUInt32LE(offset);
      if (found !== expected) throw new Error(`${path}: block ${number}: ${what} is ${found}, expected ${expected}`);
    };
    for (const [offset, magic] of kMagics) field(offset, magic, `magic at byte ${offset}`);
    field(20, number, 'number');
    field(24, count, 'count of blocks');
    field(28, kFamilyRp2040, 'family');
    return { address: block.readUInt32LE(12), bytes: block.subarray(kPayloadAt, kPayloadAt + block.readUInt32LE(16)) };
  });
}
