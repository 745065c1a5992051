// SPDX-License-Identifier: Apache-2.0
// Numbers as people read them: fixed decimals, a real minus sign, a width that does not jitter.
const kMinus = '\u2212';
const kFigureSpace = '\u2007';

/// `value` with `decimals`, at least `width` figures wide; a dash where there is no answer (null or NaN).
export function fixed(value, decimals, width = 0) {
  if (!Number.isFinite(value)) {
    return '–'.padStart(width, kFigureSpace);
  }
  const digits = Math.abs(value).toFixed(decimals);
  const negative = value < 0 && Number(digits) !== 0;
  return ((negative ? kMinus : '') + digits).padStart(width, kFigureSpace);
}

/// `value` with as many decimals as it has, `decimals` at most: "20", "12.5".
export function shortest(value, decimals) {
  return fixed(value, (String(Number(value.toFixed(decimals))).split('.')[1] ?? '').length);
}

/// Texts of an axis's ticks, all with the same decimals: "0.0", "0.5", "1.0".
export function ticks(values) {
  const shortest = values.map((value) => String(Number(value.toPrecision(6))));
  const decimals = Math.max(0, ...shortest.map((text) => (text.split('.')[1] ?? '').length));
  return values.map((value) => fixed(value, decimals));
}

/// Seconds as "1:05", "1:02:05", with `decimals` of the seconds.
export function clock(t_s, decimals = 0) {
  if (!Number.isFinite(t_s)) {
    return '–';
  }
  const rounded = Number(Math.abs(t_s).toFixed(decimals));
  const hours = Math.floor(rounded / 3600);
  const minutes = Math.floor(rounded / 60) % 60;
  const seconds = (rounded % 60).toFixed(decimals).padStart(decimals ? decimals + 3 : 2, '0');
  const text = hours ? `${hours}:${String(minutes).padStart(2, '0')}:${seconds}` : `${minutes}:${seconds}`;
  return (t_s < 0 && rounded !== 0 ? kMinus : '') + text;
}

/// "1 sample", "12\u202f345 samples", "no samples".
export function count(number, one, many = `${one}s`) {
  if (number === 0) {
    return `no ${many}`;
  }
  return `${String(number).replace(/\B(?=(\d{3})+$)/g, '\u202f')} ${number === 1 ? one : many}`;
}

/// The program's plain text as it is printed: "9.81 +- 0.02 m/s2" with its signs and powers.
export function typeset(text) {
  return text.replaceAll('+-', '±').replace(/\^2|(?<=m\/s)2/g, '²').replace(/(?<![\w)])-(?=\d)/g, kMinus);
}

/// Writes `text` into `element` only where it changed, so that nothing is laid out anew for nothing.
export function write(element, text) {
  if (element.textContent !== text) {
    element.textContent = text;
  }
}
