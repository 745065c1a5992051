// SPDX-License-Identifier: Apache-2.0
// Propagation of uncertainty and linear least squares.
#include "host/analysis/measured.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace penduline {

Measured propagated(const Eigen::VectorXd& values, const Eigen::MatrixXd& covariance,
                    const std::function<double(const Eigen::VectorXd&)>& figure) {
  constexpr double kShare = 0.1;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(values.size());
  Eigen::VectorXd moved = values;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const double step = kShare * std::sqrt(covariance(i, i));
    if (!(step > 0)) {
      continue;  // known exactly
    }
    moved[i] = values[i] + step;
    gradient[i] = figure(moved);
    moved[i] = values[i] - step;
    gradient[i] = (gradient[i] - figure(moved)) / (2 * step);
    moved[i] = values[i];
  }
  const double variance = gradient.dot(covariance * gradient);
  // Rounding below 0 is none; what is no number stays none.
  return {.value = figure(values), .sigma = variance < 0 ? 0 : std::sqrt(variance)};
}

Measured LinearFit::factor(Eigen::Index i) const {
  return {.value = factors[i], .sigma = std::sqrt(covariance(i, i))};
}

LinearFit fit_linear(const Eigen::MatrixXd& design, const Eigen::VectorXd& values,
                     const Eigen::VectorXd& sigmas) {
  const Eigen::MatrixXd weighted = sigmas.cwiseInverse().asDiagonal() * design;
  // Columns of one size, so that the normal matrix can be inverted.
  const Eigen::VectorXd scales = weighted.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd scaled = weighted * scales.asDiagonal();
  const Eigen::VectorXd targets = values.cwiseQuotient(sigmas);
  const Eigen::VectorXd solution = scaled.colPivHouseholderQr().solve(targets);
  const auto freedom = design.rows() - design.cols();
  const double chi_square = (scaled * solution - targets).squaredNorm();
  const double inflation =
      freedom > 0 ? std::max(1.0, chi_square / static_cast<double>(freedom)) : 1;
  const Eigen::MatrixXd normal = scaled.transpose() * scaled;
  return {.factors = scales.cwiseProduct(solution),
          .covariance = inflation * scales.asDiagonal() *
                        normal.completeOrthogonalDecomposition().pseudoInverse() *
                        scales.asDiagonal()};
}

double autocorrelation(const Eigen::VectorXd& values, Eigen::Index lag) {
  const double square = values.squaredNorm();
  const Eigen::Index pairs = values.size() - lag;
  if (!(square > 0) || pairs <= 0) {
    return 0;
  }
  return values.head(pairs).dot(values.tail(pairs)) / square;
}

double repetition(const Eigen::VectorXd& values) {
  double sum = 1;
  for (Eigen::Index lag = 1; lag < values.size() / 4; ++lag) {
    const double here = autocorrelation(values, lag);
    // Noise alone gives so much.
    if (here < 2 / std::sqrt(static_cast<double>(values.size()))) {
      break;
    }
    sum += 2 * here;
  }
  return sum;
}

}  // namespace penduline
