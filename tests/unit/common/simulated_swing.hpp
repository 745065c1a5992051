// SPDX-License-Identifier: Apache-2.0
// A pendulum to be estimated: it swings by its equations, may be kicked or held, and is seen
// through noisy gaps.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "common/dynamics.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {

[[nodiscard]] inline SwingState<double> moved(const SwingState<double>& state,
                                              const SwingState<double>& rate, double time_s) {
  return {.theta1_rad = state.theta1_rad + time_s * rate.theta1_rad,
          .theta2_rad = state.theta2_rad + time_s * rate.theta2_rad,
          .omega1_rad_s = state.omega1_rad_s + time_s * rate.omega1_rad_s,
          .omega2_rad_s = state.omega2_rad_s + time_s * rate.omega2_rad_s};
}

/// One step of the classical Runge-Kutta method.
[[nodiscard]] inline SwingState<double> stepped(const SwingState<double>& state,
                                                const Pendulum<double>& pendulum, double step_s) {
  const SwingState<double> k1 = swing_derivative(state, pendulum);
  const SwingState<double> k2 = swing_derivative(moved(state, k1, step_s / 2), pendulum);
  const SwingState<double> k3 = swing_derivative(moved(state, k2, step_s / 2), pendulum);
  const SwingState<double> k4 = swing_derivative(moved(state, k3, step_s), pendulum);
  const SwingState<double> ends = moved(moved(state, k1, step_s / 6), k4, step_s / 6);
  return moved(moved(ends, k2, step_s / 3), k3, step_s / 3);
}

/// Samples of a swing at 20 Hz, of the paper's layout and linear sensors.
class SimulatedSwing {
 public:
  static constexpr double kPeriodS = 0.05;

  SimulatedSwing(std::uint64_t seed, const SwingState<double>& start,
                 const Pendulum<double>& pendulum = {.damping_per_s = 0.01})
      : random_(seed), state_(start), pendulum_(pendulum) {}

  /// What the next sample will see.
  [[nodiscard]] const SwingState<double>& state() const { return state_; }
  [[nodiscard]] Angles<double> angles() const { return {state_.theta1_rad, state_.theta2_rad}; }
  /// A blow from outside.
  void kick(double omega1_rad_s, double omega2_rad_s) {
    state_.omega1_rad_s += omega1_rad_s;
    state_.omega2_rad_s += omega2_rad_s;
  }
  /// A hand holds it there.
  void hold(const Angles<double>& angles) { state_ = {angles.theta1_rad, angles.theta2_rad, 0, 0}; }
  /// White noise that moves it, in rad/s^2 in the square root of a Hz.
  void disturb_by(double rad_s15) { noise_rad_s15_ = rad_s15; }

  /// The sample of now, each gap off by so much; then time goes on by a period.
  [[nodiscard]] Sample next(double gap_noise_m = 50e-6) {
    auto gap_m = gaps_at(paper_layout<double>(), angles());
    for (std::size_t i = 0; i < 2; ++i) {
      gap_m[i] += gap_noise_m * normal_(random_);
    }
    const Sample sample = sample_of(seq_++, gap_m);
    swing_on();
    return sample;
  }

  /// A period without a sample.
  void lose() {
    ++seq_;
    swing_on();
  }

 private:
  void swing_on() {
    constexpr int kSteps = 20;
    const double step_s = kPeriodS / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      state_ = stepped(state_, pendulum_, step_s);
      kick(noise_rad_s15_ * std::sqrt(step_s) * normal_(random_),
           noise_rad_s15_ * std::sqrt(step_s) * normal_(random_));
    }
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  SwingState<double> state_;
  Pendulum<double> pendulum_;
  double noise_rad_s15_ = 0;
  std::uint64_t seq_ = 0;
};

/// A swing at up to 10 degrees that goes round, another one for each seed.
[[nodiscard]] inline SwingState<double> start_of(std::uint64_t seed) {
  const double azimuth = 0.3 + static_cast<double>(seed);
  const double theta = from_degrees(10);
  return {.theta1_rad = theta * std::sin(azimuth),
          .theta2_rad = 0.7 * theta * std::cos(azimuth),
          .omega1_rad_s = 0,
          .omega2_rad_s = 0.3 * std::sin(2 * azimuth)};
}

/// The paper's rig seen through gaps that are off by 50 um.
template <class Scalar>
[[nodiscard]] Rig<Scalar> noisy_rig() {
  Rig<Scalar> rig = linear_rig(paper_layout<Scalar>());
  rig.pendulum.damping_per_s = Scalar(0.01);
  rig.noise.fill({.volts = 0, .gap_m = Scalar(50e-6)});
  return rig;
}

}  // namespace penduline::test
