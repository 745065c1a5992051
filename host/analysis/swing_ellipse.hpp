// SPDX-License-Identifier: Apache-2.0
// Single swings as ellipses: the fundamental of the motion in a short piece of time.
#pragma once

#include <optional>
#include <vector>

#include "common/dynamics.hpp"
#include "host/analysis/angle_series.hpp"
#include "host/analysis/measured.hpp"

namespace penduline {

/// The rod's tilt as a point in the plane seen from above: tilt times its horizontal direction.
struct TiltPoint {
  double x_rad = 0;
  double y_rad = 0;
};

/// The point for two angles (analysis.md eq. 1).
[[nodiscard]] TiltPoint tilt_point(double theta1_rad, double theta2_rad);

/// One swing seen from above (analysis.md eq. 2).
struct SwingEllipse {
  double t_s = 0;            ///< the middle of the piece
  Measured semi_major_rad;   ///< the amplitude
  Measured semi_minor_rad;   ///< above 0: anticlockwise seen from above
  Measured orientation_rad;  ///< of the major axis, from X to Y; goes on beyond a half turn
  Measured phase_rad;        ///< of the swing along the major axis; goes on beyond a turn
  double residual_rad = 0;   ///< RMS of what the ellipse does not describe
  TiltPoint centre;          ///< of the ellipse

  /// a^2 + b^2: what the period and the energy depend on.
  [[nodiscard]] double square_rad2() const;
};

/// How a motion is cut into swings.
struct SwingCut {
  double period_s = 0;  ///< of the swing: the length of a piece, unless its samples are too few
  double step_s = 0;    ///< from piece to piece
  /// Where the pendulum rests, if that is known; else each piece finds its own centre.
  std::optional<TiltPoint> rest;
  /// Standard deviation of x and y, if that is known; else each piece's own scatter.
  std::optional<TiltPoint> noise;
};

/// An ellipse for each piece that has samples enough, in time's order. Amplitude and phase may
/// drift linearly within a piece.
[[nodiscard]] std::vector<SwingEllipse> swing_ellipses(const AngleSeries& series,
                                                       const SwingCut& cut);

}  // namespace penduline
