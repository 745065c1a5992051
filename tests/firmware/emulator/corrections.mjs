// SPDX-License-Identifier: Apache-2.0
// What rp2040js 1.4.1 gets wrong of the RP2040 (DS: its data sheet), put right on one chip.

import { correctNvic, correctSleep, correctSystick } from './core_corrections.mjs';

/**
 * @param {import('./chip.mjs').Chip} chip before its first instruction
 */
export function correct(chip) {
  startOnRingOscillator(chip);
  correctNvic(chip);
  correctSleep(chip);
  correctSystick(chip);
  correctTimer(chip);
  correctAdcSequence(chip);
  correctAdcStatus(chip);
  correctDmaAbort(chip);
  correctResets(chip);
  correctWatchdogTick(chip);
  correctOscillatorStart(chip);
}

/** Fault: clk_sys starts at 125 MHz. DS 2.15.1: it starts on the ring oscillator. */
function startOnRingOscillator(chip) {
  chip.updateClocks();
}

/**
 * Fault: an alarm fires up to 1 us early, before TIMERAWL shows its value. DS 4.6.3: it fires when the lower 32 bits
 * become equal. The nanosecond added to the time takes the rounding of 64-bit floats out of the microseconds.
 */
function correctTimer(chip) {
  const kAlarm0 = 0x10, kAlarm3 = 0x1c, kTimelr = 0x0c, kTimerawl = 0x28;
  const timer = chip.peripherals[0x40054];
  const nanos = () => chip.clock.nanos + 1;
  const read = timer.readUint32.bind(timer);
  timer.readUint32 = (offset) => {
    const value = read(offset);
    return offset === kTimelr || offset === kTimerawl ? Math.floor(nanos() / 1000) >>> 0 : value;
  };
  const write = timer.writeUint32.bind(timer);
  timer.writeUint32 = (offset, value) => {
    write(offset, value);
    if (offset < kAlarm0 || offset > kAlarm3) return;
    const ahead = (value - Math.floor(nanos() / 1000)) >>> 0;
    const within = nanos() % 1000;
    timer.alarms[(offset - kAlarm0) / 4].clockAlarm.schedule(ahead === 0 ? 0 : ahead * 1000 - within + 1);
  };
}

/**
 * Faults: the round robin never leaves channel 0 (the setter masks with the shift); conversions go on with EN clear; a
 * conversion paced by DIV survives START_MANY being cleared, and writing CS again starts another. DS 4.9.2.1, 4.9.5.
 */
function correctAdcSequence({ adc }) {
  const kCs = 0, kEnable = 1, kStartOne = 1 << 2, kStartMany = 1 << 3;
  Object.defineProperty(adc, 'activeChannel', {
    get() { return (this.cs >> 12) & 7; },
    set(channel) { this.cs = (this.cs & ~(7 << 12)) | ((channel % 5) << 12); },
  });
  const start = adc.startADCRead.bind(adc);
  adc.startADCRead = () => adc.cs & kEnable && start();
  const write = adc.writeUint32.bind(adc);
  adc.writeUint32 = (offset, value) => {
    const running = kEnable | kStartMany;
    const continues = offset === kCs && (adc.cs & value & running) === running && !(value & kStartOne);
    if (offset === kCs && (value & running) !== running) adc.multiShotAlarm.cancel();
    if (!continues) return write(offset, value);
    const idle = adc.busy;
    adc.busy = true; // as if converting: the pacing in progress is left alone
    write(offset, value);
    adc.busy = idle;
  };
}

/**
 * Faults: START_ONE stays set and READY shows without EN (DS 4.9.5, CS); the interrupt outlives the FIFO's level
 * (INTR); DREQ does not follow writes of FCS (DS 4.9.2.5); ERR_STICKY is cleared in the wrong register.
 */
function correctAdcStatus({ adc, dma }) {
  const kCs = 0x00, kFcs = 0x08, kFifo = 0x0c, kDreqEnable = 1 << 3;
  const read = adc.readUint32.bind(adc);
  adc.readUint32 = (offset) => {
    let value = read(offset);
    if (offset === kFifo) adc.checkInterrupts();
    if (offset === kCs) value &= adc.cs & 1 ? ~(1 << 2) : ~((1 << 2) | (1 << 8));
    return value >>> 0;
  };
  const write = adc.writeUint32.bind(adc);
  adc.writeUint32 = (offset, value) => {
    const flags = adc.fcs;
    write(offset, value);
    if (offset === kCs) {
      adc.fcs = flags;
      adc.cs &= ~(value & (1 << 10));
    }
    if (offset === kFcs && value & kDreqEnable) adc.updateDMA();
    if (offset === kFcs && !(value & kDreqEnable)) dma.clearDREQ(adc.dreq);
  };
}

