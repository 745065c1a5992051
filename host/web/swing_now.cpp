// SPDX-License-Identifier: Apache-2.0
// The analysis of a swing, on the little that a live page needs.
#include "host/web/swing_now.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/analysis/free_span.hpp"

namespace penduline {
namespace {

/// More rows a second say no more of a swing.
constexpr double kMostHz = 100;

AngleSeries last_angles(const std::deque<LiveRow>& rows, double span_s) {
  AngleSeries series;
  for (const LiveRow& row : rows) {
    const bool wanted = row.t_s >= rows.back().t_s - span_s &&
                        (series.t_s.empty() || row.t_s - series.t_s.back() >= 0.999 / kMostHz);
    if (wanted && !std::isnan(row.theta1_rad) && (row.flags & ~flag::kOrdinary) == 0) {
      series.t_s.push_back(row.t_s);
      series.theta1_rad.push_back(row.theta1_rad);
      series.theta2_rad.push_back(row.theta2_rad);
    }
  }
  return series;
}

/// 0 where none is known.
double largest_sigma_rad(const LiveRow& row) {
  return std::fmax(0, std::fmax(row.sigma1_rad, row.sigma2_rad));
}

/// Where the mass is on its way round, in radians. That of a wide ellipse is counted from X: a
/// circle has no axis to count from.
double way_rad(const SwingEllipse& swing, bool wide) {
  const double turn = swing.semi_minor_rad.value > 0 ? 1 : -1;
  return swing.phase_rad.value + (wide ? turn * swing.orientation_rad.value : 0);
}

}  // namespace

PathEllipse path_of(const SwingEllipse& swing, double length_m) {
  constexpr double kSigmas = 3;
  const double width = swing.semi_minor_rad.value;
  const bool has_width = std::abs(width) > kSigmas * swing.semi_minor_rad.sigma;
  return {.a_m = length_m * std::sin(swing.semi_major_rad.value),
          .b_m = length_m * std::sin(std::abs(width)),
          .x_m = length_m * std::sin(swing.centre.x_rad),
          .y_m = length_m * std::sin(swing.centre.y_rad),
          .orientation_rad = std::remainder(swing.orientation_rad.value, std::numbers::pi),
          .sense = has_width ? (width > 0 ? 1 : -1) : 0};
}

std::optional<SwingNow> swing_now(const std::deque<LiveRow>& rows, const Pendulum<double>& pendulum,
                                  double span_s) {
  constexpr std::size_t kFewestRows = 16;
  constexpr double kLeastOfResidual = 4;
  constexpr double kLeastOfSigma = 3;
  constexpr double kFastestOfSmallSwings = 2;
  constexpr double kWideFromRatio = 0.5;
  if (rows.empty()) {
    return std::nullopt;
  }
  const AngleSeries series = last_angles(rows, span_s);
  if (series.size() < kFewestRows) {
    return std::nullopt;
  }
  const double roughly_s = strongest_period_s(series);
  if (!(roughly_s * kFastestOfSmallSwings * small_swing_hz(pendulum) > 1)) {
    return std::nullopt;
  }
  const std::vector<SwingEllipse> swings = swing_ellipses(
      series, {.period_s = roughly_s, .step_s = roughly_s / 2, .rest = {}, .noise = {}});
  if (swings.size() < 2) {
    return std::nullopt;
  }
  const SwingEllipse& first = swings.front();
  const SwingEllipse& last = swings.back();
  const bool wide =
      std::abs(last.semi_minor_rad.value) > kWideFromRatio * last.semi_major_rad.value;
  const double turned_rad = way_rad(last, wide) - way_rad(first, wide);
  const double least_rad = kLeastOfSigma * largest_sigma_rad(rows.back());
  const auto swings_freely = [&](const SwingEllipse& swing) {
    return swing.semi_major_rad.value > kLeastOfResidual * swing.residual_rad &&
           swing.semi_major_rad.value > least_rad;
  };
  // Noise has a strongest period too, but is no ellipse of it.
  if (!swings_freely(first) || !swings_freely(last) || !(turned_rad > 0)) {
    return std::nullopt;
  }
  return SwingNow{.period_s = 2 * std::numbers::pi * (last.t_s - first.t_s) / turned_rad,
                  .amplitude_rad = last.semi_major_rad.value,
                  .ellipse = path_of(last, pendulum.length_m)};
}

}  // namespace penduline
