// SPDX-License-Identifier: Apache-2.0
// The large numbers: the angles with their uncertainty, period and amplitude.
import { fixed, write } from './words.js';

const kDegrees = 180 / Math.PI;

/// The angles at `row` of `series` (-1: none).
export function showAngles(series, row) {
  for (const i of [1, 2]) {
    const angle = row >= 0 ? series.columns[`theta${i}`][row] : NaN;
    const sigma = row >= 0 ? series.columns[`sigma${i}`][row] : NaN;
    writeSteadily(document.getElementById(`theta${i}`), Number.isNaN(angle) ? '–' : `${fixed(angle, 2)}°`);
    write(document.getElementById(`sigma${i}`), Number.isNaN(sigma) ? '' : `± ${fixed(sigma, 3)}°`);
  }
}

/// Period and amplitude of `state`, null without an answer.
export function showSwing({ period_s, amplitude_rad }) {
  write(document.getElementById('period'), period_s === null ? '–' : `${fixed(period_s, 3)} s`);
  const amplitude = amplitude_rad === null ? '–' : `${fixed(amplitude_rad * kDegrees, 2)}°`;
  write(document.getElementById('amplitude'), amplitude);
}

/// Writes a text that ends where it ended before: the element stays as wide as its widest text so far.
function writeSteadily(element, text) {
  write(element, text);
  const width_em = element.getBoundingClientRect().width / Number.parseFloat(getComputedStyle(element).fontSize);
  if (width_em > Number.parseFloat(element.style.minWidth || '0') + 1e-3) {
    element.style.minWidth = `${width_em.toFixed(3)}em`;
  }
}
