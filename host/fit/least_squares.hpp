// SPDX-License-Identifier: Apache-2.0
// Fits by least squares: the numbers that make a model agree with measurements, and how well they
// are known.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"

namespace penduline {

/// A number that a fit looks for.
struct FitParameter {
  std::string name;  ///< with its unit, for messages: "length_m"
  double start = 0;  ///< where the search begins
  double scale = 1;  ///< above 0: a change that matters, as far as the start may well be off
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  /// Sigma above which the data do not determine it, in its unit.
  double coarsest_sigma = std::numeric_limits<double>::infinity();
};

/// What measurements and model differ by, each divided by its standard deviation, for parameters in
/// their order. Where these have no answer: anything that is not finite.
using FitResiduals = std::function<void(const Eigen::VectorXd& values, Eigen::VectorXd& residuals)>;

/// A fit that has come to its minimum.
struct Fit {
  Eigen::VectorXd values;  ///< in the parameters' order
  /// Of `values`, with the scatter that the residuals themselves have. What is held at a bound has
  /// none: the others are known as if it had not been looked for.
  Eigen::MatrixXd covariance;
  Eigen::VectorXd residuals;  ///< that are left, in standard deviations
  /// RMS of `residuals` over their degrees of freedom: 1 where the standard deviations are right.
  double scatter = 0;
  std::vector<std::size_t> undetermined;  ///< parameters whose sigma is above their coarsest
  std::vector<std::size_t> at_bound;      ///< parameters that would have gone on

  [[nodiscard]] double sigma(std::size_t parameter) const;
};

/// Goes from the start to the minimum within the bounds by Gauss-Newton steps; where these do not
/// get there, searches first (NLopt's SLSQP on scaled parameters). Jacobians are central
/// differences of a ten-thousandth of the scale, so `residuals` must be smooth there. Fails where
/// there are fewer residuals than parameters, where the start has no answer, where no minimum is
/// reached, and soon after `stopped` has come to say so; that may be empty.
[[nodiscard]] tl::expected<Fit, Error> fit_least_squares(
    const std::vector<FitParameter>& parameters, std::size_t residual_count,
    const FitResiduals& residuals, const std::function<bool()>& stopped = {});

}  // namespace penduline
