// SPDX-License-Identifier: Apache-2.0
// Least squares in gaps: a point's error is its noise over the curve's steepness, and the jig's.
#include "host/calibration/response_candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "host/units.hpp"

namespace penduline {
namespace {

/// How well a jig's gap is known, and the noise that no mean takes away.
constexpr double kJigSigmaM = 20e-6;

std::span<const double> span_of(const Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

ResponseCandidate finished(ResponseCandidate candidate, const WeighedPoints& data) {
  candidate.residuals = [&data, misfit = candidate.gap_misfit_m](const Eigen::VectorXd& values,
                                                                 Eigen::VectorXd& residuals) {
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      const double noise_m = data.points[i].standard_error_v / data.steepness_v_per_m[i];
      residuals[static_cast<Eigen::Index>(i)] = misfit(values, i) / std::hypot(noise_m, kJigSigmaM);
    }
  };
  return candidate;
}

ResponseCandidate curve_candidate(CurveKind kind, std::size_t degree, const WeighedPoints& data,
                                  double peak_m) {
  const ResponseCurve curve(kind, data.range, degree);
  std::vector<double> gaps;
  std::vector<double> signals;
  for (const SensorPoint& point : data.points) {
    gaps.push_back(point.gap_m);
    signals.push_back(point.volts);
  }
  ResponseCandidate candidate;
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
ResponseCandidate polynomial_candidate(ResponseModel model, std::size_t degree,
                                       const WeighedPoints& data, double peak_m) {
  ResponseCandidate candidate;
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

}  // namespace

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

std::vector<ResponseCandidate> candidates_for(ResponseModel model, const WeighedPoints& data,
                                              double peak_m) {
  constexpr std::size_t kHighestDegree = 6;
  const std::size_t distinct = distinct_gaps(data.points);
  std::vector<ResponseCandidate> candidates;
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

}  // namespace penduline
