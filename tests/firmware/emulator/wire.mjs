// SPDX-License-Identifier: Apache-2.0
// The wire protocol (docs/protocol.md) written a second time, independently of common/wire, to test it.

const kCrcTable = Uint32Array.from({ length: 256 }, (_, index) => {
  let crc = index;
  for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  return crc;
});

/** One list of fields per message, in the order of their bytes: name -> type. */
const kMessages = {
  Hello: [0x01, {
    protocol: 'u8', board: 'text16', firmware: 'text16', unique_id: 'u8x8', boot_id: 'u32', tick_hz: 'u32',
    rate_millihz: 'u32', full_scale_counts: 'u16', reference_uv: 'u32', sensor_count: 'u8', emitter_mode: 'u8',
    window_us: 'u16', conversions: 'u16',
  }],
  Sample: [0x02, { seq: 'u64', t_us: 'u64', x_on: 'u16', x_off: 'u16', y_on: 'u16', y_off: 'u16', flags: 'u8' }],
  Status: [0x03, {
    t_us: 'u64', samples: 'u64', dropped_frames: 'u32', bad_frames: 'u32', overruns: 'u32', late_max_us: 'u16',
    load_permille: 'u16', temperature_cdeg: 'i16', stack_free_bytes: 'u16', reset_cause: 'u8', resets: 'u16',
    fault_pc: 'u32', fault_line: 'u16', fault_file: 'text16', store: 'u8', rate_millihz: 'u32', emitter_mode: 'u8',
  }],
  Angles: [0x04, {
    seq: 'u64', t_us: 'i64', theta1_rad: 'f32', theta2_rad: 'f32', residual_m: 'f32', flags: 'u32',
    omega1_rad_s: 'f32', omega2_rad_s: 'f32', sigma1_rad: 'f32', sigma2_rad: 'f32',
  }],
  Pong: [0x05, { token: 'u32', t_us: 'u64' }],
  Reply: [0x06, { command: 'u8', token: 'u8', result: 'u8' }],
  Ping: [0x41, { token: 'u32' }],
  AskHello: [0x42, { token: 'u8' }],
  AskStatus: [0x43, { token: 'u8' }],
  SetRate: [0x44, { token: 'u8', rate_millihz: 'u32' }],
  SetEmitter: [0x45, { token: 'u8', mode: 'u8' }],
  Identify: [0x46, { token: 'u8', seconds: 'u8' }],
  Reboot: [0x47, { token: 'u8', target: 'u8' }],
  BeginRig: [0x48, { token: 'u8', size_bytes: 'u16', crc: 'u32' }],
  RigPart: [0x49, { token: 'u8', offset: 'u16', count: 'u8', bytes: 'u8x48' }],
  EndRig: [0x4a, { token: 'u8' }],
  EraseRig: [0x4b, { token: 'u8' }],
};

const kNames = Object.fromEntries(Object.entries(kMessages).map(([name, [type]]) => [type, name]));

const bytesType = (count) => ({
  size: count,
  read: (view, at) => new Uint8Array(view.buffer, view.byteOffset + at, count).slice(),
  write: (view, at, value) => new Uint8Array(view.buffer, view.byteOffset, view.byteLength).set(value, at),
});

const textType = (count) => ({
  size: count,
  read: (view, at) => Buffer.from(bytesType(count).read(view, at)).toString('latin1').replace(/\0.*$/s, ''),
  write: (view, at, value) => bytesType(count).write(view, at, Buffer.from(value, 'latin1')),
});

const numberType = (size, kind) => ({
  size,
  read: (view, at) => view[`get${kind}`](at, true),
  write: (view, at, value) => view[`set${kind}`](at, value, true),
});

const kTypes = {
  u8: numberType(1, 'Uint8'),
  u16: numberType(2, 'Uint16'),
  u32: numberType(4, 'Uint32'),
  u64: numberType(8, 'BigUint64'),
  i16: numberType(2, 'Int16'),
  i64: numberType(8, 'BigInt64'),
  f32: numberType(4, 'Float32'),
  u8x8: bytesType(8),
  u8x48: bytesType(48),
  text16: textType(16),
};

