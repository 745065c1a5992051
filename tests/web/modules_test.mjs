// SPDX-License-Identifier: Apache-2.0
// The page's modules without a browser: memory that does not grow, no peak lost, numbers as people read them.

import assert from 'node:assert';
import { test } from 'node:test';
import { rowsToDraw } from '../../host/web/page/decimate.js';
import { roundStep, roundUp, SteadyReach } from '../../host/web/page/reach.js';
import { liveStep_s, Series } from '../../host/web/page/series.js';
import { sentences } from '../../host/web/page/session_words.js';
import { clock, count, fixed, ticks, typeset } from '../../host/web/page/words.js';

/** A `points` event of the moments `t_s`; theta1 is `value(t)` rad, all else 0. */
function points(t_s, value = () => 0) {
  const zeros = t_s.map(() => 0);
  return {
    t_s, theta1_rad: t_s.map(value), theta2_rad: zeros, sigma1_rad: zeros, sigma2_rad: zeros, x_m: zeros, y_m: zeros,
    z_m: zeros, signal_v: [zeros, zeros], gap_m: [zeros, zeros], flags: zeros,
  };
}

const grid = (from, to, step) => Array.from({ length: Math.round((to - from) / step) }, (_, i) => from + i * step);

test('a series keeps the latest rows in memory that does not grow', () => {
  const series = new Series(1000, 2, 0.1);
  const bytes = series.columns.theta1.byteLength;
  for (let begin = 0; begin < 500; begin += 5) {
    series.append(points(grid(begin, begin + 5, 0.01), (t) => t));
  }
  assert.equal(series.columns.theta1.byteLength, bytes);
  assert.ok(series.end - series.begin >= 1000 && series.end - series.begin <= 2000);
  assert.ok(Math.abs(series.latest_s - 499.99) < 1e-9);
  const row = series.rowAt(495);
  assert.ok(Math.abs(series.columns.t[row] - 495) < 1e-9);
  assert.ok(Math.abs(series.columns.theta1[row] - (495 * 180) / Math.PI) < 1e-6);
});

test('no answer is no number, never 0', () => {
  const series = new Series(10, 2, 1);
  series.append(points([0, 0.05, 0.1], (t) => (t === 0.05 ? null : 0.1)));
  assert.ok(Number.isNaN(series.columns.theta1[1]));
  assert.deepEqual(series.extremes('theta1', 0, 3).map((value) => value.toFixed(3)), ['5.730', '5.730']);
  assert.deepEqual(series.extremes('theta1', 1, 2), [NaN, NaN]);
});

test('lost samples leave a gap, and rows that came before are not taken twice', () => {
  const series = new Series(100, 2, 0.15);
  series.append(points([0, 0.05, 0.1]));
  series.append(points([0.05, 0.1, 0.5, 0.55]));
  assert.deepEqual([...series.columns.t.subarray(series.begin, series.end)], [0, 0.05, 0.1, 0.3, 0.5, 0.55]);
  assert.ok(Number.isNaN(series.columns.theta1[3]));
});

test('a dropout is more than three periods, above 100 Hz more than three bins of 20 ms', () => {
  assert.deepEqual([20, 60, 100, 101, 1000, null].map(liveStep_s),
    [3.5 / 20, 3.5 / 60, 3.5 / 100, 3.5 / 50, 3.5 / 50, 3.5 / 20]);
});

test('thinned out for the eye, a spike of one row of 100 000 is still there', () => {
  const t = Float64Array.from(grid(0, 100, 0.001));
  const values = t.map((moment) => Math.sin(moment));
  values[54321] = 7;
  values[12345] = -7;
  const rows = rowsToDraw(t, [values], 0, t.length, 800);
  assert.ok(rows.length <= 5 * 800, `${rows.length} rows`);
  assert.ok(rows.includes(54321) && rows.includes(12345));
  assert.equal(rows[0], 0);
  assert.equal(rows.at(-1), t.length - 1);
  assert.ok(rows.every((row, i) => i === 0 || row > rows[i - 1]));
});

