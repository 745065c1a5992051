// SPDX-License-Identifier: Apache-2.0
// The PL011 UART of the RP2040 (data sheet sec. 4.2) in real time, in place of rp2040js's, which sends
// instantly, always has its transmit interrupt pending, and knows neither levels nor the receive timeout.

import { BasePeripheral } from 'rp2040js';

const kDr = 0x00, kRsr = 0x04, kFr = 0x18, kIbrd = 0x24, kFbrd = 0x28, kLcrH = 0x2c, kCr = 0x30;
const kIfls = 0x34, kImsc = 0x38, kRis = 0x3c, kMis = 0x40, kIcr = 0x44, kDmacr = 0x48;
const kReceive = 1 << 4, kTransmit = 1 << 5, kTimeout = 1 << 6, kOverrun = 1 << 10; // interrupt bits
const kFifoEnable = 1 << 4; // LCR_H
const kUartEnable = 1, kTransmitEnable = 1 << 8, kReceiveEnable = 1 << 9; // CR
const kLevels = [4, 8, 16, 24, 28]; // of 32, by IFLS

export class Uart extends BasePeripheral {
  /** @param {(byte: number) => void} onByte called when a byte's stop bit has left the pin */
  constructor(chip, name, interrupt, onByte) {
    super(chip, name);
    this.interrupt = interrupt;
    this.onByte = onByte;
    this.transmitFifo = [];
    this.receiveFifo = [];
    this.incoming = [];
    this.shifting = null;
    this.raw = 0;
    this.overruns = 0;
    this.divider = Infinity;
    this.registers = { [kIbrd]: 0, [kFbrd]: 0, [kLcrH]: 0, [kCr]: 0x300, [kIfls]: 0x12, [kImsc]: 0, [kDmacr]: 0 };
    this.transmitAlarm = chip.clock.createAlarm(() => this.#byteSent());
    this.arrivalAlarm = chip.clock.createAlarm(() => this.#byteArrived());
    this.timeoutAlarm = chip.clock.createAlarm(() => this.receiveFifo.length && this.#raise(kTimeout));
  }

  get baudRate() {
    return this.rp2040.clkPeri / (16 * this.divider);
  }

  get sends() {
    return (this.registers[kCr] & (kUartEnable | kTransmitEnable)) === (kUartEnable | kTransmitEnable);
  }

  clkPeriChanged() {}

  /** Sends bytes to the chip, one after the other at its own baud rate. */
  feed(bytes) {
    if (this.incoming.length === 0) this.arrivalAlarm.schedule(this.#byteNanos());
    this.incoming.push(...bytes);
  }

  #depth() {
    return this.registers[kLcrH] & kFifoEnable ? 32 : 1;
  }

  #level(shift) {
    return this.registers[kLcrH] & kFifoEnable ? kLevels[(this.registers[kIfls] >> shift) & 7] : shift ? 1 : 0;
  }

  #bitNanos() {
    return 1e9 / this.baudRate;
  }

  #byteNanos() {
    const line = this.registers[kLcrH];
    const bits = 1 + 5 + ((line >> 5) & 3) + ((line >> 1) & 1) + 1 + ((line >> 3) & 1);
    return bits * this.#bitNanos();
  }

  #raise(bits) {
    this.raw |= bits;
    this.#update();
  }

  #clear(bits) {
    this.raw &= ~bits;
    this.#update();
  }

  #update() {
    this.rp2040.setInterrupt(this.interrupt, (this.raw & this.registers[kImsc]) !== 0);
  }

  #transmit(byte) {
    if (this.shifting === null && this.sends) {
      this.shifting = byte;
      this.transmitAlarm.schedule(this.#byteNanos());
    } else if (this.transmitFifo.length < this.#depth()) {
      this.transmitFifo.push(byte);
      if (this.transmitFifo.length > this.#level(0)) this.#clear(kTransmit);
    } else {
      this.rp2040.report(`${this.name}: byte written into a full transmit FIFO is lost`);
    }
  }

  #byteSent() {
    this.onByte(this.shifting);
    this.shifting = null;
    if (this.transmitFifo.length === 0 || !this.sends) return;
    this.shifting = this.transmitFifo.shift();
    this.transmitAlarm.schedule(this.#byteNanos());
    if (this.transmitFifo.length === this.#level(0)) this.#raise(kTransmit); // only on passing the level downwards
  }

  #byteArrived() {
    const byte = this.incoming.shift();
    if (this.incoming.length) this.arrivalAlarm.schedule(this.#byteNanos());
    const listening = kUartEnable | kReceiveEnable;
    if ((this.registers[kCr] & listening) !== listening) return;
    if (this.receiveFifo.length >= this.#depth()) {
      this.overruns++;
      this.#raise(kOverrun);
      return;
    }
    this.receiveFifo.push(byte);
    this.timeoutAlarm.schedule(32 * this.#bitNanos());
    if (this.receiveFifo.length >= this.#level(3)) this.#raise(kReceive);
  }

  #receive() {
    const byte = this.receiveFifo.shift() ?? 0;
    if (this.receiveFifo.length < this.#level(3)) this.#clear(kReceive);
    if (this.receiveFifo.length === 0) this.#clear(kTimeout);
    return byte;
  }

  #flags() {
    const queued = this.transmitFifo.length;
    return (
      (queued === 0 ? 1 << 7 : 0) | (this.receiveFifo.length >= this.#depth() ? 1 << 6 : 0) |
      (queued >= this.#depth() ? 1 << 5 : 0) | (this.receiveFifo.length === 0 ? 1 << 4 : 0) |
      (this.shifting === null ? 0 : 1 << 3)
    );
  }

  readUint32(offset) {
    if (offset === kDr) return this.#receive();
    if (offset === kRsr) return this.raw & kOverrun ? 1 << 3 : 0;
    if (offset === kFr) return this.#flags();
    if (offset === kRis) return this.raw;
    if (offset === kMis) return this.raw & this.registers[kImsc];
    return offset in this.registers ? this.registers[offset] : super.readUint32(offset);
  }

  writeUint32(offset, value) {
    if (offset === kDr) this.#transmit(value & 0xff);
    else if (offset === kIcr) this.#clear(this.rawWriteValue);
    else if (offset === kRsr) this.#clear(kOverrun);
    else if (offset in this.registers) this.registers[offset] = value;
    else super.writeUint32(offset, value);
    if (offset === kImsc) this.#update();
    if (offset === kLcrH) this.divider = this.registers[kIbrd] + this.registers[kFbrd] / 64; // latched only here
  }
}
