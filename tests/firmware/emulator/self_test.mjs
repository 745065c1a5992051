// SPDX-License-Identifier: Apache-2.0
// Shows that the emulator does what the data sheets say, by probes that run on it; one probe, several statements.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { test } from 'node:test';
import { buildProbe } from '../probes/build.mjs';
import { CdcPort } from './cdc.mjs';
import { readElf } from './elf.mjs';
import { Emulator } from './rp2040.mjs';

/** A probe that has run for `seconds` without a problem. */
async function ran(name, seconds, options) {
  const emulator = new Emulator(await buildProbe(name), options);
  emulator.analog((channel) => 1000 + channel);
  emulator.run(seconds);
  assert.deepEqual(emulator.problems, []);
  return emulator;
}

const words = (emulator, name, count) => Array.from({ length: count }, (_, index) => emulator.read32(name, 4 * index));

test('interrupts, sleep, SysTick and alarms follow the Cortex-M0+ and the data sheet', async (context) => {
  const emulator = await ran('core', 0.5);
  const reads = (name, expected) => assert.equal(emulator.read32(name), expected, name);
  reads('done', 1);
  await context.test('an interrupt pended by software is taken once', () => reads('software_interrupts', 2));
  await context.test('an interrupt whose line fell while masked is still taken', () => reads('latched_interrupts', 1));
  await context.test('WFI under PRIMASK wakes without the handler', () => {
    reads('handled_in_critical', 0);
    reads('handled_after', 1);
  });
  await context.test('WFI does not wait for what is already pending', () => reads('already_pending_wakes', 1));
  await context.test('an alarm never fires before its microsecond', () => {
    reads('alarm_seen', emulator.read32('alarm_asked'));
  });
  await context.test('SysTick wakes, and its period is RVR + 1 cycles', () => {
    reads('systick_at_start', 0);
    reads('systick_wakes', 1001);
    assert.equal(emulator.read32('systick_last_us') - emulator.read32('systick_first_us'), 100_000);
  });
  await context.test('the crystal takes its 1 ms, at 6.5 MHz of the ring oscillator', () => {
    const cycles = emulator.read32('crystal_polls') * 11;
    assert.ok(Math.abs(cycles - 6517) < 100, `${cycles} cycles, expected 47 * 256 / 12 MHz * 6.5 MHz = 6517`);
  });
  await context.test('a PLL that is off is not locked', () => reads('pll_lock_while_off', 0));
  await context.test('peripherals start held in reset', () => reads('resets_done_at_start', 0x1c0240));
  await context.test('TICK reads back', () => reads('tick_register', 12 | (1 << 9)));
});

test('the ADC follows its data sheet', async (context) => {
  const emulator = await ran('analog', 0.5);
  const reads = (name, expected) => assert.equal(emulator.read32(name), expected, name);
  reads('done', 1);
  await context.test('it is not ready while off, and START_ONE clears', () => {
    reads('ready_while_off', 0);
    reads('start_one_after', 0);
  });
  await context.test('the round robin alternates', () => {
    assert.deepEqual(words(emulator, 'round_robin', 4), [1000, 1001, 1000, 1001]);
  });
  await context.test('the FIFO interrupt ends with its level', () => {
    reads('fifo_interrupts', 5);
    reads('fifo_level_after', 0);
  });
  await context.test('pacing goes on when CS is written, and ends with START_MANY', () => {
    reads('paced_conversions', 1);
    reads('restarted_conversions', 1);
  });
  await context.test('DMA restarted by its interrupt fills every block', () => {
    reads('blocks_done', 12);
    const pairs = words(emulator, 'blocks', 12 * 16);
    const inStep = (1001 << 16) | 1000; // two results a word
    assert.deepEqual(new Set(pairs), new Set([inStep]));
  });
  await context.test('CHAN_ABORT reads back clear', () => reads('abort_reads', 0));
});

test('analog values are asked for at the instant of each conversion', async () => {
  const emulator = new Emulator(await buildProbe('analog'));
  const times = [];
  emulator.analog((channel, seconds) => {
    times.push(seconds);
    return 0;
  });
  emulator.run(0.01);
  const steps = times.slice(-300).map((time, index, all) => (index ? time - all[index - 1] : 2e-6));
  assert.ok(steps.every((step) => Math.abs(step - 2e-6) < 1e-9), 'expected 2 us between conversions');
});

test('UART0 works in real time, by levels', async (context) => {
  const emulator = await ran('serial', 0.005);
  const text = () => Buffer.from(emulator.uart.bytes.splice(0)).toString();
  await context.test('24 bytes take 24 * 10 bits at 115207 baud', () => {
    assert.equal(text(), 'abcdefghijklmnopqrstuvwx');
    assert.ok(Math.abs(emulator.read32('sent_us') - 2083) <= 2);
  });
  await context.test('the transmit interrupt comes on passing the level downwards, not before', () => {
    assert.equal(emulator.read32('interrupts_before_data'), 0);
    assert.equal(emulator.read32('transmit_interrupts'), 1);
  });
  await context.test('few bytes arrive by the timeout interrupt', () => {
    emulator.uart.write(Buffer.from('hello'));
    emulator.run(0.002);
    assert.equal(text(), 'hello');
    assert.equal(emulator.read32('receive_interrupts'), 1);
  });
  assert.deepEqual(emulator.problems, []);
});

