// SPDX-License-Identifier: Apache-2.0
// What the ellipses of a swing say from swing to swing: how its period depends on the amplitude,
// how it precesses.
#pragma once

#include <optional>
#include <vector>

#include "host/analysis/swing_ellipse.hpp"

namespace penduline {

/// One step from a swing to the next.
struct PeriodPoint {
  double amplitude_rad = 0;  ///< sqrt(a^2 + b^2), which decides the period
  Measured period_s;
  double theory_s = 0;  ///< for the small swing's period (analysis.md eq. 4)
};

/// Period against amplitude, from the phases alone.
struct PeriodTrend {
  Measured small_period_s;
  /// The factor before a^2 + b^2 in the period: 1/16 by theory.
  Measured coefficient_per_rad2;
  std::vector<PeriodPoint> points;
};

/// Needs 4 ellipses or more that are known to a sigma above 0; `small_period_s` is the theory's.
[[nodiscard]] std::optional<PeriodTrend> period_trend(const std::vector<SwingEllipse>& ellipses,
                                                      double small_period_s);

/// Period of a swing against that of small ones: a planar swing's series to the sixth power in the
/// planar part and Lagrange's second order in the width (analysis.md eq. 4).
[[nodiscard]] double period_ratio(double semi_major_rad, double semi_minor_rad);

/// Rate at which an ellipse turns by itself, in the sense of its motion (Airy 1851; analysis.md
/// eq. 7).
[[nodiscard]] double airy_rate_rad_s(const SwingEllipse& ellipse, double omega0_rad_s);

/// Rate at which a plane of oscillation turns with the Earth, seen from above (analysis.md eq. 8).
[[nodiscard]] double foucault_rate_rad_s(double latitude_rad);

/// Rates of the orientation in the middle of the same time, by the same parabola.
struct Precession {
  Measured measured_rad_s;
  double airy_rad_s = 0;
};

/// The rate at the middle of the ellipses' time of an angle that they have, weighed by its sigmas:
/// of a parabola through it where there are 5 or more, since what decays turns ever more slowly.
[[nodiscard]] Measured middle_rate_rad_s(const std::vector<SwingEllipse>& ellipses,
                                         const Eigen::VectorXd& angles_rad,
                                         const Eigen::VectorXd& sigmas_rad);

/// None where the orientation is not known: a circle, or fewer than 3 ellipses.
[[nodiscard]] std::optional<Precession> precession(const std::vector<SwingEllipse>& ellipses,
                                                   double omega0_rad_s);

}  // namespace penduline
