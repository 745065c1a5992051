// SPDX-License-Identifier: Apache-2.0
// Rules that silicon enforces by not working and rp2040js does not.

/** @param {import('./rp2040.mjs').Emulator} emulator with a chip that has not yet run */
export function lint(emulator) {
  void emulator;
}