test('thinned out for the eye, one row without an answer is still there', () => {
  const t = Float64Array.from(grid(0, 100, 0.001));
  const values = t.map(() => 1);
  values[70001] = NaN;
  assert.ok(rowsToDraw(t, [values], 0, t.length, 500).includes(70001));
});

test('few rows are all drawn', () => {
  const t = Float64Array.from(grid(0, 30, 0.05));
  assert.equal(rowsToDraw(t, [t], 10, 600, 800).length, 590);
});

test('axes end at round numbers and do not follow every swing', () => {
  assert.deepEqual([0.011, 4.2, 5, 97].map(roundUp), [0.015, 5, 5, 100]);
  assert.deepEqual([1, 5, 8, 30].map(roundStep), [0.5, 2, 2, 10]);
  const steady = new SteadyReach(0.1);
  assert.deepEqual([4.4, 4.9, 4.1, 3.3, 2.2, NaN, 0].map((value) => steady.fit(value)), [5, 6, 6, 6, 2.5, 2.5, 0.1]);
});

test('numbers have a real minus sign, fixed decimals and one width', () => {
  assert.equal(fixed(-1.234, 2), '\u22121.23');
  assert.equal(fixed(1.5, 2, 6), '\u2007\u20071.50');
  assert.equal(fixed(-0.001, 2), '0.00');
  assert.equal(fixed(null, 2), '–');
  assert.equal(fixed(NaN, 2, 3), '\u2007\u2007–');
  assert.deepEqual(ticks([-0.5, 0, 0.5, 1]), ['\u22120.5', '0.0', '0.5', '1.0']);
});

test('times and counts read as people say them', () => {
  assert.deepEqual([0, 65, 3725].map((t) => clock(t)), ['0:00', '1:05', '1:02:05']);
  assert.deepEqual([clock(59.97, 1), clock(-3, 0), clock(-0.2), clock(NaN)], ['1:00.0', '\u22120:03', '0:00', '–']);
  assert.deepEqual([0, 1, 1234567].map((number) => count(number, 'sample')),
    ['no samples', '1 sample', '1\u202f234\u202f567 samples']);
});

test('what the program prints in plain text gets its signs and powers', () => {
  assert.equal(typeset('9.8127 +- 0.0021 m/s2, length -3'), '9.8127 ± 0.0021 m/s², length \u22123');
  assert.equal(typeset('T (1 + a^2/16), 2026-11-22'), 'T (1 + a²/16), 2026-11-22');
});

/** What the page says under `term` of a session at `rate_hz` with these `sensors`. */
function said(term, rate_hz, sensors) {
  const session = {
    board: 'sim', rate_hz, reference_v: 3.3, estimator: 'gn',
    rig: { name: 'rig', length_m: 0.3, sensors: [{ name: 'x' }, { name: 'y' }] },
  };
  const state = { connected: true, samples: 5, lost: 0, dropouts: 0, restarts: 0, rate_hz: 12.5, sensors };
  return new Map(sentences(session, state)).get(term);
}

test('a rate that is not whole is said with its decimals', () => {
  assert.equal(said('Rate', 12.5, []), '12.50 Hz of 12.5 Hz asked for.');
  assert.equal(said('Rate', 20, []), '12.50 Hz of 20 Hz asked for.');
  assert.equal(said('Rate', 33.3333, []), '12.50 Hz of 33.333 Hz asked for.');
});

test('a sensor without a reading is said not to be read', () => {
  const read = { ambient_v: null, signal_v: 1.5, saturated: false, out_of_range: false };
  assert.equal(said('Signals', 20, [read, read]), 'None is saturated or out of its range; full scale is 3.30 V.');
  assert.equal(said('Signals', 20, [read, { ...read, signal_v: null }]), 'y is not read; full scale is 3.30 V.');
});
