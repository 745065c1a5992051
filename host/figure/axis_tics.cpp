// SPDX-License-Identifier: Apache-2.0
// The step of an axis by how long its numbers are.
#include "host/figure/axis_tics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace penduline {
namespace {

/// Whether the numbers at every multiple of `step` find room beside each other.
bool have_room(double least, double most, double step, double width_px) {
  constexpr std::size_t kBetween = 2;
  std::size_t letters = 0;
  const double first = std::ceil(least / step);
  const int more = static_cast<int>(std::floor(most / step) - first);
  for (int i = 0; i <= more; ++i) {
    letters = std::max(letters, fmt::formatted_size("{:.12g}", (first + i) * step) + kBetween);
  }
  return static_cast<double>(letters) * kLetterPx <= width_px * step / (most - least);
}

}  // namespace

double round_step(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  const double digit = value / power;
  return power * (digit < 2 ? 1 : digit < 5 ? 2 : 5);
}

std::optional<double> x_step(const Panel& panel, double width_px) {
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  for (const Curve& curve : panel.curves) {
    for (const double x : curve.x) {
      if (std::isfinite(x)) {
        least = std::min(least, x);
        most = std::max(most, x);
      }
    }
  }
  if (!(least < most)) {
    return std::nullopt;
  }
  constexpr double kGnuplotsSteps = 10;
  const double finest = (most - least) / kGnuplotsSteps;
  double step = round_step(finest);
  if (step < finest) {
    step = round_step(2.5 * step);
  }
  if (have_room(least, most, step, width_px)) {
    return std::nullopt;
  }
  while (step < most - least && !have_room(least, most, step, width_px)) {
    step = round_step(2.5 * step);
  }
  return step;
}

}  // namespace penduline
