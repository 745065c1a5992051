// SPDX-License-Identifier: Apache-2.0
// From the state of a Kalman filter or smoother to an estimate.
#pragma once

#include <cmath>
#include <cstddef>

#include "common/disc_plane.hpp"
#include "common/estimate.hpp"
#include "common/gap_gradient.hpp"
#include "common/gap_measurement.hpp"
#include "common/rig.hpp"
#include "common/swing_filter.hpp"

namespace penduline {

/// Puts a state of `SwingFilter`, the variances of its two angles and the RMS of what the measured
/// gaps differ from it into an estimate. The mass hangs by the rig's length: the one that the
/// filter learns is that of the period, which a rod's own mass makes another.
template <class Scalar>
void put_state(const Rig<Scalar>& rig, const typename SwingFilter<Scalar>::State& state,
               const typename Estimate<Scalar>::Pair& variance_rad2,
               const GapMeasurements<Scalar>& measured, Estimate<Scalar>& estimate) {
  const Angles<Scalar> angles{.theta1_rad = state[0], .theta2_rad = state[1]};
  const DiscPlane<Scalar> plane = tilt_at(angles).plane;
  estimate.attitude = {.angles = angles, .mass_m = rig.pendulum.length_m * plane.rod()};
  estimate.omega_rad_s = {.first = state[2], .second = state[3]};
  estimate.sigma_rad = {.first = std::sqrt(variance_rad2.first),
                        .second = std::sqrt(variance_rad2.second)};
  if (measured.count == 0) {
    return;
  }
  Scalar squares = 0;
  for (std::size_t i = 0; i < measured.count; ++i) {
    const auto& [sensor, gap_m, variance_m2] = measured.gap[i];
    const Scalar expected_m =
        plane.gap_m(rig.layout, sensor) + state[SwingFilter<Scalar>::kOffsets + sensor];
    squares += (gap_m - expected_m) * (gap_m - expected_m);
  }
  estimate.residual_m = std::sqrt(squares / static_cast<Scalar>(measured.count));
}

}  // namespace penduline
