// SPDX-License-Identifier: Apache-2.0
// How far an axis reaches: round numbers that do not change with every swing.
const kRound = [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10];

/// The least round number that is not below `value` > 0.
export function roundUp(value) {
  const decade = 10 ** Math.floor(Math.log10(value));
  return decade * kRound.find((step) => step * decade >= value * (1 - 1e-9));
}

/// A step of 1, 2 or 5 times a power of ten, at least two of which fit into `reach`.
export function roundStep(reach) {
  const decade = 10 ** Math.floor(Math.log10(reach / 2));
  return decade * [5, 2, 1].find((step) => step * decade <= reach / 2 * (1 + 1e-9));
}

/// Grows at once, shrinks only to below 60 %; leaves `headroom` (1.08: 8 %) above the values.
export class SteadyReach {
  constructor(least, headroom = 1.08) {
    this.least = least;
    this.headroom = headroom;
    this.reach = least;
  }

  /// The reach for values up to `greatest` (NaN: as it was).
  fit(greatest) {
    if (Number.isNaN(greatest)) {
      return this.reach;
    }
    const wanted = roundUp(Math.max(this.least, this.headroom * greatest));
    if (wanted > this.reach || wanted < 0.6 * this.reach) {
      this.reach = wanted;
    }
    return this.reach;
  }
}
