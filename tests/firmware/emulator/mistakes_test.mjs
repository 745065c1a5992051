// SPDX-License-Identifier: Apache-2.0
// Plants one mistake at a time in good probes: each must be caught by its own rule, and by no other.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { buildProbe } from '../probes/build.mjs';
import { CdcPort } from './cdc.mjs';
import { Emulator } from './rp2040.mjs';

/** Builds and runs a probe; returns its problems without time and place. */
async function problemsOf(name, define, use = (emulator) => emulator.run(0.02)) {
  const emulator = new Emulator(await buildProbe(name, define));
  use(emulator);
  return emulator.problems.map((problem) => problem.replace(/^.*?: /, ''));
}

function caughtBy(problems, rule) {
  assert.notEqual(problems.length, 0, 'nothing was reported');
  for (const problem of problems) assert.match(problem, rule);
}

const kSilicon = {
  adc_in_reset: /^(read|write) of ADC .* while it is held in reset/,
  no_tick: /WATCHDOG_TICK was never enabled/,
  slow_tick: /WATCHDOG_TICK runs at 96000 Hz/,
  early_crystal: /switched to the crystal before it is stable/,
  early_pll: /PLL_USB_BASE started before the crystal/,
  pll_powered_down: /while a part of it is powered down/,
  too_fast: /clk_sys at 150000000 Hz/,
  slow_vco: /VCO at 720000000 Hz/,
  aux_in_use: /AUXSRC of clk_sys changed while it is in use/,
  no_clk_peri: /UART0 sends while clk_peri is off/,
  uart_off: /UART0 sends while it is not enabled|written into a full transmit FIFO/, // which then fills
  uart_function: /UART0 sends while GPIO0 has another function/,
  uart_pad: /UART0 sends while GPIO0's pad is disabled/,
  uart_overrun: /written into a full transmit FIFO/,
  no_clk_adc: /without a 48 MHz clk_adc/,
  adc_digital_input: /digital input of GPIO26 is on/,
  adc_pull: /GPIO26 is pulled/,
  no_temperature_sensor: /TS_EN = 0/,
  adc_dma_threshold: /DMA at FIFO threshold 2/,
  led_function: /GPIO25 set high while its function is 31/,
  crooked_vectors: /VTOR set to 0x10000140/,
  writes_flash: /write to flash at 0x10010000/,
  writes_rom: /write to ROM at 0x100/,
  ssi_enabled: /SSI register 0x14 written while SSIENR = 1/,
  ssi_no_mode: /SSI data written without an enabled 8-bit/,
  unaligned_read: /32-bit read of 0x20000002/,
  unaligned_write: /32-bit write of 0x20000002/,
  unmapped: /access to 0x60000000, where nothing is/,
  undefined_instruction: /undefined instruction 7/,
  breakpoint: /breakpoint .* 1/,
};

test('good use of clocks, pins, UART and ADC breaks no rule', async () => {
  assert.deepEqual(await problemsOf('mistakes'), []);
});

for (const [mistake, rule] of Object.entries(kSilicon)) {
  test(`silicon: ${mistake} is caught`, async () => caughtBy(await problemsOf('mistakes', `MISTAKE=${mistake}`), rule));
}

const kFlash = {
  'MISTAKE_NO_CONNECT': /connect_internal_flash/,
  'MISTAKE_NO_UNMAP': /called without connect_internal_flash/,
  'MISTAKE_NO_FLUSH': /without flash_flush_cache/,
  'MISTAKE_FLASH_CODE': /while it is not mapped/,
  'FLASH_OFFSET=0x1f0100': /is not aligned to 4096/,
  'FLASH_OFFSET=0x200000': /is beyond the flash/,
};

for (const [define, rule] of Object.entries(kFlash)) {
  test(`flash: ${define} is caught`, async () => {
    caughtBy(await problemsOf('storage', define, (emulator) => emulator.run(0.2)), rule);
  });
}

test('reset: a watchdog that would reset nothing is caught', async () => {
  caughtBy(await problemsOf('reset', 'MISTAKE_NO_SELECTION', (emulator) => emulator.run(0.004)), /PSM.WDSEL leaves out/);
});

test('boot: a wrong checksum of boot2 stays in the bootloader', async () => {
  const emulator = new Emulator(await buildProbe('core'));
  emulator.mcu.flash[0] ^= 1;
  emulator.pressReset();
  assert.equal(emulator.stopped, 'USB bootloader');
  assert.match(emulator.problems.join(), /checksum of boot2/);
});

test('rp2040js: its warnings are collected', async () => {
  const emulator = new Emulator(await buildProbe('core'));
  emulator.mcu.readUint32(0x40008ff0);
  assert.match(emulator.warnings.join(), /Unimplemented peripheral read/);
});

const kUsb = {
  no_clock: /clk_usb is not an enabled 48 MHz/,
  no_controller: /CONTROLLER_EN = 0/,
  no_vbus: /without VBUS detected/,
  no_endpoint_enable: /endpoint 2 (IN|OUT) armed while its EP_CTRL.ENABLE = 0/,
  no_stall_arm: /endpoint 0 stalled without EP_STALL_ARM/,
  no_toggle: /endpoint 2 IN uses DATA0, expected DATA1/,
  no_full: /endpoint 0 IN armed without FULL/,
  full_out: /endpoint 2 OUT armed with FULL/,
  available_at_once: /armed without writing the rest of its control first/,
  overlong: /armed for 128 bytes/,
  short_out: /armed for 8 bytes, got 64/,
  low_buffer: /has its buffer at 0x140/,
  double_buffer: /is double buffered/,
  address_early: /device answers address 7, expected 0/,
  long_status: /status stage is not empty/,
  long_reply: /control IN data longer than wLength/,
  no_strings: /descriptor 3.1 refused/,
  no_configuration: /standard request 9 refused/,
  stalled_bulk: /bulk IN endpoint stalled/,
  late_in_frame: /armed in the last fifth of a frame/,
};

/** Enumerates, asks for a descriptor that full-speed devices refuse, and moves data both ways. */
function useUsb(emulator) {
  const kDeviceQualifier = Uint8Array.of(0x80, 6, 0, 6, 0, 0, 10, 0);
  const port = new CdcPort(emulator);
  port.attach();
  port.setLineState({ dtr: true });
  port.write(new Uint8Array(200).fill(7));
  port.flush();
  assert.equal(port.controlTransfer(kDeviceQualifier).status, 'stall');
  emulator.run(0.01);
}

test('good use of USB breaks no rule', async () => assert.deepEqual(await problemsOf('usb', undefined, useUsb), []));

for (const [mistake, rule] of Object.entries(kUsb)) {
  test(`USB: ${mistake} is caught`, async () => {
    const use = (emulator) => {
      try {
        useUsb(emulator);
      } catch (error) {
        assert.match(error.message, /in vain/); // some devices then work no further
      }
    };
    caughtBy(await problemsOf('usb', `MISTAKE=${mistake}`, use), rule);
  });
}

test('USB: no_pull_up is caught', async () => {
  await assert.rejects(problemsOf('usb', 'MISTAKE=no_pull_up', useUsb), /in vain for the device to attach/);
});
