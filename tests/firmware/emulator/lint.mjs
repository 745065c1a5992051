// SPDX-License-Identifier: Apache-2.0
// Rules that silicon enforces by not working, and rp2040js does not enforce (DS: the RP2040's data sheet).

const kSio = 5, kUart = 2; // GPIO functions
const kClockEnable = 1 << 11;

/**
 * Watches a chip from before its first instruction; broken rules go to `chip.report`.
 * @param {import('./chip.mjs').Chip} chip
 */
export function lint(chip) {
  forbidAccessInReset(chip);
  requireTick(chip);
  requireWatchdogSelection(chip);
  requireClockOrder(chip);
  requireUartSetUp(chip);
  requireAdcSetUp(chip);
  requireOutputFunction(chip);
  requireAlignedVectors(chip);
}

/** Calls `onRead(offset)` before each read and `onWrite(offset, value)` before each write of a peripheral. */
function watch(peripheral, { onRead = () => {}, onWrite = () => {} }) {
  const read = peripheral.readUint32.bind(peripheral);
  peripheral.readUint32 = (offset) => {
    onRead(offset);
    return read(offset);
  };
  const write = peripheral.writeUint32.bind(peripheral);
  peripheral.writeUint32 = (offset, value) => {
    onWrite(offset, value);
    write(offset, value);
  };
}

/** DS 2.14.1: a peripheral held in reset does not answer. Keys: addresses >> 12; values: bits of RESETS. */
const kResetBits = {
  0x4004c: 0, 0x40030: 1, 0x50000: 2, 0x40044: 3, 0x40048: 4, 0x40014: 5, 0x4001c: 8, 0x40028: 12, 0x4002c: 13,
  0x40050: 14, 0x50200: 10, 0x50300: 11, 0x4005c: 15, 0x4003c: 16, 0x40040: 17, 0x40054: 21, 0x40034: 22,
  0x40038: 23, 0x50110: 24,
};

function forbidAccessInReset(chip) {
  const resets = chip.peripherals[0x4000c];
  for (const [base, bit] of Object.entries(kResetBits)) {
    const peripheral = chip.peripherals[base];
    const check = (verb) => (offset) => {
      if (resets.reset & (1 << bit)) {
        chip.report(`${verb} of ${peripheral.name} + 0x${offset.toString(16)} while it is held in reset`);
      }
    };
    watch(peripheral, { onRead: check('read'), onWrite: check('write') });
  }
}

/** DS 4.7.2: TIMER and watchdog count TICK's ticks, CYCLES of clk_ref long; they are meant to be microseconds. */
function requireTick(chip) {
  const kTick = 0x2c, kEnable = 1 << 9, kWatchdogControl = 0, kWatchdogEnable = 1 << 30;
  let ticks = false;
  const check = (user) => {
    if (!ticks) chip.report(`${user} used, but WATCHDOG_TICK was never enabled`);
  };
  watch(chip.peripherals[0x40058], {
    onWrite(offset, value) {
      if (offset === kWatchdogControl && value & kWatchdogEnable) check('watchdog');
      if (offset !== kTick) return;
      ticks = (value & kEnable) !== 0;
      const hertz = chip.clocks.refFreq / (value & 0x1ff);
      if (ticks && hertz !== 1e6) chip.report(`WATCHDOG_TICK runs at ${hertz} Hz, expected 1 MHz`);
    },
  });
  watch(chip.peripherals[0x40054], { onRead: () => check('TIMER'), onWrite: () => check('TIMER') });
}

/** DS 2.13.2, 4.7.1: a watchdog resets what PSM.WDSEL selects, by default nothing. */
function requireWatchdogSelection(chip) {
  const kEverythingButOscillators = 0x1fffc, kControl = 0, kFires = (1 << 30) | (1 << 31);
  const psm = chip.peripherals[0x40010];
  watch(chip.peripherals[0x40058], {
    onWrite(offset, value) {
      const missing = kEverythingButOscillators & ~psm.wdsel;
      if (offset === kControl && value & kFires && missing) {
        chip.report(`watchdog armed while PSM.WDSEL leaves out 0x${missing.toString(16)}`);
      }
    },
  });
}

