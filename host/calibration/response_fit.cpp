// SPDX-License-Identifier: Apache-2.0
// Choosing the points beyond the peak, the degree by Akaike's criterion, and refusing what they do
// not tell.
#include "host/calibration/response_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/calibration/calibration.hpp"
#include "host/calibration/response_candidates.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

constexpr double kNarrowestPointsM = 2e-3;
/// Beyond this a curve is not determined.
constexpr double kWorstCurveSigmaM = 0.1e-3;

/// The gap of the peak: where points nearer than the strongest are clearly weaker, between that one
/// and the next, as near to what the rig knows as can be; else what the rig knows.
double peak_of(const std::vector<SensorPoint>& points, double known_m) {
  constexpr double kWeaker = 0.98;
  const auto strongest = std::ranges::max_element(points, {}, &SensorPoint::volts);
  const bool folds = std::any_of(points.begin(), strongest, [&](const SensorPoint& point) {
    return point.volts < kWeaker * strongest->volts;
  });
  if (!folds) {
    return known_m;
  }
  const auto next = strongest + 1 == points.end() ? strongest : strongest + 1;
  return std::clamp(known_m, strongest->gap_m, next->gap_m);
}

/// Leaves out what is too near to the peak to tell its sides apart.
double leave_out_fold(std::vector<SensorPoint>& points, double known_peak_m, ResponseFit& result) {
  const double peak_m = peak_of(points, known_peak_m);
  const double nearest_m = Response<double>::kPeakMargin * peak_m;
  const std::size_t before = points.size();
  std::erase_if(points, [&](const SensorPoint& point) { return point.gap_m < nearest_m; });
  result.left_out = before - points.size();
  if (result.left_out > 0) {
    result.warnings.push_back(fmt::format(
        "{} of {} points are nearer than {:.2f} mm and left out: the signal folds back at its peak "
        "at {:.2f} mm, where two gaps give one signal",
        result.left_out, before, nearest_m / kMillimetre, peak_m / kMillimetre));
  }
  return peak_m;
}

tl::expected<WeighedPoints, Error> weigh(std::vector<SensorPoint> points, std::size_t fewest) {
  const std::size_t distinct = distinct_gaps(points);
  if (distinct < fewest) {
    return failure(fmt::format("found {} different gaps, expected {} or more for this model",
                               distinct, fewest));
  }
  WeighedPoints weighed{.points = std::move(points), .steepness_v_per_m = {}, .range = {}};
  weighed.range = {weighed.points.front().gap_m, weighed.points.back().gap_m};
  if (weighed.range.farthest_m - weighed.range.nearest_m < kNarrowestPointsM) {
    return failure(fmt::format("found gaps from {:.2f} to {:.2f} mm, expected {:.0f} mm or more",
                               weighed.range.nearest_m / kMillimetre,
                               weighed.range.farthest_m / kMillimetre,
                               kNarrowestPointsM / kMillimetre));
  }
  std::vector<double> gaps;
  std::vector<double> signals;
  for (const SensorPoint& point : weighed.points) {
    gaps.push_back(point.gap_m);
    signals.push_back(point.volts);
  }
  const ResponseCurve smooth(CurveKind::kLogPolynomial, weighed.range, 2);
  const std::vector<double> numbers = smooth.nearest_to(gaps, signals);
  for (const double gap_m : gaps) {
    const double here = (smooth.volts(numbers, gap_m + 1e-5) - smooth.volts(numbers, gap_m - 1e-5));
    weighed.steepness_v_per_m.push_back(std::max(std::abs(here) / 2e-5, 1.0));
  }
  return weighed;
}

/// Akaike's criterion for known sigmas, corrected for few points: what one number more must gain.
double akaike(double squares, std::size_t points, std::size_t numbers) {
  const auto n = static_cast<double>(points);
  const auto k = static_cast<double>(numbers);
  return n - k - 1 > 0 ? squares + 2 * k + 2 * k * (k + 1) / (n - k - 1)
                       : std::numeric_limits<double>::infinity();
}

std::size_t fewest_gaps(ResponseModel model) {
  switch (model) {
    case ResponseModel::kLinear:
      return 3;
    case ResponseModel::kInverseSquare:
      return 4;
    default:
      return 5;
  }
}

