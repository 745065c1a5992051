// SPDX-License-Identifier: Apache-2.0
// Rigs as they come out of a drawer: sensors that spread from unit to unit, mounted by hand.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "common/pipeline.hpp"
#include "common/swing_tracker.hpp"
#include "hal/sim/sampled_rig.hpp"
#include "host/calibration/points_table.hpp"
#include "host/calibration/signal_log.hpp"
#include "host/rig_file.hpp"

namespace penduline::test {

inline constexpr double kRadPerDeg = std::numbers::pi / 180;

/// The rig that a user starts from: data sheet curves.
[[nodiscard]] inline RigFile typical_rig() {
  return *read_rig_file(PENDULINE_SOURCE_DIR "/docs/rigs/tcrt5000.toml");
}

/// One real rig: each sensor's gain and its curve's breadth spread by 5 %, its height by 0.2 mm,
/// the pendulum's length by 0.5 %, all 1 sigma.
[[nodiscard]] inline Rig<double> real_rig(unsigned seed) {
  constexpr double kSpread = 0.05;
  constexpr double kHeight_m = 0.2e-3;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Rig<double> rig = typical_rig().rig;
  rig.pendulum.length_m *= 1 + 0.005 * normal(random);
  for (std::size_t i = 0; i < rig.layout.count; ++i) {
    const double gain = std::exp(kSpread * normal(random));
    const double breadth = std::exp(kSpread * normal(random));
    const auto& curve = std::get<TableResponse<double>>(rig.responses[i].model).gap_over_volts;
    std::vector<double> volts(curve.x().begin(), curve.x().end());
    std::vector<double> gaps(curve.y().begin(), curve.y().end());
    std::ranges::for_each(volts, [&](double& value) { value *= gain; });
    std::ranges::for_each(gaps, [&](double& value) { value *= breadth; });
    Response<double>& response = rig.responses[i];
    response.model = TableResponse<double>{MonotoneCubic<double>(volts, gaps)};
    response.nearest_m *= breadth;
    response.farthest_m *= breadth;
    response.peak_m *= breadth;
    rig.layout.position_m[i].z() += kHeight_m * normal(random);
  }
  return rig;
}

/// A board's usual noise: 2 mV a conversion, 12 bits, room light.
[[nodiscard]] inline SimulationSettings settings_for(const SwingStart& start, double seconds,
                                                     std::uint64_t seed) {
  SimulationSettings settings;
  settings.start = start;
  settings.duration_s = seconds;
  settings.seed = seed;
  return settings;
}

/// The swing that docs/calibration.md advises: an ellipse of 12 by 5 deg.
[[nodiscard]] inline SimulationSettings ellipse(double seconds, std::uint64_t seed) {
  return settings_for({.theta_rad = 12 * kRadPerDeg,
                       .phi_rad = 30 * kRadPerDeg,
                       .omega_rad_s = 0,
                       .psi_rad_s = 2.5},
                      seconds, seed);
}

/// A recording of it.
[[nodiscard]] inline SignalLog recorded(const Rig<double>& rig,
                                        const SimulationSettings& settings) {
  SampledRig source(rig, settings);
  SignalLog log{.path = "rec.csv",
                .acquisition = source.acquisition(),
                .t_s = {},
                .volts = {},
                .complaints = {}};
  Sample sample;
  while (*source.read(sample)) {
    std::array<double, kMaxSensors> volts{};
    for (std::size_t i = 0; i < rig.layout.count; ++i) {
      volts[i] = signal_v(sample.readings[i], log.acquisition);
    }
    log.t_s.push_back(static_cast<double>(sample.t_us) * 1e-6);
    log.volts.push_back(volts);
  }
  return log;
}

/// The disc held at given angles by a jig that is off by `jig_deg` RMS, and what the sensors say.
[[nodiscard]] inline SensorPoints held_points(const Rig<double>& rig, const Rig<double>& believed,
                                              const std::vector<Angles<double>>& tilts,
                                              double jig_deg, unsigned seed) {
  constexpr double kMeanNoise_v = 0.1e-3;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  SensorPoints points;
  for (const Angles<double>& tilt : tilts) {
    const Angles<double> real{
        .theta1_rad = tilt.theta1_rad + jig_deg * kRadPerDeg * normal(random),
        .theta2_rad = tilt.theta2_rad + jig_deg * kRadPerDeg * normal(random)};
    const DiscPlane<double> plane(slopes_of(real));
    for (std::size_t i = 0; i < rig.layout.count; ++i) {
      points[i].push_back({.place = "points.csv",
                           .angles = tilt,
                           .gap_m = DiscPlane<double>(slopes_of(tilt)).gap_m(believed.layout, i),
                           .volts = sensor_signal_v(rig.responses[i], plane.gap_m(rig.layout, i)) +
                                    kMeanNoise_v * normal(random),
                           .standard_error_v = kMeanNoise_v});
    }
  }
  return points;
}

/// RMS error over both angles in degrees, after the first second.
template <class Estimator>
[[nodiscard]] double rms_deg(Estimator estimator, const Rig<double>& real,
                             const SimulationSettings& settings) {
  std::map<std::int64_t, SwingState<double>> truth;
  SimulationSettings fine = settings;
  fine.rate_hz = 2 * settings.rate_hz;  // a filter's rows may be of moments between two samples
  SampledRig clock(real, fine);
  Sample sample;
  while (*clock.read(sample)) {
    truth[sample.t_us] = clock.truth();
  }
  SampledRig source(real, settings);
  double squares = 0;
  double count = 0;
  while (*source.read(sample)) {
    const auto estimate = estimator.update(sample);
    if (!estimate.attitude || estimate.t_us < 1'000'000) {
      continue;
    }
    const SwingState<double>& state = truth.at(estimate.t_us);
    squares += std::pow(estimate.attitude->angles.theta1_rad - state.theta1_rad, 2) +
               std::pow(estimate.attitude->angles.theta2_rad - state.theta2_rad, 2);
    count += 2;
  }
  return std::sqrt(squares / count) / kRadPerDeg;
}

/// The same by `gn` and by `ekf`.
struct Errors {
  double gn_deg;
  double ekf_deg;
};
[[nodiscard]] inline Errors errors_of(const Rig<double>& calibrated, const Rig<double>& real,
                                      const SimulationSettings& settings) {
  const Acquisition<double> acquisition = SampledRig(real, settings).acquisition();
  return {rms_deg(Pipeline<double>(calibrated, acquisition), real, settings),
          rms_deg(SwingTracker<double>(calibrated, acquisition), real, settings)};
}

}  // namespace penduline::test