/** DS 2.15.3, 2.16.3, 2.18.2: sources are to run before they are chosen, within their limits. */
function requireClockOrder(chip) {
  const kRefControl = 0x30, kSysControl = 0x3c, kXosc = 2, kAux = 1, kMaxSysHertz = 133e6;
  const { clocks, pllSys, pllUsb } = chip;
  const xosc = chip.peripherals[0x40024];
  watch(clocks, {
    onWrite(offset, value) {
      if (offset === kRefControl && (value & 3) === kXosc && !xosc.stable) {
        chip.report('clk_ref switched to the crystal before it is stable');
      }
      if (offset === kSysControl) checkSys(value);
    },
  });
  const checkSys = (value) => {
    const auxiliary = (value >> 5) & 7;
    if (clocks.sysCtrl & kAux && value & kAux && auxiliary !== ((clocks.sysCtrl >> 5) & 7)) {
      chip.report('AUXSRC of clk_sys changed while it is in use');
    }
    const pll = [pllSys, pllUsb][auxiliary];
    if (!(value & kAux) || !pll) return;
    if (pll.pwr & 0x29) chip.report(`clk_sys switched to ${pll.name} while a part of it is powered down`);
    if (pll.frequency > kMaxSysHertz) chip.report(`clk_sys at ${pll.frequency} Hz, at most ${kMaxSysHertz}`);
  };
  for (const pll of [pllSys, pllUsb]) {
    watch(pll, {
      onWrite(offset, value) {
        const kPower = 4, kPostDividers = 0x0c;
        if (offset === kPower && !(value & 1) && !xosc.stable) chip.report(`${pll.name} started before the crystal`);
        const vco = (chip.xoscFreq / pll.refdiv) * pll.fbdiv;
        if (offset === kPostDividers && (vco < 750e6 || vco > 1600e6)) {
          chip.report(`${pll.name}: VCO at ${vco} Hz, expected 750 to 1600 MHz`);
        }
      },
    });
  }
}

/** DS 4.2.3, 2.19.2: UART0 sends if it is clocked, enabled and connected to its pin. */
function requireUartSetUp(chip) {
  const kData = 0;
  watch(chip.uart[0], {
    onWrite(offset) {
      if (offset !== kData) return;
      if (!(chip.clocks.periCtrl & kClockEnable)) chip.report('UART0 sends while clk_peri is off');
      if (!chip.uart[0].sends) chip.report('UART0 sends while it is not enabled');
      if (chip.gpio[0].functionSelect !== kUart) chip.report('UART0 sends while GPIO0 has another function');
      if (chip.gpio[0].outputDisable) chip.report("UART0 sends while GPIO0's pad is disabled");
    },
  });
}

/** DS 4.9.2, 4.9.3: 48 MHz, quiet pads, a powered temperature sensor, and one DMA request per result. */
function requireAdcSetUp(chip) {
  const kFcs = 8, kDreqEnable = 1 << 3, kTemperatureEnable = 1 << 1;
  const { adc } = chip;
  const convert = adc.onADCRead;
  adc.onADCRead = (channel) => {
    const clocked = chip.clocks.adcCtrl & kClockEnable && chip.pllUsb.frequency === 48e6;
    if (!clocked) chip.report('ADC converts without a 48 MHz clk_adc');
    if (channel < 4) checkPad(channel);
    else if (!(adc.cs & kTemperatureEnable)) chip.report('ADC converts the temperature sensor while TS_EN = 0');
    convert(channel);
  };
  const checkPad = (channel) => {
    const pin = 26 + channel, { inputEnable, pullupEnabled, pulldownEnabled } = chip.gpio[pin];
    if (inputEnable) chip.report(`ADC converts channel ${channel} while the digital input of GPIO${pin} is on`);
    if (pullupEnabled || pulldownEnabled) chip.report(`ADC converts channel ${channel} while GPIO${pin} is pulled`);
  };
  watch(adc, {
    onWrite(offset, value) {
      const threshold = (value >> 24) & 0x0f;
      if (offset === kFcs && value & kDreqEnable && threshold !== 1) {
        chip.report(`ADC requests DMA at FIFO threshold ${threshold}, expected 1`);
      }
    },
  });
}

/** DS 2.19.2, 2.19.4: an output set high shows on the pin only with function SIO and the pad's output on. */
function requireOutputFunction(chip) {
  const kOut = 0x10, kOutSet = 0x14, kOutXor = 0x1c;
  const { sio } = chip;
  const write = sio.writeUint32.bind(sio);
  sio.writeUint32 = (offset, value) => {
    write(offset, value);
    if (offset !== kOut && offset !== kOutSet && offset !== kOutXor) return;
    for (const { index, functionSelect, outputDisable } of chip.gpio) {
      const drives = sio.gpioOutputEnable & sio.gpioValue & value & (1 << index);
      if (drives && (functionSelect !== kSio || outputDisable)) {
        chip.report(`GPIO${index} set high while its function is ${functionSelect}, expected SIO (5), or its pad is off`);
      }
    }
  };
}

/** ARMv6-M B3.2.5, DS 2.4.8: VTOR's low eight bits are not there. */
function requireAlignedVectors(chip) {
  const kVtor = 0xd08;
  watch(chip.ppb, {
    onWrite(offset, value) {
      if (offset === kVtor && value & 0xff) chip.report(`VTOR set to 0x${value.toString(16)}, not aligned to 256`);
    },
  });
}
