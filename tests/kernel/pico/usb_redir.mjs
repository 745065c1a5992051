// SPDX-License-Identifier: Apache-2.0
// The device's side of the usbredir protocol (usbredir's docs/usb-redirection-protocol.md, version 0.6): packets
// to and from a virtual machine that has `-device usb-redir`, over a unix socket. All numbers are little-endian.

import net from 'node:net';

export const Type = {
  hello: 0, deviceConnect: 1, deviceDisconnect: 2, reset: 3, interfaceInfo: 4, endpointInfo: 5,
  setConfiguration: 6, getConfiguration: 7, configurationStatus: 8,
  setAlternate: 9, getAlternate: 10, alternateStatus: 11,
  startInterrupts: 15, stopInterrupts: 16, interruptsStatus: 17,
  cancel: 21, deviceDisconnectAck: 24, control: 100, bulk: 101, interrupt: 103,
};
export const Status = { ok: 0, cancelled: 1, refused: 2, error: 3, stall: 4 };

// Capabilities, by their bit.
const kDeviceVersion = 1 << 1, kDisconnectAck = 1 << 3, kMaxPacketSize = 1 << 4, kLongIds = 1 << 5, kLongBulk = 1 << 6;
const kCapabilities = kDeviceVersion | kDisconnectAck | kMaxPacketSize | kLongIds | kLongBulk;
const kVersionBytes = 64, kRetryMillis = 20;
const kFullSpeed = 1, kUnused = 255, kEndpoints = 32, kInterfaces = 32;
const kInterfaceDescriptor = 4, kEndpointDescriptor = 5;

/** The place of an endpoint in the tables: those out first, then those in. */
const placeOf = (address) => (address & 0x0f) | (address & 0x80 ? 16 : 0);

/** A connection; it is retried until the machine listens. */
export class RedirSocket {
  /** @param {{onReady: () => void, onPacket: (type: number, id: bigint, body: Buffer) => void, onClose: () => void}} events */
  constructor(path, events) {
    this.events = events;
    this.received = Buffer.alloc(0);
    this.ready = false; // both sides have said hello
    this.#connect(path);
  }

  send(type, id, body) {
    const head = Buffer.alloc(this.#headBytes());
    head.writeUInt32LE(type, 0);
    head.writeUInt32LE(body.length, 4);
    if (this.ready) head.writeBigUInt64LE(BigInt(id), 8);
    this.socket.write(Buffer.concat([head, body]));
  }

  #connect(path) {
    this.socket = net.connect(path);
    this.socket.once('connect', () => this.#sayHello());
    this.socket.on('data', (data) => this.#take(data));
    this.socket.on('error', () => {}); // 'close' follows
    this.socket.once('close', (failed) => {
      if (failed && !this.ready) setTimeout(() => this.#connect(path), kRetryMillis);
      else this.events.onClose();
    });
  }

  #sayHello() {
    const body = Buffer.alloc(kVersionBytes + 4);
    body.write('Penduline');
    body.writeUInt32LE(kCapabilities, kVersionBytes);
    this.send(Type.hello, 0, body);
  }

  /** The hellos have short ids still. */
  #headBytes() {
    return this.ready ? 16 : 12;
  }

  #take(data) {
    this.received = Buffer.concat([this.received, data]);
    while (this.received.length >= this.#headBytes()) {
      const end = this.#headBytes() + this.received.readUInt32LE(4);
      if (this.received.length < end) return;
      const type = this.received.readUInt32LE(0);
      const id = this.ready ? this.received.readBigUInt64LE(8) : 0n;
      const body = this.received.subarray(this.#headBytes(), end);
      this.received = this.received.subarray(end);
      if (this.ready) this.events.onPacket(type, id, body);
      else this.#takeHello(type, body);
    }
  }

  #takeHello(type, body) {
    const theirs = type === Type.hello && body.length >= kVersionBytes + 4 ? body.readUInt32LE(kVersionBytes) : 0;
    if ((theirs & kCapabilities) !== kCapabilities) throw new Error(`found capabilities ${theirs}, expected QEMU's`);
    this.ready = true;
    this.events.onReady();
  }
}

/** What the machine must know of a device before it sees it: bodies of interfaceInfo, endpointInfo and deviceConnect. */
export function describe({ device, configuration }) {
  const interfaces = Buffer.alloc(4 + 4 * kInterfaces); // count; then numbers, classes, subclasses, protocols
  const endpoints = Buffer.alloc(5 * kEndpoints); // types, intervals, interfaces, greatest packets
  endpoints.fill(kUnused, 0, kEndpoints);
  const addEndpoint = (address, type, interval, owner, maxPacket) => {
    const place = placeOf(address);
    endpoints[place] = type;
    endpoints[kEndpoints + place] = interval;
    endpoints[2 * kEndpoints + place] = owner;
    endpoints.writeUInt16LE(maxPacket, 3 * kEndpoints + 2 * place);
  };
  for (const address of [0x00, 0x80]) addEndpoint(address, 0, 0, 0, device[7]);
  let count = 0, owner = 0;
  for (let at = 0; at < configuration.length; at += configuration[at]) {
    const field = (offset) => configuration[at + offset];
    if (field(1) === kInterfaceDescriptor) {
      owner = field(2);
      [owner, field(5), field(6), field(7)].forEach((value, i) => { interfaces[4 + i * kInterfaces + count] = value; });
      count++;
    } else if (field(1) === kEndpointDescriptor) {
      addEndpoint(field(2), field(3) & 3, field(6), owner, field(4) | (field(5) << 8));
    }
  }
  interfaces.writeUInt32LE(count, 0);
  // Speed; class, subclass, protocol; vendor, product, release.
  const connect = Buffer.from([kFullSpeed, ...device.subarray(4, 7), ...device.subarray(8, 14)]);
  return { interfaces, endpoints, connect };
}
