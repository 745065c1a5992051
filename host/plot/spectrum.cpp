// SPDX-License-Identifier: Apache-2.0
// Window, transform, and what makes amplitudes of it.
#include "host/plot/spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <unsupported/Eigen/FFT>

namespace penduline {
namespace {

/// How many values are transformed: a power of two, most of them zeros.
std::size_t padded_size(std::size_t count) {
  constexpr std::size_t kFinely = 8;
  constexpr std::size_t kMost = std::size_t{1} << 22U;
  const std::size_t enough = std::bit_ceil(count);
  return std::max(enough, std::min(enough * kFinely, kMost));
}

}  // namespace

std::size_t AmplitudeSpectrum::peak() const {
  const auto first = std::ranges::lower_bound(frequency_hz, lowest_hz) - frequency_hz.begin();
  return static_cast<std::size_t>(std::max_element(amplitude.begin() + first, amplitude.end()) -
                                  amplitude.begin());
}

AmplitudeSpectrum amplitude_spectrum(std::span<const double> values, double step_s) {
  constexpr std::size_t kFewest = 8;
  const std::size_t count = values.size();
  if (count < kFewest) {
    return {};
  }
  const double mean =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(count);
  std::vector<double> windowed(padded_size(count));
  double window_sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double weight = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(i) /
                                               static_cast<double>(count));
    windowed[i] = weight * (values[i] - mean);
    window_sum += weight;
  }
  Eigen::FFT<double> transform;
  transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> spectrum;
  transform.fwd(spectrum, windowed);
  AmplitudeSpectrum result{.frequency_hz = std::vector<double>(spectrum.size()),
                           .amplitude = std::vector<double>(spectrum.size()),
                           .lowest_hz = 2 / (static_cast<double>(count) * step_s)};
  const double spacing_hz = 1 / (static_cast<double>(windowed.size()) * step_s);
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    // A sine's amplitude is shared by a positive and a negative frequency.
    const bool alone = i == 0 || i + 1 == spectrum.size();
    result.frequency_hz[i] = spacing_hz * static_cast<double>(i);
    result.amplitude[i] = std::abs(spectrum[i]) * (alone ? 1 : 2) / window_sum;
  }
  return result;
}

RowSpan longest_span(const std::vector<bool>& joined) {
  RowSpan longest;
  for (std::size_t begin = 0; begin < joined.size();) {
    std::size_t end = begin + 1;
    while (end < joined.size() && joined[end]) {
      ++end;
    }
    if (end - begin > longest.end - longest.begin) {
      longest = {.begin = begin, .end = end};
    }
    begin = end;
  }
  return longest;
}

}  // namespace penduline
