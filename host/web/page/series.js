// SPDX-License-Identifier: Apache-2.0
// The latest rows in degrees, millimetres and volts, by columns, in memory that does not grow.
const kDegrees = 180 / Math.PI;
const kMillimetres = 1000;
const kScales = {
  theta1_rad: ['theta1', kDegrees], theta2_rad: ['theta2', kDegrees],
  sigma1_rad: ['sigma1', kDegrees], sigma2_rad: ['sigma2', kDegrees],
  x_m: ['x', kMillimetres], y_m: ['y', kMillimetres], z_m: ['z', kMillimetres],
};

/// How far apart the rows of a live stream at `rate_hz` (null: not known) are without a dropout between them: above
/// 100 Hz they come in bins of 20 ms, and dropouts as rows without answers (docs/web_protocol.md).
export function liveStep_s(rate_hz) {
  return 3.5 / (rate_hz > 100 ? 50 : rate_hz || 20);
}

/// Rows `begin` to `end` of each column hold the latest `capacity` rows or more, oldest first; NaN is no answer.
/// Where rows are further apart than `largestStep_s`, a row without answers stands between them.
export class Series {
  constructor(capacity, sensorCount, largestStep_s) {
    this.capacity = capacity;
    this.largestStep_s = largestStep_s;
    this.columns = { t: new Float64Array(2 * capacity) };
    this.sources = [];
    for (const [name, [column, scale]] of Object.entries(kScales)) {
      this.add(column, scale, (points) => points[name]);
    }
    for (let i = 0; i < sensorCount; ++i) {
      this.add(`gap${i}`, kMillimetres, (points) => points.gap_m[i]);
      this.add(`signal${i}`, 1, (points) => points.signal_v[i]);
    }
    this.clear();
  }

  add(column, scale, find) {
    this.columns[column] = new Float64Array(2 * this.capacity);
    this.sources.push({ to: this.columns[column], scale, find });
  }

  clear() {
    this.begin = 0;
    this.end = 0;
  }

  get latest_s() {
    return this.end > this.begin ? this.columns.t[this.end - 1] : NaN;
  }

  /// Appends the columns of a `points` event; rows that are not newer than the latest are left out.
  append(points) {
    const found = this.sources.map((source) => source.find(points));
    for (let row = 0; row < points.t_s.length; ++row) {
      const t_s = points.t_s[row];
      const latest_s = this.latest_s;
      if (!(t_s > latest_s) && this.end > this.begin) {
        continue;
      }
      if (t_s - latest_s > this.largestStep_s) {
        this.put((t_s + latest_s) / 2, () => null);
      }
      this.put(t_s, (i) => found[i]?.[row]);
    }
  }

  put(t_s, value) {
    if (this.end === 2 * this.capacity) {
      for (const column of Object.values(this.columns)) {
        column.copyWithin(0, this.capacity, this.end);
      }
      this.begin = 0;
      this.end = this.capacity;
    }
    this.columns.t[this.end] = t_s;
    this.sources.forEach(({ to, scale }, i) => {
      const found = value(i);
      to[this.end] = found === null || found === undefined ? NaN : found * scale;
    });
    ++this.end;
  }

  /// The first row at or after `t_s`.
  rowAt(t_s) {
    let low = this.begin;
    let high = this.end;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.columns.t[middle] < t_s) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low;
  }

  /// Least and greatest answer of `column` in rows [from, to); both NaN without one.
  extremes(column, from, to) {
    const values = this.columns[column];
    let least = NaN;
    let greatest = NaN;
    for (let row = from; row < to; ++row) {
      if (Number.isNaN(values[row])) {
        continue;
      }
      least = values[row] >= least ? least : values[row];
      greatest = values[row] <= greatest ? greatest : values[row];
    }
    return [least, greatest];
  }
}