test('resets keep what silicon keeps', async (context) => {
  const boots = [];
  const emulator = new Emulator(await buildProbe('reset'), { onReset: ({ seconds }) => boots.push(seconds) });
  emulator.run(0.1);
  assert.equal(emulator.read32('done'), 1);
  await context.test('time-out, trigger, processor and fault resets are counted', () => {
    assert.equal(emulator.resets, 4);
    assert.equal(boots.length, 5);
  });
  await context.test('the watchdog fires when its time is over', () => {
    assert.ok(Math.abs(boots[1] - 0.006) < 0.0002, `after ${boots[1]} s, expected 1 ms of start-up and 5 ms`);
  });
  await context.test('SRAM and scratch registers stay', () => assert.equal(emulator.read32('kept'), 105));
  await context.test('REASON tells time-out (1) from trigger (2)', () => {
    assert.deepEqual(words(emulator, 'reasons', 5), [0, 1, 2, 2, 2]);
  });
  await context.test('SYSRESETREQ leaves the peripherals as they are', () => {
    assert.deepEqual(words(emulator, 'uart_divisors', 5), [0, 0, 0, 67, 0]);
  });
  await context.test('TIMER starts at zero', () => assert.ok(emulator.read32('timer_at_start') < 1500));
  await context.test('a HardFault is taken at its instruction, and listed', () => {
    assert.equal(emulator.read32('fault_pc'), emulator.symbols.get('fault_here') + 2);
    assert.match(emulator.problems.join(), /^HardFault at pc .* 32-bit read of 0x1, which is not aligned$/);
  });
  await context.test('the reset button clears the scratch registers', () => {
    emulator.pressReset();
    emulator.run(0.001);
    assert.equal(emulator.read32('kept'), 101);
  });
});

test('the flash answers, changes as NOR flash does, and outlives a reset', async (context) => {
  const uniqueId = Uint8Array.of(1, 2, 3, 4, 0xa5, 6, 7, 8);
  const emulator = await ran('storage', 0.5, { uniqueId });
  const reads = (name, expected) => assert.equal(emulator.read32(name), expected, name);
  await context.test('the unique id is read by command 4Bh', () => {
    assert.deepEqual(words(emulator, 'unique_id', 2), [0x04030201, 0x080706a5]);
  });
  await context.test('programming only clears bits', () => reads('found', 0xf0 & 0x3c));
  await context.test('a reset keeps flash and SRAM', () => reads('boots', 2));
  await context.test('reset_to_usb_boot stops in the bootloader', () => {
    assert.equal(emulator.bootloader, true);
    assert.equal(emulator.stopped, 'USB bootloader');
  });
});

/** The ELF as UF2 blocks of 256 bytes, written by the format's description. */
function asUf2(elf) {
  const { segments } = readElf(elf);
  const pages = segments.flatMap(({ address, bytes }) =>
    Array.from({ length: Math.ceil(bytes.length / 256) }, (_, page) => [address + 256 * page, bytes.subarray(256 * page)]));
  return Buffer.concat(pages.map(([address, bytes], number) => {
    const block = Buffer.alloc(512);
    const header = [0x0a324655, 0x9e5d5157, 0x2000, address, 256, number, pages.length, 0xe48bff56];
    header.forEach((word, index) => block.writeUInt32LE(word, 4 * index));
    block.set(bytes.subarray(0, 256), 32);
    block.writeUInt32LE(0x0ab16f30, 508);
    return block;
  }));
}

test('a UF2 runs as its ELF does, and a wrong one is refused', async () => {
  const elf = await buildProbe('serial');
  const uf2 = elf.replace('.elf', '.uf2');
  fs.writeFileSync(uf2, asUf2(elf));
  const emulator = new Emulator(uf2);
  emulator.run(0.005);
  assert.equal(Buffer.from(emulator.uart.bytes).toString(), 'abcdefghijklmnopqrstuvwx');
  fs.truncateSync(uf2, 512);
  assert.throws(() => new Emulator(uf2), /block 0: count of blocks is \d+, expected 1/);
});

test('a timer near its wrap starts there', async () => {
  const emulator = await ran('reset', 0.004, { timerMicros: 2 ** 32 - 500 });
  assert.ok(emulator.read32('timer_at_start') < 1000);
  assert.ok(Math.abs(emulator.seconds - 0.004) < 1e-6);
});

test('the USB host behaves as a PC', async (context) => {
  const emulator = new Emulator(await buildProbe('usb'));
  const port = new CdcPort(emulator);
  const { strings } = port.attach();
  await context.test('it enumerates', () => assert.deepEqual(strings.slice(1), ['Probe', 'Probe', 'Probe']));
  await context.test('line coding and DTR reach the device', () => {
    port.setLineCoding(9600);
    port.setLineState({ dtr: true });
    assert.deepEqual([port.lineCoding(), emulator.read32('line_state')], [9600, 1]);
  });
  await context.test('a reader that is absent costs nothing but time', () => {
    port.stopReading();
    port.read();
    emulator.run(0.1);
    assert.equal(port.read().length, 0);
    port.resumeReading();
    emulator.run(0.01);
    const bytes = port.read();
    assert.ok(bytes.length >= 8 * 64 && bytes.every((byte, index) => byte === ((bytes[0] + index) & 0xff)));
  });
  await context.test('what is written arrives', () => {
    port.stopReading();
    port.write([42]);
    port.flush();
    port.resumeReading();
    emulator.run(0.004);
    assert.ok(port.read().includes(42));
  });
  await context.test('unplugged and plugged, it enumerates again', () => {
    port.unplug();
    emulator.run(0.05);
    assert.equal(port.device, null);
    port.plug();
    port.attach();
  });
  await context.test('a reset of the chip detaches and attaches again', () => {
    emulator.pressReset();
    port.attach();
  });
  await context.test('touch1200 sets 1200 baud and drops DTR', () => {
    port.touch1200();
    assert.deepEqual([emulator.read32('baud'), emulator.read32('line_state')], [1200, 0]);
  });
  assert.deepEqual(emulator.problems, []);
});
