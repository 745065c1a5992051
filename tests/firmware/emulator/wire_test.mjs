// SPDX-License-Identifier: Apache-2.0
// Shows that the test support's own wire protocol is right, by outside values and by damage.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { FrameSplitter, cobsDecode, cobsEncode, crc32, encode } from './wire.mjs';

const bytes = (...values) => Uint8Array.from(values);

test('CRC-32 of "123456789" is the catalogue value', () => {
  assert.equal(crc32(Buffer.from('123456789')), 0xcbf43926); // reveng.sourceforge.io, CRC-32/ISO-HDLC
});

test("COBS gives Wikipedia's examples", () => {
  const examples = [
    [bytes(0), bytes(1, 1)],
    [bytes(0, 0), bytes(1, 1, 1)],
    [bytes(0, 0x11, 0), bytes(1, 2, 0x11, 1)],
    [bytes(0x11, 0x22, 0, 0x33), bytes(3, 0x11, 0x22, 2, 0x33)],
    [bytes(0x11, 0x22, 0x33, 0x44), bytes(5, 0x11, 0x22, 0x33, 0x44)],
    [bytes(0x11, 0, 0, 0), bytes(2, 0x11, 1, 1, 1)],
  ];
  for (const [plain, encoded] of examples) {
    assert.deepEqual(cobsEncode(plain), encoded);
    assert.deepEqual(cobsDecode(encoded), plain);
  }
});

test('COBS holds around its blocks of 254', () => {
  for (const length of [253, 254, 255, 508, 509]) {
    const plain = Uint8Array.from({ length }, (_, index) => 1 + (index % 255));
    const encoded = cobsEncode(plain);
    assert.equal(encoded.includes(0), false);
    assert.equal(encoded.length, length + Math.ceil(length / 254));
    assert.deepEqual(cobsDecode(encoded), plain);
  }
});

test('a Ping has the bytes of the protocol', () => {
  const expected = '0a4104030201' + Buffer.from(uint32(crc32(bytes(0x41, 4, 3, 2, 1)))).toString('hex') + '00';
  assert.equal(Buffer.from(encode('Ping', { token: 0x01020304 })).toString('hex'), expected);
});

test('a message comes back through any cuts', () => {
  const sample = { seq: 2n ** 40n, t_us: 5n, x_on: 65535, x_off: 0, y_on: 256, y_off: 1, flags: 3 };
  const splitter = new FrameSplitter();
  const messages = [...encode('Sample', sample)].flatMap((byte) => splitter.messages([byte]));
  assert.deepEqual(messages, [{ name: 'Sample', ...sample }]);
});

test('a damaged frame costs that frame only', () => {
  const good = encode('Pong', { token: 1, t_us: 2n });
  for (let index = 0; index < good.length - 1; index++) {
    const bad = good.slice();
    bad[index] ^= 0x10;
    const splitter = new FrameSplitter();
    assert.equal(splitter.messages([0, ...bad, ...good]).length, 1, `byte ${index}`);
    assert.ok(splitter.damaged >= 1);
  }
});

test('longer payloads are read by their known start, shorter and unknown ones skipped', () => {
  const frame = (...content) => [...cobsEncode(bytes(...content, ...uint32(crc32(bytes(...content))))), 0];
  const splitter = new FrameSplitter();
  assert.deepEqual(splitter.messages(frame(0x06, 1, 2, 3, 99)), [{ name: 'Reply', command: 1, token: 2, result: 3 }]);
  assert.deepEqual(splitter.messages(frame(0x06, 1, 2)), []);
  assert.deepEqual(splitter.messages(frame(0x7f, 1, 2)), []);
  assert.equal(splitter.damaged, 0);
});

function uint32(value) {
  return bytes(value & 0xff, (value >> 8) & 0xff, (value >> 16) & 0xff, value >>> 24);
}
