// SPDX-License-Identifier: Apache-2.0
// Each picture in one sentence, for those who do not see it and those who want the number.
import { clock, fixed } from './words.js';

export function anglesWords(series, [from, to]) {
  const { t } = series.columns;
  const parts = ['theta1', 'theta2'].map((column, i) => {
    const [least, greatest] = series.extremes(column, from, to);
    const name = i === 0 ? 'θ₁' : 'θ₂';
    return Number.isNaN(least) ? `${name} has no answer`
      : `${name} went from ${fixed(least, 2)}° to ${fixed(greatest, 2)}°`;
  });
  return to > from ? `From ${clock(t[from])} to ${clock(t[to - 1])} ${parts.join(', ')}.` : 'No angles yet.';
}

/// `ellipse` as `state` has it; `span`: the swing's [from, to] where it is not the latest.
export function aboveWords(ellipse, span = null) {
  if (!ellipse) {
    return 'No ellipse is fitted.';
  }
  const { a_m, b_m, orientation_rad, sense } = ellipse;
  const way = sense ? `, ${sense === 'left' ? 'anticlockwise' : 'clockwise'}` : '';
  const which = span ? ` of the swing from ${clock(span[0], 1)} to ${clock(span[1], 1)}:` : ' of';
  return `Ellipse${which} ${fixed(2000 * a_m, 1)} mm by ${fixed(2000 * b_m, 1)} mm, ` +
    `its long axis ${fixed((180 * orientation_rad) / Math.PI, 1)}° from x${way}.`;
}

export function gapsWords(series, row, sensors) {
  return sensors.map((sensor, i) => {
    const value = valueAt(series, `gap${i}`, row);
    const gap = Number.isFinite(value) ? `${fixed(value, 2)} mm` : 'has no answer';
    return `${sensor.name} ${gap}${validWords(sensor.gap_range_m)}`;
  }).join('; ') + '.';
}

export function signalsWords(series, row, sensors) {
  return sensors.map((sensor, i) => {
    const value = valueAt(series, `signal${i}`, row);
    return `${sensor.name} ${Number.isFinite(value) ? `${fixed(value, 3)} V` : 'has no answer'}`;
  }).join('; ') + '.';
}

/// `direction`: of the camera, degrees from x and above the ground.
export function spaceWords(series, row, [from_x, above]) {
  const [x, y, z] = ['x', 'y', 'z'].map((column) => valueAt(series, column, row));
  const place = Number.isFinite(x)
    ? `The mass is at x ${fixed(x, 1)}, y ${fixed(y, 1)}, z ${fixed(z, 1)} mm from the pivot`
    : 'Where the mass is, is not known now';
  return `${place}; seen from ${fixed(from_x, 0)}° about z, ${fixed(above, 0)}° above.`;
}

function valueAt(series, column, row) {
  return row >= 0 ? series.columns[column][row] : NaN;
}

/// `range_m`: [least, greatest], null where there is no end.
function validWords(range_m) {
  const [least, greatest] = (range_m ?? [null, null]).map((end_m) => (end_m === null ? NaN : 1000 * end_m));
  return (Number.isFinite(least) ? `, valid from ${fixed(least, 1)}` : '') +
    (Number.isFinite(greatest) ? ` to ${fixed(greatest, 1)} mm` : Number.isFinite(least) ? ' mm' : '');
}
