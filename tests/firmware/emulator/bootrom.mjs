// SPDX-License-Identifier: Apache-2.0
// A stand-in for the mask ROM (RP2040 data sheet sec. 2.8.3): its function table, with the flash functions done here.

import { kFlashBytes } from './chip.mjs';

const kSectorBytes = 4096, kPageBytes = 256;
const kSectorEraseNanos = 45e6, kPageProgramNanos = 0.4e6; // typical, W25Q16JV data sheet sec. 9.6
const kTable = 0x100, kCode = 0x200, kStackTop = 0x20042000;
const kLookup = 0;
const kFunctions = ['IF', 'EX', 'RE', 'RP', 'FC', 'CX', 'UB']; // trap numbers 1, 2, ...

/** Each function is a breakpoint that `BootRom.call` serves, and a return. */
const trapCode = (number) => (0x4770 << 16) | 0xbe00 | number; // bkpt #number; bx lr
const trapAddress = (number) => kCode + 4 * number;

export class BootRom {
  /**
   * @param {import('./chip.mjs').Chip} chip
   * @param {import('./flash.mjs').Ssi} ssi
   * @param {() => void} onBootloader called when the program asks for the USB bootloader
   */
  constructor(chip, ssi, onBootloader) {
    this.chip = chip;
    this.ssi = ssi;
    this.onBootloader = onBootloader;
    this.direct = false; // the SSI is set up for commands ('IF')
    this.commandable = false; // the flash listens to commands ('EX')
    this.stale = false; // the cache may hold what the flash no longer does
    const { bootrom } = chip;
    bootrom[0x00 / 4] = kStackTop;
    bootrom[0x10 / 4] = 0x0201754d; // 'M', 'u', 1, version 2
    bootrom[0x14 / 4] = kTable;
    bootrom[0x18 / 4] = trapAddress(kLookup) | 1;
    bootrom[trapAddress(kLookup) / 4] = trapCode(kLookup);
    kFunctions.forEach((code, index) => {
      bootrom[trapAddress(index + 1) / 4] = trapCode(index + 1);
      const name = code.charCodeAt(0) | (code.charCodeAt(1) << 8);
      bootrom[kTable / 4 + index] = name | ((trapAddress(index + 1) | 1) << 16);
    });
  }

  /** What the ROM does of a reset: copies boot2 to SRAM and enters it; false if its checksum is wrong. */
  start() {
    const { chip } = this;
    const stored = chip.flashView.getUint32(252, true);
    if (crc32Mpeg2(chip.flash.subarray(0, 252)) !== stored) return false;
    chip.sram.set(chip.flash.subarray(0, 256), 0x41f00);
    chip.core.VTOR = 0;
    chip.core.SP = kStackTop;
    chip.core.LR = 0;
    chip.core.PC = 0x20041f00;
    chip.flashHidden = true;
    return true;
  }

  /** Serves the breakpoint `number` of the table's functions, arguments in the registers. */
  call(number) {
    const { core } = this.chip;
    const [first, second, third] = core.registers;
    if (number === kLookup) core.registers[0] = this.#lookUp(first, second);
    else this[kFunctions[number - 1]](first, second, third);
  }

  #lookUp(table, code) {
    for (let entry = table; this.chip.readUint16(entry) !== 0; entry += 4) {
      if (this.chip.readUint16(entry) === (code & 0xffff)) return this.chip.readUint16(entry + 2);
    }
    return 0;
  }

  IF() {
    this.direct = true;
    this.chip.flashHidden = true;
    const direct = [[0x08, 0], [0x14, 6], [0x00, 7 << 16], [0x10, 1], [0x08, 1]];
    for (const [offset, value] of direct) this.ssi.writeUint32(offset, value);
  }

  EX() {
    if (!this.direct) this.chip.report("ROM flash_exit_xip called before connect_internal_flash ('IF')");
    this.commandable = true;
    this.chip.flashHidden = true;
  }

  RE(offset, bytes) {
    if (!this.#mayChange('flash_range_erase', offset, bytes, kSectorBytes)) return;
    for (let sector = offset; sector < offset + bytes; sector += kSectorBytes) {
      this.chip.flash.fill(0xff, sector, sector + kSectorBytes);
      this.chip.clock.tick(kSectorEraseNanos);
    }
  }

  RP(offset, data, bytes) {
    if (!this.#mayChange('flash_range_program', offset, bytes, kPageBytes)) return;
    for (let index = 0; index < bytes; index++) {
      this.chip.flash[offset + index] &= this.chip.readUint8(data + index);
      if (index % kPageBytes === kPageBytes - 1) this.chip.clock.tick(kPageProgramNanos);
    }
  }

  FC() {
    this.stale = false;
    this.ssi.overrideSelect(0);
  }

  CX() {
    if (this.stale) this.chip.report("ROM flash_enter_cmd_xip called without flash_flush_cache ('FC') after a change");
    this.direct = false;
    this.commandable = false;
    this.ssi.writeUint32(0x08, 0);
    this.ssi.mapSlowRead();
  }

  UB() {
    this.onBootloader();
  }

  #mayChange(name, offset, bytes, unit) {
    const complain = (what) => {
      this.chip.report(`ROM ${name}: ${what}`);
      return false;
    };
    if (!this.commandable) return complain("called without connect_internal_flash ('IF') and flash_exit_xip ('EX')");
    if (offset % unit || bytes % unit) return complain(`0x${offset.toString(16)}+${bytes} is not aligned to ${unit}`);
    if (offset + bytes > kFlashBytes) return complain(`0x${offset.toString(16)}+${bytes} is beyond the flash`);
    this.stale = true;
    return true;
  }
}

/** CRC-32/MPEG-2, which the ROM demands of boot2's first 252 bytes (sec. 2.8.1.3.1). */
export function crc32Mpeg2(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte << 24;
    for (let bit = 0; bit < 8; bit++) crc = crc & 0x80000000 ? (crc << 1) ^ 0x04c11db7 : crc << 1;
  }
  return crc >>> 0;
}
