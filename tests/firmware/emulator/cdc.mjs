// SPDX-License-Identifier: Apache-2.0
// A serial port on the strict USB host: what a program on a PC sees of the firmware's CDC-ACM device.

import { control, enumerate, request } from './usb_control.mjs';
import { UsbHost } from './usb_host.mjs';

const kInterfaceOut = 1, kEndpointOut = 2, kClearFeature = 1, kSetInterface = 11;
const kClassInterfaceOut = 0x21, kClassInterfaceIn = 0xa1;
const kSetLineCoding = 0x20, kGetLineCoding = 0x21, kSetControlLineState = 0x22;
const kMaxPacket = 64;
const kTransferBytes = 128; // of one read by Linux's cdc_acm, handed on when it is full or a packet is short
const kDeadline = 1; // second of virtual time for a control transfer or to attach

export class CdcPort {
  /** @param {import('./rp2040.mjs').Emulator} emulator; the port follows it through resets */
  constructor(emulator) {
    this.emulator = emulator;
    this.reading = true;
    this.received = [];
    this.gathered = []; // of the read that is not over yet
    this.pendingWrites = 0;
    this.device = null; // what enumeration found, null while there is none
    this.#follow();
    const previous = emulator.onReset;
    emulator.onReset = (each) => {
      previous(each);
      if (each.mcu !== this.host.chip) this.#follow();
    };
  }

  /** Runs the emulator until the device is enumerated and configured. */
  attach() {
    this.#until(() => this.device !== null, 'the device to attach');
    return this.device;
  }

  /** The bytes that have arrived since the last read. */
  read() {
    return Uint8Array.from(this.received.splice(0));
  }

  /** Queues bytes for the device, in packets of at most `packetBytes`. */
  write(bytes, packetBytes = 64) {
    const { data } = this.#endpoints();
    for (let start = 0; start < bytes.length; start += packetBytes) {
      this.pendingWrites++;
      const packet = Uint8Array.from(bytes.slice(start, start + packetBytes));
      this.host.transfer(data.out, false, packet, () => this.pendingWrites--);
    }
  }

  /** Runs until everything written has been taken by the device. */
  flush() {
    this.#until(() => this.pendingWrites === 0, 'the device to take what was written');
  }

  setLineState({ dtr = false, rts = false }) {
    return this.#control(request(kClassInterfaceOut, kSetControlLineState, (dtr ? 1 : 0) | (rts ? 2 : 0), 0, 0));
  }

  setLineCoding(baud) {
    const coding = new Uint8Array(7);
    new DataView(coding.buffer).setUint32(0, baud, true);
    coding[6] = 8;
    return this.#control(request(kClassInterfaceOut, kSetLineCoding, 0, 0, 7), coding);
  }

  /** The baud rate that the device remembers. */
  lineCoding() {
    const { data } = this.#control(request(kClassInterfaceIn, kGetLineCoding, 0, 0, 7));
    return new DataView(data.buffer).getUint32(0, true);
  }

  /** Opens at 1200 baud and drops DTR: the custom by which boards are sent into their bootloader. */
  touch1200() {
    this.setLineState({ dtr: true });
    this.setLineCoding(1200);
    control(this.host, request(kClassInterfaceOut, kSetControlLineState, 0, 0, 0), undefined, () => {});
    this.emulator.run(0.01);
  }

  /** Leaves data in the device, as when no program reads. */
  stopReading() {
    this.reading = false;
    if (this.waiting) this.host.cancel(this.waiting);
    this.waiting = null;
  }

  resumeReading() {
    this.reading = true;
    if (this.device && !this.waiting) this.#readMore();
  }

  unplug() {
    this.host.unplug();
  }

  plug() {
    this.host.plug();
  }

  /** The host stops its frames; the device sees a bus that is suspended. */
  suspend() {
    this.stopReading();
    this.host.suspend();
  }

  resume() {
    this.host.resume();
    this.resumeReading();
  }

  /** The device's controller hangs (RP2040-E15): it sees no frames, and no end of them either. */
  hang() {
    this.stopReading();
    this.host.frames.stop();
  }

  /** Clears the halt of both data endpoints, as programs do when they open a device: packets begin with DATA0. */
  clearHalts() {
    const { data } = this.#endpoints();
    for (const endpoint of [data.in | 0x80, data.out]) this.#control(request(kEndpointOut, kClearFeature, 0, endpoint, 0));
  }

  /** Chooses an interface's only setting; the data interface (1) then begins with DATA0, too. */
  setInterface(number) {
    this.#control(request(kInterfaceOut, kSetInterface, 0, number, 0));
  }

  /** A control transfer, run to its end. */
  controlTransfer(packet, data) {
    return this.#control(packet, data);
  }

  #follow() {
    this.#forget();
    this.host = new UsbHost(this.emulator, {
      onAttach: () => enumerate(this.host, (device) => {
        this.device = device;
        if (this.reading) this.#readMore();
      }),
      onDetach: () => this.#forget(),
    });
  }

  #forget() {
    this.device = null;
    this.waiting = null;
    this.gathered = [];
    this.pendingWrites = 0;
  }

  #readMore() {
    const { data } = this.#endpoints();
    this.waiting = this.host.transfer(data.in, true, null, (result) => {
      this.waiting = null;
      if (result.status === 'stall') this.host.chip.report('USB: bulk IN endpoint stalled');
      if (result.status !== 'ok') return;
      this.#gather(result.data);
      if (this.reading) this.#readMore();
    });
  }

  /** USB 2.0 sec. 5.8.3: a short packet, be it empty, ends a transfer; a full one does not. */
  #gather(packet) {
    this.gathered.push(...packet);
    if (packet.length < kMaxPacket || this.gathered.length >= kTransferBytes) {
      this.received.push(...this.gathered.splice(0));
    }
  }

  /** The bulk endpoints' numbers, from the configuration descriptor. */
  #endpoints() {
    if (!this.device) throw new Error('no USB device is attached');
    const data = { in: 0, out: 0 };
    const bytes = this.device.configuration;
    for (let at = 0; at < bytes.length; at += bytes[at]) {
      const isBulk = bytes[at + 1] === 5 && (bytes[at + 3] & 3) === 2;
      if (isBulk) data[bytes[at + 2] & 0x80 ? 'in' : 'out'] = bytes[at + 2] & 0x0f;
    }
    return { data };
  }

  #control(packet, data) {
    let result = null;
    control(this.host, packet, data, (each) => { result = each; });
    this.#until(() => result !== null, `the device to answer request 0x${packet[1].toString(16)}`);
    return result;
  }

  #until(isDone, what) {
    const deadline = this.emulator.seconds + kDeadline;
    while (!isDone()) {
      if (this.emulator.stopped) throw new Error(`waited for ${what}, but: ${this.emulator.stopped}`);
      if (this.emulator.seconds > deadline) throw new Error(`waited ${kDeadline} s in vain for ${what}`);
      this.emulator.run(100e-6);
    }
  }
}
