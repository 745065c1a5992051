// SPDX-License-Identifier: Apache-2.0
// The serial flash and the SSI that reaches it: mapped reading (XIP) on or off, and direct commands.

import { BasePeripheral } from 'rp2040js';
import { kFlashBytes } from './chip.mjs';

// RP2040 data sheet sec. 4.10.13
const kCtrlr0 = 0x00, kSsienr = 0x08, kSer = 0x10, kBaudr = 0x14, kTxflr = 0x20, kRxflr = 0x24, kSr = 0x28;
const kDr0 = 0x60, kSpiCtrlr0 = 0xf4;
const kStored = [kCtrlr0, 0x04, kSsienr, kSer, kBaudr, 0x18, 0x1c, 0x2c, 0x4c, 0x50, 0x54, 0xf0, kSpiCtrlr0, 0xf8];
const kBusy = 1, kTransmitNotFull = 1 << 1, kTransmitEmpty = 1 << 2, kReceiveNotEmpty = 1 << 3;
const kFifoDepth = 16;

// W25Q16JV data sheet sec. 8.1.2
const kReadUniqueId = 0x4b, kReadJedecId = 0x9f, kReadStatus = 0x05, kReadData = 0x03;
const kJedecId = [0xef, 0x40, 0x15];

/** What the flash answers to byte number `position` of a command, 0xff where it does not drive its pin. */
function answer(chip, uniqueId, command, position) {
  const [code] = command;
  if (position === 0) return 0xff;
  if (code === kReadUniqueId) return position >= 5 ? uniqueId[position - 5] ?? 0xff : 0xff;
  if (code === kReadJedecId) return kJedecId[position - 1] ?? 0xff;
  if (code === kReadStatus) return 0;
  if (code === kReadData && position >= 4) {
    const address = (command[1] << 16) | (command[2] << 8) | command[3];
    return chip.flash[(address + position - 4) % kFlashBytes];
  }
  return 0xff;
}

export class Ssi extends BasePeripheral {
  /** @param {Uint8Array} uniqueId the flash's eight bytes */
  constructor(chip, uniqueId) {
    super(chip, 'SSI');
    this.uniqueId = uniqueId;
    this.registers = Object.fromEntries(kStored.map((offset) => [offset, 0]));
    this.received = []; // {byte, at}: readable from the nanosecond `at`
    this.command = [];
    this.busyUntil = 0;
    this.forcedSelect = null; // true, false, or null: the SSI drives the pin
  }

  /** Maps the flash with the slow read that every flash knows, as the ROM leaves it for boot2. */
  mapSlowRead() {
    this.writeUint32(kCtrlr0, 0x001f0300);
    this.writeUint32(kSpiCtrlr0, 0x03000218);
    this.writeUint32(kSsienr, 1);
  }

  /** What IO_QSPI's output override of the select pin says (sec. 2.19.6): 2 drives it low, 3 high. */
  overrideSelect(override) {
    const selected = override === 2 ? true : override === 3 ? false : null;
    if (selected !== this.forcedSelect) this.command = [];
    this.forcedSelect = selected;
  }

  #isMapped() {
    const control = this.registers[kCtrlr0];
    return this.registers[kSsienr] === 1 && ((control >> 16) & 0x1f) === 31 && ((control >> 8) & 3) === 3;
  }

  #exchange(byte) {
    const { clock, clkSys } = this.rp2040;
    const control = this.registers[kCtrlr0];
    if (!(this.registers[kSsienr] & 1) || ((control >> 8) & 3) !== 0 || ((control >> 16) & 0x1f) !== 7) {
      return this.rp2040.report('SSI data written without an enabled 8-bit transmit-and-receive mode');
    }
    if (this.registers[kBaudr] < 2) return this.rp2040.report('SSI data written with BAUDR below 2: no clock');
    if (!(this.registers[kSer] & 1)) return this.rp2040.report('SSI data written with SER = 0: no chip is selected');
    const idle = clock.nanos >= this.busyUntil;
    if (this.forcedSelect === null && idle) this.command = []; // the pin rose when the FIFO ran empty
    const start = Math.max(clock.nanos, this.busyUntil);
    this.busyUntil = start + (8 * this.registers[kBaudr] * 1e9) / clkSys;
    if (this.received.length >= kFifoDepth) return this.rp2040.report('SSI receive FIFO overflow');
    this.command.push(byte & 0xff);
    const deaf = this.forcedSelect === false;
    const response = deaf ? 0xff : answer(this.rp2040, this.uniqueId, this.command, this.command.length - 1);
    this.received.push({ byte: response, at: this.busyUntil });
  }

  #readable() {
    const now = this.rp2040.clock.nanos;
    return this.received.filter(({ at }) => at <= now).length;
  }

  readUint32(offset) {
    const now = this.rp2040.clock.nanos;
    if (offset === kDr0) return this.#readable() ? this.received.shift().byte : 0;
    if (offset === kTxflr) return this.received.length - this.#readable();
    if (offset === kRxflr) return this.#readable();
    if (offset === kSr) {
      const busy = now < this.busyUntil;
      const room = this.received.length - this.#readable() < kFifoDepth;
      return (
        (busy ? kBusy : kTransmitEmpty) | (room ? kTransmitNotFull : 0) | (this.#readable() ? kReceiveNotEmpty : 0)
      );
    }
    return offset in this.registers ? this.registers[offset] : super.readUint32(offset);
  }

  writeUint32(offset, value) {
    if (offset === kDr0) return this.#exchange(value);
    if (!(offset in this.registers)) return super.writeUint32(offset, value);
    const frozen = offset === kCtrlr0 || offset === kBaudr || offset === kSpiCtrlr0;
    if (frozen && this.registers[kSsienr] & 1 && value !== this.registers[offset]) {
      return this.rp2040.report(`SSI register 0x${offset.toString(16)} written while SSIENR = 1 (ignored by silicon)`);
    }
    this.registers[offset] = value;
    if (offset === kSsienr) {
      this.received = [];
      this.command = [];
    }
    this.rp2040.flashHidden = !this.#isMapped();
  }
}
