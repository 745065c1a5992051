// SPDX-License-Identifier: Apache-2.0
// Numbers with a fixed count of decimals, many millions a second.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>

namespace penduline {

/// Appends `value` rounded to `decimals` (0..9) places, without a sign where it rounds to zero.
inline void append_fixed(std::string& text, double value, std::size_t decimals) {
  constexpr std::array kScales = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
  constexpr double kLargest = 9e18;
  const double scaled = value * kScales[decimals];
  if (!(std::abs(scaled) < kLargest)) {
    fmt::format_to(std::back_inserter(text), "{:.{}f}", value, decimals);
    return;
  }
  const std::int64_t rounded = std::llround(scaled);
  if (rounded < 0) {
    text += '-';
  }
  const fmt::format_int digits(rounded < 0 ? -rounded : rounded);
  if (digits.size() > decimals) {
    const std::size_t whole = digits.size() - decimals;
    text.append(digits.data(), whole);
    if (decimals > 0) {
      text += '.';
      text.append(digits.data() + whole, decimals);
    }
    return;
  }
  text += "0.";
  text.append(decimals - digits.size(), '0');
  text.append(digits.data(), digits.size());
}

}  // namespace penduline
