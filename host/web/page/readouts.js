// SPDX-License-Identifier: Apache-2.0
// The large numbers: the angles with their uncertainty, period and amplitude.
import { fixed, write } from './words.js';

const kDegrees = 180 / Math.PI;

let widest = 5;

/// The angles at `row` of `series` (-1: none).
export function showAngles(series, row) {
  for (const i of [1, 2]) {
    const angle = row >= 0 ? series.columns[`theta${i}`][row] : NaN;
    const sigma = row >= 0 ? series.columns[`sigma${i}`][row] : NaN;
    // As wide as the widest so far, so that the sign does not move the digits.
    const text = fixed(angle, 2, widest);
    widest = Math.max(widest, text.length);
    write(document.getElementById(`theta${i}`), Number.isNaN(angle) ? text : `${text}°`);
    write(document.getElementById(`sigma${i}`), Number.isNaN(sigma) ? '' : `± ${fixed(sigma, 3)}°`);
  }
}

/// Period and amplitude of `state`, null without an answer.
export function showSwing({ period_s, amplitude_rad }) {
  write(document.getElementById('period'), period_s === null ? '–' : `${fixed(period_s, 3)} s`);
  write(document.getElementById('amplitude'), amplitude_rad === null ? '–' : `${fixed(amplitude_rad * kDegrees, 2)}°`);
}
