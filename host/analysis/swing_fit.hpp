// SPDX-License-Identifier: Apache-2.0
// The equations of motion fitted to the angles of a free swing.
#pragma once

#include <functional>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"
#include "host/analysis/angle_series.hpp"
#include "host/analysis/swing_ellipse.hpp"
#include "host/fit/swing_path.hpp"

namespace penduline {

/// Which kinds of friction a model has.
struct FrictionTerms {
  bool linear = false;
  bool quadratic = false;
  bool dry = false;

  bool operator==(const FrictionTerms&) const = default;
  [[nodiscard]] int count() const { return int{linear} + int{quadratic} + int{dry}; }
};

/// Everything that decides the angles of a swing.
struct SwingModel {
  FreeSwing swing{};
  SwingState<double> start{};  ///< at the first row's time, from rest
  TiltPoint zero{};            ///< what is read at rest: theta1 in x_rad, theta2 in y_rad
};

/// A fitted model.
struct SwingFit {
  FrictionTerms terms;
  bool planar = false;
  SwingModel model{};
  Eigen::VectorXd values{};      ///< of the fit, in the order that `model_of` takes
  Eigen::MatrixXd covariance{};  ///< theirs, with what the residuals' repetition adds
  Eigen::VectorXd residual1_rad{};
  Eigen::VectorXd residual2_rad{};  ///< empty where planar
  TiltPoint noise{};                ///< RMS of theta1's residuals (x_rad) and theta2's (y_rad)
  double chi_square = 0;            ///< in the standard deviations that the fit was given
  double repetition = 1;            ///< of neighbouring residuals (measured.hpp)

  /// The model that fitted values stand for.
  [[nodiscard]] SwingModel model_of(const Eigen::VectorXd& of_values) const;
  /// A number that follows from the model, with its uncertainty.
  [[nodiscard]] Measured figure(const std::function<double(const SwingModel&)>& of) const;
};

/// The model's angles at the times of `times_s`, the first of which is its start.
[[nodiscard]] AngleSeries simulated_angles(const SwingModel& model,
                                           const std::vector<double>& times_s, bool planar);

/// Fits `terms` from `guess` on; `noise` is what theta1 (x_rad) and theta2 (y_rad) are weighed by.
/// Frictions are 0 or above. Fails where no minimum is found, or soon after `stopped` says so.
[[nodiscard]] tl::expected<SwingFit, Error> fit_swing(const AngleSeries& series,
                                                      FrictionTerms terms, const SwingModel& guess,
                                                      const TiltPoint& noise,
                                                      const std::function<bool()>& stopped = {});

/// A fit with linear friction of the whole series, found from its first swings on; both angles
/// count the same. Fails as `fit_swing` does.
[[nodiscard]] tl::expected<SwingFit, Error> fit_from_nothing(
    const AngleSeries& series, double period_s, const std::function<bool()>& stopped = {});

}  // namespace penduline