/** Fault: CHAN_ABORT reads as not implemented, so that waiting for its bits to clear never ends. DS 2.5.7. */
function correctDmaAbort({ dma }) {
  const kChanAbort = 0x444;
  const read = dma.readUint32.bind(dma);
  dma.readUint32 = (offset) => (offset === kChanAbort ? 0 : read(offset));
}

/**
 * Fault: RESETS does nothing, and starts with everything out of reset. DS 2.14.3: all is held in reset but what the ROM
 * has released; RESET_DONE follows; and a reset takes the USB pull-up away and stops ADC and DMA.
 */
function correctResets(chip) {
  const kReset = 0, kAdc = 1 << 0, kDma = 1 << 2, kUsb = 1 << 24;
  const kReleasedByRom = (1 << 6) | (1 << 9) | (1 << 18) | (1 << 19) | (1 << 20); // QSPI pads, SYSCFG, SYSINFO, TBMAN
  const { adc, dma, usbCtrl } = chip;
  const resets = chip.peripherals[0x4000c];
  resets.reset = 0x1ffffff & ~kReleasedByRom;
  Object.defineProperty(resets, 'reset_done', { get() { return 0x1ffffff & ~this.reset; }, set() {} });
  const write = resets.writeUint32.bind(resets);
  resets.writeUint32 = (offset, value) => {
    const rising = offset === kReset ? value & ~resets.reset : 0;
    if (rising & kAdc) resetAdc(adc);
    if (rising & kDma) dma.channels.forEach((channel) => { channel.abort(); channel.reset(); });
    if (rising & kUsb) resetUsb(usbCtrl);
    write(offset, value);
  };
}

function resetAdc(adc) {
  const kCs = 0x00, kInte = 0x18;
  adc.writeUint32(kCs, 0);
  adc.writeUint32(kInte, 0);
  adc.fcs = 0;
  adc.fifo.reset();
}

function resetUsb(usb) {
  const kSieControl = 0x4c;
  usb.writeUint32(kSieControl, 0);
  Object.assign(usb, { addrEndp: 0, mainCtrl: 0, intEnable: 0, intForce: 0, sieStatus: 0, buffStatus: 0, intRaw: 0 });
  usb.checkInterrupts();
}

/** Fault: TICK reads without its CYCLES. DS 4.7.6. */
function correctWatchdogTick(chip) {
  const kTick = 0x2c;
  const watchdog = chip.peripherals[0x40058];
  let cycles = 0;
  const read = watchdog.readUint32.bind(watchdog);
  watchdog.readUint32 = (offset) => (offset === kTick ? read(offset) | cycles : read(offset));
  const write = watchdog.writeUint32.bind(watchdog);
  watchdog.writeUint32 = (offset, value) => {
    if (offset === kTick) cycles = value & 0x1ff;
    write(offset, value);
  };
}

/** Faults: the crystal is stable and PLLs are locked at once. DS 2.16.3: after STARTUP * 256 cycles; 2.18.2: powered. */
function correctOscillatorStart(chip) {
  const xosc = chip.peripherals[0x40024];
  const stable = chip.clock.createAlarm(() => { xosc.stable = xosc.enabled; });
  const write = xosc.writeUint32.bind(xosc);
  xosc.writeUint32 = (offset, value) => {
    const before = xosc.stable;
    write(offset, value);
    if (offset !== 0 || before || !xosc.stable) return;
    xosc.stable = false;
    const cycles = 256 * (xosc.startup & 0x3fff) * (xosc.startup >> 20 ? 4 : 1);
    stable.schedule((cycles * 1e9) / chip.xoscFreq);
  };
  for (const pll of [chip.pllSys, chip.pllUsb]) {
    const read = pll.readUint32.bind(pll);
    const kPowerDown = 1 << 0, kVcoPowerDown = 1 << 5, kLock = 0x7fffffff;
    pll.readUint32 = (offset) => {
      const value = read(offset);
      return offset === 0 && pll.pwr & (kPowerDown | kVcoPowerDown) ? value & kLock : value >>> 0;
    };
  }
}
