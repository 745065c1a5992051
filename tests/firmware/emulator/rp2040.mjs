// SPDX-License-Identifier: Apache-2.0
// Runs an RP2040 image in virtual time: boot, sleep, resets, pins, analogue inputs and UART0.

import { GPIOPinState } from 'rp2040js';
import { BootRom } from './bootrom.mjs';
import { Chip, HardFault, kFlashBytes } from './chip.mjs';
import { correct } from './corrections.mjs';
import { readElf } from './elf.mjs';
import { Ssi } from './flash.mjs';
import { lint } from './lint.mjs';
import { ChipReset, IoQspi, RingOscillator } from './registers.mjs';
import { Uart } from './uart.mjs';
import { readUf2 } from './uf2.mjs';

const kFlash = 0x10000000, kSram = 0x20000000, kVectors = 0x10000100;
const kUart0Interrupt = 20, kUart1Interrupt = 21;
const kHadRun = 1 << 16; // of CHIP_RESET
const kConversionNanos = 2000; // 96 cycles of 48 MHz

export class Emulator {
  /**
   * @param {string} imagePath an ELF, or a UF2, which has no symbols
   * @param {object} [options]
   * @param {'rom' | 'vectors'} [options.boot] through boot2 as the mask ROM does (default), or straight at the vectors
   * @param {Uint8Array} [options.uniqueId] the flash's eight bytes
   * @param {number} [options.timerMicros] what TIMER shows at power-on (0), to reach a wrap soon
   * @param {(emulator: Emulator) => void} [options.onReset] called for each chip before its first instruction,
   *   also the first
   */
  constructor(imagePath, { boot = 'rom', uniqueId, timerMicros = 0, onReset = () => {} } = {}) {
    this.bootMode = boot;
    this.uniqueId = uniqueId ?? Uint8Array.of(0xe6, 0x60, 0x58, 0x38, 0x83, 0x1b, 0x2c, 0x21);
    this.onReset = onReset;
    this.resets = 0;
    this.stopped = null; // why the chip no longer runs
    this.bootloader = false; // the program asked for the USB bootloader
    this.warnings = []; // of rp2040js
    this.findings = []; // broken silicon rules
    this.faults = []; // HardFaults taken
    this.sleptNanos = 0;
    this.pastNanos = 0; // virtual time before this boot
    this.analogSource = () => 0;
    this.uart = { bytes: [], write: (bytes) => this.mcu.uart[0].feed(bytes) };
    const isUf2 = imagePath.endsWith('.uf2');
    const { segments, symbols } = isUf2 ? { segments: readUf2(imagePath), symbols: new Map() } : readElf(imagePath);
    this.symbols = symbols;
    this.#powerOn(timerMicros * 1000);
    for (const segment of segments) this.#place(imagePath, segment);
    this.#start();
  }

  /** Virtual seconds since power-on. */
  get seconds() {
    return (this.pastNanos + this.mcu.clock.nanos - this.startNanos) * 1e-9;
  }

  /** Everything that must be empty after a test of good firmware. */
  get problems() {
    return [...this.warnings, ...this.findings, ...this.faults];
  }

  /** True if the pin is driven high. */
  pinLevel(pin) {
    const gpio = this.mcu.gpio[pin];
    return gpio.value === GPIOPinState.High && !gpio.outputDisable;
  }

  /** @param {(channel: number, seconds: number, emulator: Emulator) => number} source code at a conversion's start */
  analog(source) {
    this.analogSource = source;
  }

  /** The word at an ELF symbol (+ a byte offset). */
  read32(symbol, offset = 0) {
    if (!this.symbols.has(symbol)) throw new Error(`no symbol ${symbol}`);
    return this.mcu.sramView.getUint32(this.symbols.get(symbol) + offset - kSram, true);
  }

  /** Pulls RUN low and lets go, like a reset button: SRAM and flash stay, scratch registers do not. */
  pressReset() {
    this.pendingReset = { reason: 0, scratch: new Uint32Array(8), chipReset: kHadRun };
    this.stopped = null;
    this.bootloader = false;
    this.#reset();
  }

  /** Advances virtual time; returns early only if the chip stops for good. */
  run(seconds) {
    const until = this.pastNanos + this.mcu.clock.nanos - this.startNanos + seconds * 1e9;
    while (!this.stopped) {
      const end = until - this.pastNanos + this.startNanos;
      const { core, clock } = this.mcu;
      if (clock.nanos >= end) return;
      if (core.waiting && core.checkForInterrupts()) core.waiting = false;
      if (core.waiting) this.#sleep(end);
      else this.#execute(end);
      if (this.pendingReset) this.#reset();
    }
  }

