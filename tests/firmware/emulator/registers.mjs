// SPDX-License-Identifier: Apache-2.0
// Small register blocks that rp2040js lacks: IO_QSPI, the ring oscillator and the chip's reset flags.

import { BasePeripheral } from 'rp2040js';

/** Registers that keep what is written, with their reset values. */
class Registers extends BasePeripheral {
  constructor(chip, name, values) {
    super(chip, name);
    this.values = values;
  }

  readUint32(offset) {
    return offset in this.values ? this.values[offset] : super.readUint32(offset);
  }

  writeUint32(offset, value) {
    if (offset in this.values) this.values[offset] = value;
    else super.writeUint32(offset, value);
  }
}

/** IO_QSPI (data sheet sec. 2.19.6.2): only the flash's select pin has an effect. */
export class IoQspi extends Registers {
  constructor(chip, ssi) {
    const pins = [0, 1, 2, 3, 4, 5];
    super(chip, 'IO_QSPI', Object.fromEntries(pins.flatMap((pin) => [[8 * pin, 0], [8 * pin + 4, 0]])));
    this.ssi = ssi;
  }

  writeUint32(offset, value) {
    super.writeUint32(offset, value);
    if (offset === 0x0c) this.ssi.overrideSelect((value >> 8) & 3);
  }
}

/** ROSC (sec. 2.17.8): RANDOMBIT gives a repeatable sequence of bits. */
export class RingOscillator extends Registers {
  constructor(chip) {
    super(chip, 'ROSC', { 0x00: 0xaa0, 0x04: 0, 0x08: 0, 0x0c: 0, 0x10: 0xaa0, 0x14: 0, 0x18: 0x80001000 });
    this.state = 0xace1;
  }

  readUint32(offset) {
    if (offset !== 0x1c) return super.readUint32(offset);
    const bit = this.state & 1;
    this.state = (this.state >> 1) ^ (bit ? 0xb400 : 0);
    return bit;
  }
}

/** VREG_AND_CHIP_RESET (sec. 2.12.8): the cause of the last reset of the whole chip, which a watchdog keeps. */
export class ChipReset extends Registers {
  constructor(chip) {
    super(chip, 'VREG_AND_CHIP_RESET', { 0x00: 0xb1, 0x04: 9, 0x08: 1 << 8 }); // HAD_POR
  }
}
