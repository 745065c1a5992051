// SPDX-License-Identifier: Apache-2.0
// The log polynomial, by Chebyshev's polynomials for its numbers to be of one size, and
// a/(d+b)^2+c.
#include "host/calibration/response_curve.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

namespace penduline {
namespace {

constexpr std::size_t kTablePoints = 24;

double chebyshev_sum(std::span<const double> numbers, double x) {
  double before = 0;
  double here = 0;
  for (std::size_t i = numbers.size(); i-- > 1;) {
    const double next = 2 * x * here - before + numbers[i];
    before = here;
    here = next;
  }
  return x * here - before + numbers[0];
}

Eigen::VectorXd vector_of(std::span<const double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
}

/// With b held, a/(d+b)^2+c is linear in a and c. The best b of a fine ladder.
std::vector<double> inverse_square_near(std::span<const double> gap_m,
                                        std::span<const double> volts) {
  const Eigen::VectorXd gaps = vector_of(gap_m);
  const Eigen::VectorXd signals = vector_of(volts);
  // Relative misfits, as the logarithm would have.
  const Eigen::VectorXd weights = signals.cwiseInverse();
  std::vector<double> best;
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 60; ++step) {
    const double b_m = 0.0005 * step;
    Eigen::MatrixXd terms(gaps.size(), 2);
    terms.col(0) = (gaps.array() + b_m).square().inverse().matrix().cwiseProduct(weights);
    terms.col(1) = weights;
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(gaps.size());
    const Eigen::Vector2d found = terms.colPivHouseholderQr().solve(ones);
    const double misfit = (terms * found - ones).squaredNorm();
    if (found[0] > 0 && misfit < least) {
      least = misfit;
      best = {std::log(found[0]), b_m, found[1]};
    }
  }
  return best.empty() ? std::vector<double>{std::log(1e-5), 0.001, 0} : best;
}

}  // namespace

std::vector<std::string> ResponseCurve::names() const {
  if (kind_ == CurveKind::kInverseSquare) {
    return {"ln_a_v_m2", "b_m", "c_v"};
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i <= degree_; ++i) {
    names.push_back(fmt::format("ln_volts_{}", i));
  }
  return names;
}

std::vector<double> ResponseCurve::spreads() const {
  if (kind_ == CurveKind::kInverseSquare) {
    return {0.5, 0.002, 0.1};
  }
  constexpr double kSignal = 0.5;  // Vishay 83760: 0.5 to 2.1 mA about 1 mA
  constexpr double kSlope = 0.1;
  std::vector<double> spreads{kSignal};
  for (std::size_t i = 1; i <= degree_; ++i) {
    spreads.push_back(kSlope / static_cast<double>(i));
  }
  return spreads;
}

double ResponseCurve::place(double gap_m) const {
  return (2 * gap_m - range_.farthest_m - range_.nearest_m) /
         (range_.farthest_m - range_.nearest_m);
}

double ResponseCurve::volts(std::span<const double> numbers, double gap_m) const {
  if (kind_ == CurveKind::kLogPolynomial) {
    return std::exp(chebyshev_sum(numbers, place(gap_m)));
  }
  const double distance_m = gap_m + numbers[1];
  return std::exp(numbers[0]) / (distance_m * distance_m) + numbers[2];
}

std::vector<double> ResponseCurve::nearest_to(std::span<const double> gap_m,
                                              std::span<const double> volts) const {
  if (kind_ == CurveKind::kInverseSquare) {
    return inverse_square_near(gap_m, volts);
  }
  Eigen::MatrixXd terms(std::ssize(gap_m), static_cast<Eigen::Index>(size()));
  std::vector<double> unit(size(), 0);
  for (std::size_t term = 0; term < size(); ++term) {
    unit[term] = 1;
    for (std::size_t i = 0; i < gap_m.size(); ++i) {
      terms(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(term)) =
          chebyshev_sum(unit, place(gap_m[i]));
    }
    unit[term] = 0;
  }
  const Eigen::VectorXd found =
      terms.colPivHouseholderQr().solve(vector_of(volts).array().log().matrix());
  return {found.begin(), found.end()};
}

Response<double> ResponseCurve::response(std::span<const double> numbers, const GapRange& range,
                                         double peak_m) const {
  Response<double> response{
      .model = {}, .nearest_m = range.nearest_m, .farthest_m = range.farthest_m, .peak_m = peak_m};
  if (kind_ == CurveKind::kInverseSquare) {
    response.model = InverseSquareResponse<double>{
        .a_v_m2 = std::exp(numbers[0]), .b_m = numbers[1], .c_v = numbers[2]};
    return response;
  }
  std::array<double, kTablePoints> signals{};
  std::array<double, kTablePoints> gaps{};
  for (std::size_t i = 0; i < kTablePoints; ++i) {
    const double share = static_cast<double>(i) / (kTablePoints - 1);
    gaps[i] = range.farthest_m - share * (range.farthest_m - range.nearest_m);
    signals[i] = volts(numbers, gaps[i]);
  }
  response.model = TableResponse<double>{MonotoneCubic<double>(signals, gaps)};
  return response;
}

bool keeps_falling(const ResponseCurve& curve, std::span<const double> numbers,
                   const GapRange& range) {
  constexpr int kPlaces = 200;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kPlaces; ++i) {
    const double here =
        curve.volts(numbers, range.nearest_m + (range.farthest_m - range.nearest_m) * i / kPlaces);
    if (!(here < before)) {
      return false;
    }
    before = here;
  }
  return true;
}

}  // namespace penduline
