// SPDX-License-Identifier: Apache-2.0
// Plants one mistake at a time in the firmware's source: the tests of the image must catch each.

import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { root } from './board.mjs';

const kMutants = [
  { mistake: 'the tick that timer and watchdog count is not started', file: 'hal/rp2040/clocks.cpp',
    from: 'reg(watchdog::kTick) = kCrystalMhz | (1U << 9U);', to: '', caughtBy: 'boot_test' },
  { mistake: 'USB packets do not alternate between DATA0 and DATA1', file: 'hal/rp2040/usb_serial.cpp',
    from: 'in_data1_ = !in_data1_;', to: '', caughtBy: 'boot_test' },
  { mistake: 'the second half of a window begins with the same channel', file: 'hal/window.hpp',
    from: '{true, 1}, {false, 1}', to: '{true, 0}, {false, 0}', caughtBy: 'sampling_test' },
  { mistake: 'windows that are lost have no numbers', file: 'firmware/application.hpp',
    from: 'next_seq_ += window.lost_before;', to: '', caughtBy: 'sampling_test' },
  { mistake: 'the newest frame gives way, not the oldest', file: 'firmware/frame_ring.hpp',
    from: 'drop_oldest();\n      ++dropped_;', to: '++dropped_;\n      return;', caughtBy: 'link_test' },
  { mistake: 'the watchdog is fed whatever happens', file: 'firmware/application.hpp',
    from: 'if (makes_progress()) {', to: 'if (makes_progress() || true) {', caughtBy: 'reset_test' },
  { mistake: 'the stored rig\'s CRC is not checked', file: 'firmware/rig_store.hpp',
    from: 'wire::crc32(contents.subspan(kHeadBytes, size)) != crc', to: 'crc == 0', caughtBy: 'rig_test' },
];

const copy = fs.mkdtempSync(path.join(os.tmpdir(), 'penduline-mutants-'));
process.on('exit', () => fs.rmSync(copy, { recursive: true }));
for (const part of ['CMakeLists.txt', 'CMakePresets.json', 'cmake', 'common', 'hal', 'firmware', 'scripts']) {
  fs.cpSync(path.join(root, part), path.join(copy, part), { recursive: true });
}
const cmake = (...options) => execFileSync('cmake', options, { cwd: copy, stdio: 'pipe' });
cmake('--preset', 'pico');

for (const { mistake, file, from, to, caughtBy } of kMutants) {
  test(`${mistake}: ${caughtBy} catches it`, () => {
    const source = path.join(copy, file);
    const good = fs.readFileSync(source, 'utf8');
    assert.equal(good.split(from).length, 2, `${file}: found not once: ${from}`);
    fs.writeFileSync(source, good.replace(from, to));
    try {
      cmake('--build', '--preset', 'pico');
      const { NODE_TEST_CONTEXT, ...environment } = process.env; // or the inner run would report to the outer
      const { status } = spawnSync(process.execPath, ['--test', path.join(root, `tests/firmware/pico/${caughtBy}.mjs`)],
        { env: { ...environment, PICO_BUILD: path.join(copy, 'build/pico') } });
      assert.notEqual(status, 0, 'nobody noticed');
    } finally {
      fs.writeFileSync(source, good);
    }
  });
}
