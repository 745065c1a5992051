// SPDX-License-Identifier: Apache-2.0
// The spectrum's peak, and the longest run of swings that look free.
#include "host/analysis/free_span.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "host/analysis/swing_ellipse.hpp"

namespace penduline {
namespace {

constexpr double kSmallestShare = 0.05;  // of the largest swing

/// Means over equal pieces of time; a piece without a sample keeps the value before.
std::vector<double> resampled(const AngleSeries& series, const std::vector<double>& values,
                              double step_s, std::size_t count) {
  std::vector<double> sums(count);
  std::vector<double> weights(count);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const auto piece = static_cast<std::size_t>((series.t_s[i] - series.t_s.front()) / step_s);
    sums[std::min(piece, count - 1)] += values[i];
    weights[std::min(piece, count - 1)] += 1;
  }
  double last = values.front();
  for (std::size_t i = 0; i < count; ++i) {
    last = weights[i] > 0 ? sums[i] / weights[i] : last;
    sums[i] = last;
  }
  return sums;
}

/// Differences from each value to the next.
std::vector<double> differences(const std::vector<double>& values) {
  std::vector<double> result(values.size() - 1);
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = values[i + 1] - values[i];
  }
  return result;
}

/// Whether `next` can be the swing that follows on `swing` with nobody's help, where the smallest
/// since the beginning had the amplitude `least_rad`.
bool follows_freely(const SwingEllipse& swing, const SwingEllipse& next, double least_rad) {
  constexpr double kGrowth = 0.05;
  const double noise = 3 * std::hypot(swing.semi_major_rad.sigma, next.semi_major_rad.sigma);
  const double shift =
      std::hypot(next.centre.x_rad - swing.centre.x_rad, next.centre.y_rad - swing.centre.y_rad);
  return next.semi_major_rad.value < least_rad * (1 + kGrowth) + noise &&
         shift < 0.2 * swing.semi_major_rad.value + noise;
}

/// Whether a piece is an ellipse but for its noise, and not noise alone.
bool is_ellipse(const SwingEllipse& swing, double noise_rad) {
  constexpr double kMisfit = 0.1;
  constexpr double kSurely = 5;
  return swing.residual_rad < kMisfit * swing.semi_major_rad.value + 2 * noise_rad &&
         swing.semi_major_rad.value > kSurely * swing.semi_major_rad.sigma;
}

double median_residual_rad(const std::vector<SwingEllipse>& ellipses) {
  std::vector<double> residuals(ellipses.size());
  std::ranges::transform(ellipses, residuals.begin(), &SwingEllipse::residual_rad);
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::ranges::nth_element(residuals, middle);
  return residuals.empty() ? 0 : *middle;
}

}  // namespace

double strongest_period_s(const AngleSeries& series) {
  constexpr double kFinestStepS = 0.01;
  constexpr std::size_t kFewestSteps = 16;
  constexpr std::size_t kMostSteps = 10'000'000;  // a day at 100 Hz; a clock that jumped has more
  if (series.size() < kFewestSteps) {
    return 0;
  }
  const double span_s = series.t_s.back() - series.t_s.front();
  const double step_s = std::max(series.period_s(), kFinestStepS);
  const auto count = static_cast<std::size_t>(span_s / step_s) + 1;
  if (count < kFewestSteps || count > kMostSteps) {
    return 0;
  }
  Eigen::FFT<double> transform;
  std::vector<double> power(count);
  for (const auto* values : {&series.theta1_rad, &series.theta2_rad}) {
    std::vector<double> rates = differences(resampled(series, *values, step_s, count));
    rates.resize(2 * count);  // zeros behind: a finer spectrum
    std::vector<std::complex<double>> spectrum;
    transform.fwd(spectrum, rates);
    for (std::size_t i = 0; i < power.size(); ++i) {
      power[i] += std::norm(spectrum[i]);
    }
  }
  const auto peak = std::ranges::max_element(power);
  const auto index = static_cast<double>(peak - power.begin());
  return *peak > 0 && index > 0 ? 2 * static_cast<double>(count) * step_s / index : 0;
}

tl::expected<FreeSpan, Error> find_free_span(const AngleSeries& series) {
  const double period_s = strongest_period_s(series);
  const double span_s = series.size() < 2 ? 0 : series.t_s.back() - series.t_s.front();
  if (!(period_s > 0)) {
    return failure(
        "found no swing: the angles do not change, there are too few of them, or they are spread "
        "over "
        "too long a time");
  }
  if (span_s < kFewestSwings * period_s) {
    return failure(fmt::format("found {:.3g} s of swings of {:.3g} s, expected at least {} swings",
                               span_s, period_s, kFewestSwings));
  }
  const auto ellipses = swing_ellipses(
      series, {.period_s = period_s, .step_s = period_s / 2, .rest = {}, .noise = {}});
  const double noise_rad = median_residual_rad(ellipses);
  double largest_rad = 0;
  for (const SwingEllipse& ellipse : ellipses) {
    if (is_ellipse(ellipse, noise_rad)) {
      largest_rad = std::max(largest_rad, ellipse.semi_major_rad.value);
    }
  }
  std::size_t best = 0;
  std::size_t best_length = 0;
  std::size_t begin = 0;
  double least_rad = 0;
  for (std::size_t i = 0; i < ellipses.size(); ++i) {
    if (!is_ellipse(ellipses[i], noise_rad) ||
        ellipses[i].semi_major_rad.value < kSmallestShare * largest_rad) {
      begin = i + 1;
      continue;
    }
    const bool adjacent = i > begin && ellipses[i].t_s - ellipses[i - 1].t_s < 2 * period_s;
    if (i > begin && !(adjacent && follows_freely(ellipses[i - 1], ellipses[i], least_rad))) {
      begin = i;
    }
    const double amplitude_rad = ellipses[i].semi_major_rad.value;
    least_rad = i == begin ? amplitude_rad : std::min(least_rad, amplitude_rad);
    if (i + 1 - begin > best_length) {
      best = begin;
      best_length = i + 1 - begin;
    }
  }
  FreeSpan span{.period_s = period_s};
  if (best_length > 0) {
    const std::size_t last = best + best_length - 1;
    // A swing that is cut off counts as free as long as its ellipse hides the rest of its piece:
    // the outermost half swings are not trusted but at the series' ends.
    span.from_s = ellipses[best].t_s - (best == 0 ? period_s / 2 : 0);
    span.to_s = ellipses[last].t_s + (last + 1 == ellipses.size() ? period_s : 0);
  }
  if (span.to_s - span.from_s < kFewestSwings * period_s) {
    return failure(fmt::format(
        "found {:.3g} s of free swings of {:.3g} s, expected at least {} swings: the pendulum is "
        "held, pushed or at rest",
        span.to_s - span.from_s, period_s, kFewestSwings));
  }
  return span;
}

}  // namespace penduline
