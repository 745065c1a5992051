// SPDX-License-Identifier: Apache-2.0
// Compiles a probe into an ELF that the mask ROM would boot.

import { execFile, execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { promisify } from 'node:util';
import { crc32Mpeg2 } from '../emulator/bootrom.mjs';

const kCompiler = 'arm-none-eabi-g++';
const kFlags = [
  '-mcpu=cortex-m0plus', '-mthumb', '-Os', '-std=c++20', '-fno-exceptions', '-fno-rtti', '-Wall', '-Wextra', '-Werror',
  '--param=min-pagesize=0', // the ROM's table is at address 0x14
];
const folder = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
const output = fs.mkdtempSync(path.join(os.tmpdir(), 'penduline-probes-'));
process.on('exit', () => fs.rmSync(output, { recursive: true }));

const shared = ['boot2.S', 'start.cpp'].map((source) => {
  const object = path.join(output, `${source}.o`);
  execFileSync(kCompiler, [...kFlags, '-c', path.join(folder, source), '-o', object]);
  return object;
});

/**
 * @param {string} name of a source in this folder, without `.cpp`
 * @param {string} [define] a macro to define: the mistake to plant
 * @returns {Promise<string>} the ELF's path
 */
export async function buildProbe(name, define) {
  const elf = path.join(output, `${name}${define ? `-${define}` : ''}.elf`);
  const source = path.join(folder, `${name}.cpp`);
  await promisify(execFile)(kCompiler, [
    ...kFlags, ...(define ? [`-D${define}`] : []), '-nostartfiles', '--specs=nano.specs', '--specs=nosys.specs',
    '-T', path.join(folder, 'probe.ld'), ...shared, source, '-o', elf,
  ]);
  signBoot2(elf);
  return elf;
}

/** Puts the checksum behind boot2, whose segment is the first. */
function signBoot2(elf) {
  const bytes = fs.readFileSync(elf);
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  const boot2 = view.getUint32(view.getUint32(28, true) + 4, true);
  view.setUint32(boot2 + 252, crc32Mpeg2(bytes.subarray(boot2, boot2 + 252)), true);
  fs.writeFileSync(elf, bytes);
}