/// Greatest standard deviation of the curve at a point, in metres.
double worst_curve_sigma_m(const ResponseCandidate& candidate, const Fit& fit, std::size_t points) {
  double worst = 0;
  Eigen::VectorXd moved = fit.values;
  for (std::size_t i = 0; i < points; ++i) {
    Eigen::VectorXd gradient(fit.values.size());
    for (Eigen::Index k = 0; k < moved.size(); ++k) {
      const double step = candidate.parameters[static_cast<std::size_t>(k)].scale * 1e-3;
      moved[k] = fit.values[k] + step;
      const double above = candidate.gap_misfit_m(moved, i);
      moved[k] = fit.values[k] - step;
      gradient[k] = (above - candidate.gap_misfit_m(moved, i)) / (2 * step);
      moved[k] = fit.values[k];
    }
    worst = std::max(worst, std::sqrt(gradient.dot(fit.covariance * gradient)));
  }
  return worst;
}

/// The candidate that gains most for its numbers.
tl::expected<void, Error> choose(const std::vector<ResponseCandidate>& candidates,
                                 const WeighedPoints& data, ResponseFit& result) {
  double least = std::numeric_limits<double>::infinity();
  double curve_sigma_m = 0;
  std::string why = "the signal does not keep falling as the gap grows";
  for (const ResponseCandidate& candidate : candidates) {
    auto fit = fit_least_squares(candidate.parameters, data.points.size(), candidate.residuals);
    if (!fit) {
      why = fit.error().message;
      continue;
    }
    const auto response = candidate.response(fit->values);
    const double criterion =
        akaike(fit->residuals.squaredNorm(), data.points.size(), candidate.parameters.size());
    if (!response || (criterion >= least && !result.names.empty())) {
      continue;
    }
    least = criterion;
    result.response = *response;
    result.names.clear();
    std::ranges::transform(candidate.parameters, std::back_inserter(result.names),
                           &FitParameter::name);
    result.residuals_m.clear();
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      result.residuals_m.push_back(candidate.gap_misfit_m(fit->values, i));
    }
    curve_sigma_m = worst_curve_sigma_m(candidate, *fit, data.points.size());
    result.fit = std::move(*fit);
  }
  if (result.names.empty()) {
    return failure(why);
  }
  if (!(curve_sigma_m <= kWorstCurveSigmaM)) {
    return failure(
        fmt::format("the points leave the curve uncertain by {:.2f} mm, expected {:.1f} mm or "
                    "less: more points, "
                    "better known, or a simpler model",
                    curve_sigma_m / kMillimetre, kWorstCurveSigmaM / kMillimetre));
  }
  return {};
}

}  // namespace

tl::expected<ResponseFit, Error> fit_response(std::vector<SensorPoint> points, ResponseModel model,
                                              const Response<double>& start,
                                              const std::string& name) {
  const auto named = [&](const Error& error) {
    return failure(fmt::format("sensor {}: {}", name, error.message));
  };
  if (points.empty()) {
    return failure(fmt::format("sensor {}: found no points of it", name));
  }
  if (std::ranges::any_of(points, [](const auto& point) { return !(point.volts > 0); })) {
    return failure(fmt::format(
        "sensor {}: found a signal not above 0 V, expected the emitter's light in every point",
        name));
  }
  ResponseFit result;
  std::ranges::sort(points, {}, &SensorPoint::gap_m);
  const double peak_m = leave_out_fold(points, start.peak_m, result);
  const auto data = weigh(std::move(points), fewest_gaps(model));
  if (!data) {
    return named(data.error());
  }
  if (const auto chosen = choose(candidates_for(model, *data, peak_m), *data, result); !chosen) {
    return named(chosen.error());
  }
  result.range = data->range;
  result.used = data->points;
  result.residual_m =
      std::sqrt(std::inner_product(result.residuals_m.begin(), result.residuals_m.end(),
                                   result.residuals_m.begin(), 0.0) /
                static_cast<double>(result.residuals_m.size()));
  for (std::string& warning : result.warnings) {
    warning = fmt::format("sensor {}: {}", name, warning);
  }
  return result;
}

}  // namespace penduline
