// SPDX-License-Identifier: Apache-2.0
// Gaps of which the true angles are known: what every solver is timed on and checked against.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include "common/disc_plane.hpp"
#include "hal/sim/motion.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::bench {

template <class Scalar>
struct KnownTilt {
  Angles<double> truth;
  std::array<Scalar, kMaxSensors> gap_m;
};

/// The gaps of a layout at given angles.
template <class Scalar>
[[nodiscard]] KnownTilt<Scalar> known_tilt(const SensorLayout<Scalar>& layout,
                                           const Angles<double>& truth) {
  return {.truth = truth,
          .gap_m = test::rounded<Scalar>(test::gaps_at(test::widened(layout), truth))};
}

/// What all are timed on: an ordinary swing to 10 degrees, 200 samples at 20 Hz. The same as that
/// of `penduline simulate --theta-deg 10 --phi-deg 30 --psi 3 --rig docs/rigs/paper.toml`.
template <class Scalar>
[[nodiscard]] std::vector<KnownTilt<Scalar>> swing(const SensorLayout<Scalar>& layout) {
  constexpr int kSamples = 200;
  constexpr double kPeriodS = 0.05;
  const std::unique_ptr<Motion> motion = make_motion(
      Integrator::kDopri5,
      {.theta_rad = test::from_degrees(10), .phi_rad = test::from_degrees(30), .psi_rad_s = 3},
      Pendulum<double>{.damping_per_s = 0.01}, kPeriodS);
  std::vector<KnownTilt<Scalar>> tilts;
  for (int i = 0; i < kSamples; ++i) {
    motion->advance_to(i * kPeriodS);
    const SwingState<double> state = motion->state();
    tilts.push_back(known_tilt(layout, {state.theta1_rad, state.theta2_rad}));
  }
  return tilts;
}

/// What all are checked on besides: every half degree to 45 degrees of tilt, where the paper's two
/// sensors tell tilts apart (conditioning from 0.3 up).
template <class Scalar>
[[nodiscard]] std::vector<KnownTilt<Scalar>> whole_range(const SensorLayout<Scalar>& layout) {
  std::vector<KnownTilt<Scalar>> tilts;
  test::for_each_good_tilt(
      [&](const Angles<double>& truth) { tilts.push_back(known_tilt(layout, truth)); });
  return tilts;
}

/// The paper's two sensors; more stand evenly around the pivot, as far out.
template <class Scalar>
[[nodiscard]] SensorLayout<Scalar> layout_with(std::size_t sensors) {
  if (sensors == 2) {
    return test::paper_layout<Scalar>();
  }
  constexpr double kRadiusM = 0.02;
  SensorLayout<Scalar> layout{.count = sensors, .disc_offset_m = Scalar(kRadiusM)};
  for (std::size_t i = 0; i < sensors; ++i) {
    const double azimuth =
        2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(sensors);
    layout.position_m[i] =
        Vector3<double>(kRadiusM * std::cos(azimuth), kRadiusM * std::sin(azimuth), 0)
            .cast<Scalar>();
  }
  return layout;
}

}  // namespace penduline::bench
