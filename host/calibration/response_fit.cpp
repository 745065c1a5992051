// SPDX-License-Identifier: Apache-2.0
// Choosing the points beyond the peak, the degree by Akaike's criterion, and refusing what they do
// not tell.
#include "host/calibration/response_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/calibration/calibration.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

/// How well a jig's gap is known, and the noise that no mean takes away.
constexpr double kJigSigmaM = 20e-6;
constexpr double kNarrowestPointsM = 2e-3;
/// Beyond this a curve is not determined.
constexpr double kWorstCurveSigmaM = 0.1e-3;

struct Weighed {
  std::vector<SensorPoint> points;  ///< from near to far
  std::vector<double> steepness_v_per_m;
  GapRange range;
};

std::size_t distinct_gaps(const std::vector<SensorPoint>& points) {
  constexpr double kSameM = 50e-6;
  std::size_t count = 0;
  double last_m = -1;
  for (const SensorPoint& point : points) {
    if (count == 0 || point.gap_m - last_m > kSameM) {
      ++count;
      last_m = point.gap_m;
    }
  }
  return count;
}

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

tl::expected<Weighed, Error> weigh(std::vector<SensorPoint> points, std::size_t fewest) {
  const std::size_t distinct = distinct_gaps(points);
  if (distinct < fewest) {
    return failure(fmt::format("found {} different gaps, expected {} or more for this model",
                               distinct, fewest));
  }
  Weighed weighed{.points = std::move(points), .steepness_v_per_m = {}, .range = {}};
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

/// One way to fit: parameters, residuals in standard deviations, and the response that comes of it.
struct Candidate {
  std::vector<FitParameter> parameters;
  FitResiduals residuals;
  std::function<std::optional<Response<double>>(const Eigen::VectorXd&)> response;
  /// The gap that the numbers give a point; its derivative by them is the curve's uncertainty.
  std::function<double(const Eigen::VectorXd&, std::size_t)> gap_misfit_m;
};

std::span<const double> span_of(const Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

Candidate finished(Candidate candidate, const Weighed& data) {
  candidate.residuals = [&data, misfit = candidate.gap_misfit_m](const Eigen::VectorXd& values,
                                                                 Eigen::VectorXd& residuals) {
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      const double noise_m = data.points[i].standard_error_v / data.steepness_v_per_m[i];
      residuals[static_cast<Eigen::Index>(i)] = misfit(values, i) / std::hypot(noise_m, kJigSigmaM);
    }
  };
  return candidate;
}

Candidate curve_candidate(CurveKind kind, std::size_t degree, const Weighed& data, double peak_m) {
  const ResponseCurve curve(kind, data.range, degree);
  std::vector<double> gaps;
  std::vector<double> signals;
  for (const SensorPoint& point : data.points) {
    gaps.push_back(point.gap_m);
    signals.push_back(point.volts);
  }
  Candidate candidate;
  const std::vector<double> start = curve.nearest_to(gaps, signals);
  const std::vector<std::string> names = curve.names();
  const std::vector<double> spreads = curve.spreads();
  for (std::size_t i = 0; i < curve.size(); ++i) {
    candidate.parameters.push_back({.name = names[i], .start = start[i], .scale = spreads[i] / 10});
  }
  candidate.gap_misfit_m = [&data, curve](const Eigen::VectorXd& values, std::size_t i) {
    return (curve.volts(span_of(values), data.points[i].gap_m) - data.points[i].volts) /
           data.steepness_v_per_m[i];
  };
  candidate.response = [&data, curve, kind,
                        peak_m](const Eigen::VectorXd& values) -> std::optional<Response<double>> {
    const bool beyond_pole = kind == CurveKind::kInverseSquare && values[1] < 0;
    if (beyond_pole || !keeps_falling(curve, span_of(values), data.range)) {
      return std::nullopt;
    }
    return curve.response(span_of(values), data.range, peak_m);
  };
  return finished(std::move(candidate), data);
}

/// The gap as a polynomial of the signal.
Candidate polynomial_candidate(ResponseModel model, std::size_t degree, const Weighed& data,
                               double peak_m) {
  Candidate candidate;
  for (std::size_t i = 0; i <= degree; ++i) {
    candidate.parameters.push_back({.name = fmt::format("c{}_m_per_v{}", i, i),
                                    .start = i == 0 ? data.range.farthest_m : 0,
                                    .scale = kMillimetre});
  }
  const auto value = [](const Eigen::VectorXd& numbers, double volts) {
    double sum = 0;
    for (Eigen::Index i = numbers.size(); i-- > 0;) {
      sum = sum * volts + numbers[i];
    }
    return sum;
  };
  candidate.gap_misfit_m = [&data, value](const Eigen::VectorXd& numbers, std::size_t i) {
    return value(numbers, data.points[i].volts) - data.points[i].gap_m;
  };
  const auto [weakest, strongest] =
      std::ranges::minmax_element(data.points, {}, &SensorPoint::volts);
  const double low_v = weakest->volts;
  const double high_v = strongest->volts;
  candidate.response = [&data, model, degree, low_v, high_v,
                        peak_m](const Eigen::VectorXd& numbers) -> std::optional<Response<double>> {
    constexpr int kPlaces = 1000;
    if (model == ResponseModel::kLinear) {
      return Response<double>{
          .model = LinearResponse<double>{.gap_at_zero_m = numbers[0], .slope_m_per_v = numbers[1]},
          .nearest_m = data.range.nearest_m,
          .farthest_m = data.range.farthest_m,
          .peak_m = peak_m};
    }
    PolynomialResponse<double> polynomial{
        .coefficient = {}, .count = degree + 1, .volts_min = low_v, .volts_max = high_v};
    std::copy(numbers.begin(), numbers.end(), polynomial.coefficient.begin());
    if (!polynomial.is_monotone(kPlaces) || polynomial.value(high_v) > polynomial.value(low_v)) {
      return std::nullopt;
    }
    return Response<double>{.model = polynomial,
                            .nearest_m = data.range.nearest_m,
                            .farthest_m = data.range.farthest_m,
                            .peak_m = peak_m};
  };
  return finished(std::move(candidate), data);
}

std::vector<Candidate> candidates_for(ResponseModel model, const Weighed& data, double peak_m) {
  constexpr std::size_t kHighestDegree = 6;
  const std::size_t distinct = distinct_gaps(data.points);
  std::vector<Candidate> candidates;
  if (model == ResponseModel::kLinear) {
    candidates.push_back(polynomial_candidate(model, 1, data, peak_m));
  } else if (model == ResponseModel::kInverseSquare) {
    candidates.push_back(curve_candidate(CurveKind::kInverseSquare, 0, data, peak_m));
  } else {
    for (std::size_t degree = 2; degree <= std::min(kHighestDegree, distinct - 2); ++degree) {
      candidates.push_back(model == ResponseModel::kTable
                               ? curve_candidate(CurveKind::kLogPolynomial, degree, data, peak_m)
                               : polynomial_candidate(model, degree, data, peak_m));
    }
  }
  return candidates;
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
double worst_curve_sigma_m(const Candidate& candidate, const Fit& fit, std::size_t points) {
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
tl::expected<void, Error> choose(const std::vector<Candidate>& candidates, const Weighed& data,
                                 ResponseFit& result) {
  double least = std::numeric_limits<double>::infinity();
  double curve_sigma_m = 0;
  std::string why = "the signal does not keep falling as the gap grows";
  for (const Candidate& candidate : candidates) {
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

std::string_view model_name(ResponseModel model) {
  switch (model) {
    case ResponseModel::kTable:
      return "table";
    case ResponseModel::kInverseSquare:
      return "inverse_square";
    case ResponseModel::kPolynomial:
      return "polynomial";
    case ResponseModel::kLinear:
      break;
  }
  return "linear";
}

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