  #sleep(end) {
    const { clock } = this.mcu;
    const next = clock.nextAlarm ? Math.min(clock.nextAlarm.nanos, end) : end;
    const nanos = Math.max(0, next - clock.nanos);
    this.sleptNanos += nanos;
    clock.tick(nanos);
  }

  #execute(end) {
    const { mcu } = this;
    const { core, clock } = mcu;
    this.interrupted = false;
    try {
      do {
        clock.tick((core.executeInstruction() * 1e9) / mcu.clkSys);
      } while (!core.waiting && clock.nanos < end && !this.interrupted);
    } catch (error) {
      if (!(error instanceof HardFault)) throw error;
      this.#hardFault(error);
    }
  }

  #hardFault({ message, address }) {
    const { core } = this.mcu;
    const kNmi = 2, kHardFault = 3;
    const fetching = address !== undefined && (address & ~3) === (core.PC & ~3);
    core.PC = (core.PC & ~1) - (fetching ? 0 : 2); // of the instruction itself
    this.faults.push(`HardFault at pc 0x${(core.PC >>> 0).toString(16)}: ${message}`);
    try {
      if (core.IPSR === kNmi || core.IPSR === kHardFault) throw new HardFault(message);
      core.exceptionEntry(kHardFault);
    } catch (error) {
      if (!(error instanceof HardFault)) throw error;
      this.#stop(`lockup: ${error.message}`);
    }
  }

  #stop(why) {
    this.stopped = why;
    this.interrupted = true;
  }

  #place(imagePath, { address, bytes }) {
    const offset = address - kFlash;
    if (offset < 0 || offset + bytes.length > kFlashBytes) {
      throw new Error(`${imagePath}: segment at 0x${address.toString(16)}, expected all in 2 MiB of flash`);
    }
    this.mcu.flash.set(bytes, offset);
  }

  /** A new chip with its clock at `startNanos`. */
  #powerOn(startNanos) {
    const chip = new Chip((rule) => this.#report(rule), (text) => this.warnings.push(text));
    this.mcu = chip;
    this.startNanos = startNanos;
    chip.clock.nanosCounter = startNanos;
    this.#replacePeripherals(chip);
    correct(chip);
    const watchdog = chip.peripherals[0x40058];
    watchdog.onWatchdogTrigger = () => {
      watchdog.timer.enable = false; // or its alarm repeats every 0 ns
      this.pendingReset = { reason: watchdog.reason, scratch: watchdog.scratchData.slice() };
      this.interrupted = true;
    };
    chip.onBreak = (number) => {
      if (chip.core.PC >= 0x4000) throw new HardFault(`breakpoint or undefined instruction ${number}`);
      this.rom.call(number);
    };
    chip.adc.onADCRead = (channel) => {
      const code = Math.round(this.analogSource(channel, this.seconds, this));
      chip.adc.channelValues[channel] = Math.max(0, Math.min(4095, code));
      chip.adc.currentChannel = channel;
      chip.adc.sampleAlarm.schedule(kConversionNanos);
    };
    chip.usbCtrl.DPRAMUpdated = () => {}; // no host: nothing takes or gives data
    this.#answerSystemReset(chip);
    lint(chip);
  }

  #replacePeripherals(chip) {
    this.ssi = new Ssi(chip, this.uniqueId);
    this.rom = new BootRom(chip, this.ssi, () => {
      this.bootloader = true;
      this.#stop('USB bootloader');
    });
    chip.uart[0] = new Uart(chip, 'UART0', kUart0Interrupt, (byte) => this.uart.bytes.push(byte));
    chip.uart[1] = new Uart(chip, 'UART1', kUart1Interrupt, () => {});
    Object.assign(chip.peripherals, {
      0x18000: this.ssi,
      0x40018: new IoQspi(chip, this.ssi),
      0x40034: chip.uart[0],
      0x40038: chip.uart[1],
      0x40060: new RingOscillator(chip),
      0x40064: new ChipReset(chip),
    });
  }

  /** AIRCR.SYSRESETREQ resets the processor alone (data sheet sec. 2.4.2.9): peripherals go on. */
  #answerSystemReset(chip) {
    const kAircr = 0xd0c, kKey = 0x05fa, kSystemReset = 1 << 2;
    const { ppb } = chip;
    const write = ppb.writeUint32.bind(ppb);
    ppb.writeUint32 = (offset, value) => {
      if (offset !== kAircr) return write(offset, value);
      if (value >>> 16 !== kKey || !(value & kSystemReset)) return;
      this.pendingReset = 'core';
      this.interrupted = true;
    };
    const read = ppb.readUint32.bind(ppb);
    ppb.readUint32 = (offset) => (offset === kAircr ? 0xfa050000 : read(offset));
  }

  #reset() {
    const kept = this.pendingReset;
    this.pendingReset = null;
    this.resets++;
    if (kept === 'core') return this.#start();
    const { flash, sram, clock, peripherals } = this.mcu;
    this.pastNanos += clock.nanos - this.startNanos;
    this.#powerOn(0);
    this.mcu.flash.set(flash);
    this.mcu.sram.set(sram);
    this.mcu.peripherals[0x40064].values[0x08] = kept.chipReset ?? peripherals[0x40064].values[0x08];
    this.mcu.peripherals[0x40058].reason = kept.reason;
    this.mcu.peripherals[0x40058].scratchData.set(kept.scratch);
    this.#start();
  }

  #start() {
    const { core } = this.mcu;
    Object.assign(core, { waiting: false, PM: false, IPSR: 0, enabledInterrupts: 0, currentMode: 0 });
    Object.assign(core, { pendingSystick: false, pendingPendSV: false, pendingSVCall: false, pendingNMI: false });
    this.ssi.mapSlowRead();
    if (this.bootMode === 'vectors') {
      core.VTOR = kVectors;
      core.reset();
    } else if (!this.rom.start()) {
      this.#report('the checksum of boot2 is wrong: the ROM stays in the USB bootloader');
      this.#stop('USB bootloader');
    }
    this.onReset(this);
  }

  #report(rule) {
    const known = this.findings.some((finding) => finding.endsWith(rule));
    const place = `${this.seconds.toFixed(6)} s, pc 0x${(this.mcu.core.PC >>> 0).toString(16)}`;
    if (!known) this.findings.push(`${place}: ${rule}`);
  }
}