/** CRC-32/ISO-HDLC: zlib's. */
export function crc32(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = (crc >>> 8) ^ kCrcTable[(crc ^ byte) & 0xff];
  return (crc ^ 0xffffffff) >>> 0;
}

/** COBS (Cheshire and Baker 1999), without the zero that ends a frame. */
export function cobsEncode(bytes) {
  const encoded = [0];
  let code = 0; // where the present block's length goes
  for (const byte of bytes) {
    if (encoded.length - code === 0xff) {
      encoded[code] = 0xff;
      code = encoded.push(0) - 1;
    }
    if (byte !== 0) {
      encoded.push(byte);
    } else {
      encoded[code] = encoded.length - code;
      code = encoded.push(0) - 1;
    }
  }
  encoded[code] = encoded.length - code;
  return Uint8Array.from(encoded);
}

/** @returns {Uint8Array | null} null if it is no COBS */
export function cobsDecode(bytes) {
  const decoded = [];
  for (let at = 0; at < bytes.length; ) {
    const code = bytes[at];
    if (code === 0 || at + code > bytes.length) return null;
    decoded.push(...bytes.subarray(at + 1, at + code));
    at += code;
    if (code < 0xff && at < bytes.length) decoded.push(0);
  }
  return Uint8Array.from(decoded);
}

/** A frame ready to send: COBS(type, fields, CRC-32) and 0x00. Fields left out are 0. */
export function encode(name, fields = {}) {
  const [type, layout] = kMessages[name];
  const size = Object.values(layout).reduce((sum, kind) => sum + kTypes[kind].size, 0);
  const view = new DataView(new ArrayBuffer(1 + size));
  view.setUint8(0, type);
  let at = 1;
  for (const [field, kind] of Object.entries(layout)) {
    if (field in fields) kTypes[kind].write(view, at, fields[field]);
    at += kTypes[kind].size;
  }
  return encodeBody(new Uint8Array(view.buffer, 0, at));
}

/** A frame of any type byte and payload. */
export function encodeBody(body) {
  const bytes = new Uint8Array(body.length + 4);
  bytes.set(body);
  new DataView(bytes.buffer).setUint32(body.length, crc32(body), true);
  return Uint8Array.from([...cobsEncode(bytes), 0]);
}

/**
 * The fields of a message; bytes beyond those known are a newer version's and are ignored.
 * @param {{type: number, payload: DataView}} frame
 * @returns {{name: string} & Record<string, number | bigint | string | Uint8Array> | null} null: unknown or too short
 */
export function decode({ type, payload }) {
  const name = kNames[type];
  if (name === undefined) return null;
  const message = { name };
  let at = 0;
  for (const [field, kind] of Object.entries(kMessages[name][1])) {
    if (at + kTypes[kind].size > payload.byteLength) return null;
    message[field] = kTypes[kind].read(payload, at);
    at += kTypes[kind].size;
  }
  return message;
}

/** Cuts a stream of bytes into frames, whatever pieces it comes in. */
export class FrameSplitter {
  constructor() {
    this.partial = [];
    this.damaged = 0; // frames that were not COBS or had a wrong CRC
  }

  /** @returns {{type: number, payload: DataView}[]} the frames that end in `bytes` */
  push(bytes) {
    const frames = [];
    for (const byte of bytes) {
      if (byte !== 0) {
        this.partial.push(byte);
      } else if (this.partial.length > 0) {
        const frame = open(Uint8Array.from(this.partial.splice(0)));
        if (frame) frames.push(frame);
        else this.damaged++;
      }
    }
    return frames;
  }

  /** The known messages that end in `bytes`. */
  messages(bytes) {
    return this.push(bytes).map(decode).filter((message) => message !== null);
  }
}

function open(encoded) {
  const bytes = cobsDecode(encoded);
  if (bytes === null || bytes.length < 5) return null;
  const end = bytes.length - 4;
  const view = new DataView(bytes.buffer);
  if (view.getUint32(end, true) !== crc32(bytes.subarray(0, end))) return null;
  return { type: bytes[0], payload: new DataView(bytes.buffer, 1, end - 1) };
}
