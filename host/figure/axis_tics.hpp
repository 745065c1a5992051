// SPDX-License-Identifier: Apache-2.0
// Tics whose numbers do not run into each other.
#pragma once

#include <optional>

#include "host/figure/figure.hpp"

namespace penduline {

/// How wide gnuplot takes a letter to be, and a digit is, in the terminal whose letters are
/// largest.
inline constexpr double kLetterPx = 9;

/// How gnuplot prints the x axis' numbers: every digit of a time, where its own format has six.
inline constexpr char kXFormat[] = "%.12g";

/// The step between tics of an x axis `width_px` long, where those that gnuplot would choose are
/// too close for their numbers; none where they are not, or the curves have no width.
[[nodiscard]] std::optional<double> x_step(const Panel& panel, double width_px);

/// 1, 2 or 5 times a power of ten, no more than `value`, which is positive.
[[nodiscard]] double round_step(double value);

}  // namespace penduline
