// SPDX-License-Identifier: Apache-2.0
// A number that came out of measurements, with how well it is known; straight lines through such.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace penduline {

/// A figure and its standard deviation, in the same unit.
struct Measured {
  double value = 0;
  double sigma = 0;
};

/// A number made of fitted values: its sigma follows from theirs to first order, by central
/// differences of a tenth of each value's own sigma. It is not finite where the figure there is
/// not.
[[nodiscard]] Measured propagated(const Eigen::VectorXd& values, const Eigen::MatrixXd& covariance,
                                  const std::function<double(const Eigen::VectorXd&)>& figure);

/// What is known of the factors before each column of `design` from `values` with their sigmas
/// (linear least squares). Where the values scatter more than the sigmas say, so do the factors.
struct LinearFit {
  Eigen::VectorXd factors;
  Eigen::MatrixXd covariance;
  [[nodiscard]] Measured factor(Eigen::Index i) const;
};

/// At least as many rows as columns, sigmas above 0.
[[nodiscard]] LinearFit fit_linear(const Eigen::MatrixXd& design, const Eigen::VectorXd& values,
                                   const Eigen::VectorXd& sigmas);

/// By how much neighbours repeat each other: the variance of the values' mean against that of
/// independent ones, 1 or more (the sum of their autocorrelations up to the first that is not
/// positive, after Geyer's initial sequence).
[[nodiscard]] double repetition(const Eigen::VectorXd& values);

/// Autocorrelation at a lag of so many values, -1 to 1.
[[nodiscard]] double autocorrelation(const Eigen::VectorXd& values, Eigen::Index lag);

}  // namespace penduline
