// SPDX-License-Identifier: Apache-2.0
// Reads what a debugger needs of a 32-bit little-endian ARM ELF: loadable segments and symbols.

import fs from 'node:fs';

const kLoad = 1; // p_type PT_LOAD
const kSymbolTable = 2; // sh_type SHT_SYMTAB

/**
 * @param {string} path
 * @returns {{segments: {address: number, bytes: Uint8Array}[], symbols: Map<string, number>}}
 *   segments at their load (not run) addresses, symbols without the Thumb bit
 */
export function readElf(path) {
  const bytes = fs.readFileSync(path);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  if (bytes.length < 52 || view.getUint32(0) !== 0x7f454c46 || view.getUint16(4) !== 0x0101) {
    throw new Error(`${path}: not a 32-bit little-endian ELF`);
  }
  return { segments: readSegments(bytes, view), symbols: readSymbols(bytes, view) };
}

function readSegments(bytes, view) {
  const segments = [];
  const table = { start: view.getUint32(28, true), entry: view.getUint16(42, true), count: view.getUint16(44, true) };
  for (let index = 0; index < table.count; index++) {
    const header = table.start + index * table.entry;
    const offset = view.getUint32(header + 4, true);
    const size = view.getUint32(header + 16, true);
    if (view.getUint32(header, true) === kLoad && size > 0) {
      segments.push({ address: view.getUint32(header + 12, true), bytes: bytes.subarray(offset, offset + size) });
    }
  }
  return segments;
}

function readSymbols(bytes, view) {
  const symbols = new Map();
  const table = { start: view.getUint32(32, true), entry: view.getUint16(46, true), count: view.getUint16(48, true) };
  const section = (index) => {
    const header = table.start + index * table.entry;
    const field = (offset) => view.getUint32(header + offset, true);
    return { type: field(4), offset: field(16), size: field(20), link: field(24) };
  };
  for (let index = 0; index < table.count; index++) {
    const { type, offset, size, link } = section(index);
    if (type !== kSymbolTable) continue;
    const names = section(link).offset;
    for (let symbol = offset; symbol < offset + size; symbol += 16) {
      const name = names + view.getUint32(symbol, true);
      const text = bytes.toString('latin1', name, bytes.indexOf(0, name));
      const isFunction = (bytes[symbol + 12] & 0xf) === 2;
      const value = view.getUint32(symbol + 4, true);
      if (text) symbols.set(text, isFunction ? (value & ~1) >>> 0 : value);
    }
  }
  return symbols;
}
