// SPDX-License-Identifier: Apache-2.0
// The amplitude spectrum of evenly sampled values.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace penduline {

/// Amplitudes at evenly spaced frequencies, from 0 to half the sample rate.
struct AmplitudeSpectrum {
  std::vector<double> frequency_hz;
  /// In the values' unit: a sine a sin(2 pi f t) has a at f.
  std::vector<double> amplitude;
  /// Below it the spectrum says nothing: two periods in the span, the window's resolution.
  double lowest_hz = 0;

  /// Which amplitude is the largest from `lowest_hz` on.
  [[nodiscard]] std::size_t peak() const;
};

/// Of values sampled every `step_s`: their mean taken off, a Hann window, divided by the window's
/// mean, zeros behind so that a peak falls between two frequencies by no more than a sixteenth of
/// 1/span, which costs a quarter of a per cent (spans over 2^19 values: less finely). Empty below 8
/// values.
[[nodiscard]] AmplitudeSpectrum amplitude_spectrum(std::span<const double> values, double step_s);

/// Rows in succession, from `begin` to before `end`.
struct RowSpan {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The longest run of rows of which each is joined to the one before.
[[nodiscard]] RowSpan longest_span(const std::vector<bool>& joined);

}  // namespace penduline
