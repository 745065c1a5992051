// SPDX-License-Identifier: Apache-2.0
// rp2040js's RP2040 with the memory accesses that silicon refuses: they fault, or they are findings.

import { RP2040 } from 'rp2040js';

/** An access or instruction that raises the HardFault exception (ARMv6-M sec. B1.5). */
export class HardFault extends Error {
  /** @param {number} [address] that the access went to */
  constructor(message, address) {
    super(message);
    this.address = address;
  }
}

const kRomBytes = 0x4000;
const kSram = 0x20000000, kSramEnd = 0x20042000;
const kDpramEnd = 0x50101000;
export const kFlashBytes = 2 * 1024 * 1024; // the Pico's W25Q16JV

const isFlash = (address) => address >>> 26 === 0x10000000 >>> 26;

export class Chip extends RP2040 {
  /**
   * @param {(rule: string) => void} report takes broken silicon rules
   * @param {(text: string) => void} warn takes the emulator's own warnings and errors
   */
  constructor(report, warn) {
    super();
    this.report = report;
    this.flashHidden = false; // true while the flash is not mapped (XIP off)
    const ignore = () => {};
    const collect = (component, message) => warn(`${component}: ${message}`);
    this.logger = { debug: ignore, info: ignore, warn: collect, error: collect };
  }

  readUint32(address) {
    address >>>= 0;
    if (address & 3) throw new HardFault(`32-bit read of 0x${address.toString(16)}, which is not aligned`);
    if (address >= kSram && address < kSramEnd) return this.sramView.getUint32(address - kSram, true);
    checkMapped(this, address);
    if (this.flashHidden) checkFlashRead(this, address);
    return super.readUint32(address);
  }

  readUint16(address) {
    if (address & 1) throw new HardFault(`16-bit read of 0x${(address >>> 0).toString(16)}, which is not aligned`);
    if (this.flashHidden) checkFlashRead(this, address);
    return super.readUint16(address);
  }

  readUint8(address) {
    if (this.flashHidden) checkFlashRead(this, address);
    return super.readUint8(address);
  }

  writeUint32(address, value) {
    address >>>= 0;
    if (address & 3) throw new HardFault(`32-bit write of 0x${address.toString(16)}, which is not aligned`);
    if (address >= kSram && address < kSramEnd) return this.sramView.setUint32(address - kSram, value, true);
    if (refusesWrite(this, address)) return;
    checkMapped(this, address);
    super.writeUint32(address, value);
  }

  writeUint16(address, value) {
    if (address & 1) throw new HardFault(`16-bit write of 0x${(address >>> 0).toString(16)}, which is not aligned`);
    if (!refusesWrite(this, address)) super.writeUint16(address, value);
  }

  writeUint8(address, value) {
    if (!refusesWrite(this, address)) super.writeUint8(address, value);
  }
}

function checkMapped(chip, address) {
  const region = address >>> 28;
  const mapped =
    region === 0 ? address < kRomBytes
    : region === 1 ? isFlash(address) || chip.findPeripheral(address)
    : region === 2 ? address < kSramEnd
    : region === 4 || region === 5 ? chip.findPeripheral(address) || (address >>> 20 === 0x501 && address < kDpramEnd)
    : region === 13 || address >>> 12 === 0xe000e;
  if (!mapped) throw new HardFault(`access to 0x${address.toString(16)}, where nothing is`, address);
}

function checkFlashRead(chip, address) {
  if (isFlash(address)) chip.report('flash read or executed while it is not mapped (XIP off)');
}

function refusesWrite(chip, address) {
  address >>>= 0;
  const refused = address < kRomBytes || isFlash(address);
  if (refused) chip.report(`write to ${address < kRomBytes ? 'ROM' : 'flash'} at 0x${address.toString(16)}`);
  return refused;
}
