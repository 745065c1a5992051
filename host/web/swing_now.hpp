// SPDX-License-Identifier: Apache-2.0
// How the pendulum swings just now: period, amplitude and ellipse of the last seconds.
#pragma once

#include <deque>
#include <optional>

#include "common/dynamics.hpp"
#include "host/analysis/swing_ellipse.hpp"
#include "host/web/live_row.hpp"

namespace penduline {

/// The mass's path from above, an ellipse in metres.
struct PathEllipse {
  double a_m = 0;  ///< half the major axis
  double b_m = 0;  ///< half the minor one, 0 or more
  double x_m = 0;  ///< of its centre
  double y_m = 0;
  double orientation_rad = 0;  ///< of the major axis, from X to Y, -pi/2 to pi/2
  /// Seen from above: 1 anticlockwise, -1 clockwise, 0 where the width is within three of its
  /// sigmas.
  int sense = 0;
};

/// That of a mass `length_m` below the pivot in one swing.
[[nodiscard]] PathEllipse path_of(const SwingEllipse& swing, double length_m);

struct SwingNow {
  double period_s = 0;
  double amplitude_rad = 0;  ///< of the last swing
  PathEllipse ellipse;       ///< of the last swing
};

/// Of the last `span_s` seconds; none where they have less than two swings that are ellipses, as at
/// rest or while a hand moves the pendulum. What is faster than twice the pendulum's small swings,
/// or within three standard uncertainties of its angles, is taken for noise.
[[nodiscard]] std::optional<SwingNow> swing_now(const std::deque<LiveRow>& rows,
                                                const Pendulum<double>& pendulum,
                                                double span_s = 8);

}  // namespace penduline
