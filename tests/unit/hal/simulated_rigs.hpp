// SPDX-License-Identifier: Apache-2.0
// What the tests of the simulation share: rigs, and settings without any disturbance.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "common/rig.hpp"
#include "hal/sim/sampled_rig.hpp"

namespace penduline::test {

inline constexpr double kRadPerDeg = std::numbers::pi / 180;

/// A rig like docs/rigs/paper.toml with a linear sensor at each place: 1 V at 16 mm, 3 V at 28 mm.
[[nodiscard]] inline Rig<double> rig_with_sensors(std::initializer_list<Vector3<double>> places_m) {
  Rig<double> rig;
  rig.pendulum.damping_per_s = 0.01;
  rig.layout.disc_offset_m = 0.02;
  for (const Vector3<double>& place_m : places_m) {
    rig.responses[rig.layout.count].model =
        LinearResponse<double>{.gap_at_zero_m = 0.01, .slope_m_per_v = 0.006};
    rig.layout.position_m[rig.layout.count++] = place_m;
  }
  return rig;
}

/// The paper's two sensors.
[[nodiscard]] inline Rig<double> paper_rig() {
  return rig_with_sensors({{0.02, 0, 0}, {0, 0.02, 0}});
}

/// The paper's case 1: released at rest from 10 degrees on the diagonal.
inline constexpr SwingStart kCaseOne{.theta_rad = 10 * kRadPerDeg, .phi_rad = 45 * kRadPerDeg};
/// Its case 2: the same with 2 rad/s around the vertical.
inline constexpr SwingStart kCaseTwo{
    .theta_rad = 10 * kRadPerDeg, .phi_rad = 45 * kRadPerDeg, .psi_rad_s = 2};

/// No ambient light, no noise, 16 bits, one conversion.
[[nodiscard]] inline SimulationSettings ideal(const SwingStart& start) {
  return {.start = start, .ambient_v = 0, .noise_v = 0, .adc_bits = 16, .conversions = 1};
}

/// A sample of a simulation that cannot fail.
[[nodiscard]] inline Sample next_sample(SampledRig& rig) {
  Sample sample;
  if (!rig.read(sample).value()) {
    throw tl::bad_expected_access<bool>(false);
  }
  return sample;
}

}  // namespace penduline::test
