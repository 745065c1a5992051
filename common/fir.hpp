// SPDX-License-Identifier: Apache-2.0
// Low-pass FIR filters: design by the window method, and the streaming filter.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace penduline {

/// The most taps that a filter may have.
inline constexpr std::size_t kMaxTaps = 64;

/// The numbers that a low-pass filter is designed from.
template <class Scalar>
struct FilterDesign {
  std::size_t order = 0;         ///< taps less one, 0..kMaxTaps - 1; 0 passes the signal unchanged
  Scalar cutoff_of_nyquist = 1;  ///< half-amplitude frequency, in (0, 1]
};

template <class Scalar>
struct FirTaps {
  std::array<Scalar, kMaxTaps> values{};
  std::size_t count = 0;
};

/// Designs a linear-phase low-pass filter as MATLAB's `fir1(order, cutoff)` and SciPy's
/// `firwin(order + 1, cutoff)` do: a windowed sinc (Hamming), unity gain at DC (method.md eq. 20).
/// Its delay is `order / 2` samples.
template <class Scalar>
[[nodiscard]] FirTaps<Scalar> design_lowpass(const FilterDesign<Scalar>& design) {
  FirTaps<Scalar> taps;
  taps.count = design.order + 1;
  if (design.order == 0) {
    taps.values[0] = 1;
    return taps;
  }
  constexpr Scalar kPi = std::numbers::pi_v<Scalar>;
  const Scalar span = static_cast<Scalar>(design.order);
  Scalar sum = 0;
  for (std::size_t i = 0; i < taps.count; ++i) {
    const Scalar from_middle = static_cast<Scalar>(i) - span / 2;
    const Scalar phase = kPi * design.cutoff_of_nyquist * from_middle;
    const Scalar sinc = from_middle == 0 ? Scalar(1) : std::sin(phase) / phase;
    const Scalar hamming =
        Scalar(0.54) - Scalar(0.46) * std::cos(2 * kPi * static_cast<Scalar>(i) / span);
    taps.values[i] = sinc * hamming;
    sum += taps.values[i];
  }
  for (std::size_t i = 0; i < taps.count; ++i) {
    taps.values[i] /= sum;
  }
  return taps;
}

/// Amplitude gain of a filter at a frequency given as a fraction of Nyquist.
template <class Scalar>
[[nodiscard]] Scalar gain_at(const FirTaps<Scalar>& taps, Scalar frequency_of_nyquist) {
  Scalar in_phase = 0;
  Scalar quadrature = 0;
  for (std::size_t i = 0; i < taps.count; ++i) {
    const Scalar phase = std::numbers::pi_v<Scalar> * frequency_of_nyquist * static_cast<Scalar>(i);
    in_phase += taps.values[i] * std::cos(phase);
    quadrature += taps.values[i] * std::sin(phase);
  }
  return std::hypot(in_phase, quadrature);
}

/// A streaming FIR filter over one signal. Starts as if the signal had been zero for ever, as
/// MATLAB's `filter` does; `full()` says when that start is forgotten.
template <class Scalar>
class FirFilter {
 public:
  FirFilter() : FirFilter(design_lowpass(FilterDesign<Scalar>{})) {}
  explicit FirFilter(const FirTaps<Scalar>& taps) { use(taps); }

  /// Begins anew with other taps.
  void use(const FirTaps<Scalar>& taps) {
    count_ = taps.count;
    taps_.fill(0);
    // The history runs from old to new, the taps of a linear-phase filter read the same both ways.
    for (std::size_t i = 0; i < count_; ++i) {
      taps_[i] = taps.values[count_ - 1 - i];
    }
    clear();
  }

  /// Takes the next value and returns the filtered one.
  Scalar push(Scalar value) {
    history_[next_] = value;
    history_[next_ + count_] = value;
    next_ = next_ + 1 == count_ ? 0 : next_ + 1;
    seen_ += seen_ < count_ ? 1 : 0;
    // Four sums that do not wait for each other; the padding taps are zero.
    const Scalar* oldest = &history_[next_];
    std::array<Scalar, 4> sums{};
    for (std::size_t i = 0; i < count_; i += 4) {
      for (std::size_t lane = 0; lane < 4; ++lane) {
        sums[lane] += taps_[i + lane] * oldest[i + lane];
      }
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }

  /// Whether as many values went in as the filter has taps.
  [[nodiscard]] bool full() const { return seen_ == count_; }

  /// Forgets all values.
  void clear() {
    history_.fill(0);
    next_ = 0;
    seen_ = 0;
  }

 private:
  std::array<Scalar, kMaxTaps> taps_{};
  // Every value stands twice, `count_` apart, so that the last `count_` are always in one run; the
  // padding taps may read up to three places past it.
  std::array<Scalar, 2 * kMaxTaps + 3> history_{};
  std::size_t count_ = 0;
  std::size_t next_ = 0;
  std::size_t seen_ = 0;
};

/// The filter of `gn` where the rig names none: a cutoff of five times the pendulum's own
/// frequency, and the highest order up to 15 that passes that frequency within 1 %. A rate too low
/// for such a cutoff gets no filter.
template <class Scalar>
[[nodiscard]] FilterDesign<Scalar> default_filter(Scalar rate_hz, Scalar pendulum_hz) {
  constexpr Scalar kLeastGain = Scalar(0.99);
  const Scalar pendulum_of_nyquist = pendulum_hz / (rate_hz / 2);
  FilterDesign<Scalar> design{.order = 15, .cutoff_of_nyquist = 5 * pendulum_of_nyquist};
  if (design.cutoff_of_nyquist > Scalar(0.8)) {
    return {.order = 0, .cutoff_of_nyquist = 1};
  }
  while (design.order > 0 && gain_at(design_lowpass(design), pendulum_of_nyquist) < kLeastGain) {
    --design.order;
  }
  return design;
}

}  // namespace penduline
