// SPDX-License-Identifier: Apache-2.0
// Fewer rows for the eye: of each pixel's rows those that the picture needs, so that no peak is lost.

/// Which of the rows [from, to) to draw over `pixels`: all while they are few, else of each stretch of equal time the
/// first, the last, those with the least and the greatest value of each of `columns`, and the first without an answer.
export function rowsToDraw(t_s, columns, from, to, pixels) {
  const rows = [];
  if (to - from <= 4 * pixels) {
    for (let row = from; row < to; ++row) {
      rows.push(row);
    }
    return rows;
  }
  const width_s = (t_s[to - 1] - t_s[from]) / pixels;
  let begin = from;
  for (let pixel = 1; begin < to; ++pixel) {
    const until_s = t_s[from] + pixel * width_s;
    let end = begin;
    while (end < to && (t_s[end] <= until_s || pixel >= pixels)) {
      ++end;
    }
    if (end > begin) {
      keep(rows, columns, begin, end);
    }
    begin = end;
  }
  return rows;
}

function keep(rows, columns, begin, end) {
  const kept = [begin, end - 1];
  for (const values of columns) {
    let least = -1;
    let greatest = -1;
    let absent = -1;
    for (let row = begin; row < end; ++row) {
      if (Number.isNaN(values[row])) {
        absent = absent < 0 ? row : absent;
        continue;
      }
      least = least < 0 || values[row] < values[least] ? row : least;
      greatest = greatest < 0 || values[row] > values[greatest] ? row : greatest;
    }
    kept.push(least, greatest, absent);
  }
  kept.sort((a, b) => a - b);
  for (const row of kept) {
    if (row >= 0 && row !== rows[rows.length - 1]) {
      rows.push(row);
    }
  }
}
