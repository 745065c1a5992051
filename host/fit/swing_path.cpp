// SPDX-License-Identifier: Apache-2.0
// The path of a swing, by Boost's odeint.
#include "host/fit/swing_path.hpp"

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <cmath>
#include <numbers>

namespace penduline {
namespace {

using SwingNumbers = std::array<double, 4>;

SwingState<double> state_of(const SwingNumbers& motion) {
  return {.theta1_rad = motion[0],
          .theta2_rad = motion[1],
          .omega1_rad_s = motion[2],
          .omega2_rad_s = motion[3]};
}

/// Square of the rate at which the rod's direction moves.
double square_of_speed(const SwingNumbers& motion) {
  const double across = std::cos(motion[1]) * motion[2];
  return across * across + motion[3] * motion[3];
}

/// Deceleration by gravity in the direction of rest.
double pull_rad_s2(const SwingNumbers& motion, const FreeSwing& swing) {
  const double cosine = std::cos(motion[0]) * std::cos(motion[1]);
  return swing.stiffness_1_s2 * std::sqrt(std::max(0.0, 1 - cosine * cosine));
}

/// Whether dry friction holds the mass where it is.
bool sticks(const SwingNumbers& motion, const FreeSwing& swing) {
  return square_of_speed(motion) < kDryRoundingRadPerS * kDryRoundingRadPerS &&
         pull_rad_s2(motion, swing) < swing.friction.dry_rad_s2;
}

/// A step within which the speed does not change by more than a quarter of itself, since dry
/// friction turns round with it.
double turning_step_s(const SwingNumbers& motion, const FreeSwing& swing) {
  constexpr double kShare = 0.25;
  const double speed =
      std::sqrt(square_of_speed(motion) + kDryRoundingRadPerS * kDryRoundingRadPerS);
  return kShare * speed / (std::abs(swing.friction.dry_rad_s2) + pull_rad_s2(motion, swing));
}

}  // namespace

std::vector<SwingState<double>> swing_path(const FreeSwing& swing, const SwingState<double>& start,
                                           std::span<const double> times_s) {
  const Pendulum<double> frictionless{
      .length_m = 1, .gravity_m_s2 = swing.stiffness_1_s2, .damping_per_s = 0};
  const Friction& friction = swing.friction;
  const auto derivative = [&](const SwingNumbers& motion, SwingNumbers& change, double /*t_s*/) {
    const SwingState<double> state = state_of(motion);
    const SwingState<double> free = swing_derivative(state, frictionless);
    const double square = square_of_speed(motion);
    const double drag =
        friction.linear_per_s + friction.quadratic_per_rad * std::sqrt(square) +
        friction.dry_rad_s2 / std::sqrt(square + kDryRoundingRadPerS * kDryRoundingRadPerS);
    change = {free.theta1_rad, free.theta2_rad, free.omega1_rad_s - drag * state.omega1_rad_s,
              free.omega2_rad_s - drag * state.omega2_rad_s};
  };
  const double smooth_step_s = 2 * std::numbers::pi / std::sqrt(swing.stiffness_1_s2) / 100;
  boost::numeric::odeint::runge_kutta4<SwingNumbers> stepper;
  std::vector<SwingState<double>> path;
  path.reserve(times_s.size());
  SwingNumbers motion{start.theta1_rad, start.theta2_rad, start.omega1_rad_s, start.omega2_rad_s};
  double now_s = 0;  // from the start on: seconds since 1970 have no digits left for a step
  bool resting = false;
  for (const double time_s : times_s) {
    const double t_s = time_s - times_s.front();
    while (now_s < t_s && !resting) {
      const double longest_s = friction.dry_rad_s2 == 0
                                   ? smooth_step_s
                                   : std::min(smooth_step_s, turning_step_s(motion, swing));
      const double left_s = t_s - now_s;
      const bool last = left_s <= longest_s;
      const double step_s = last ? left_s : left_s < 2 * longest_s ? left_s / 2 : longest_s;
      stepper.do_step(derivative, motion, now_s, step_s);
      now_s = last ? t_s : now_s + step_s;
      if (sticks(motion, swing)) {
        resting = true;
        motion[2] = motion[3] = 0;
      }
      if (!std::isfinite(motion[0] + motion[1])) {
        resting = true;  // run away: the rest of the path has no answer either
      }
    }
    path.push_back(state_of(motion));
  }
  return path;
}

}  // namespace penduline
