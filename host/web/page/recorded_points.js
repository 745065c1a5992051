// SPDX-License-Identifier: Apache-2.0
// A recording's columns out of base64 of little-endian numbers.
const kFlags = 'flags';

/// `points` with every base64 text as a typed array: `t_s` of float64, `flags` of uint32, the others of float32.
export function decodedPoints(points) {
  const decoded = {};
  for (const [name, column] of Object.entries(points)) {
    const type = name === 't_s' ? Float64Array : name === kFlags ? Uint32Array : Float32Array;
    decoded[name] = Array.isArray(column) ? column.map((text) => numbers(text, type)) : numbers(column, type);
  }
  return decoded;
}

function numbers(base64, Type) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) {
    bytes[i] = text.charCodeAt(i);
  }
  // Every machine that browsers run on today is little-endian, as are the bytes.
  return new Type(bytes.buffer);
}
