// SPDX-License-Identifier: Apache-2.0
// The path of a swing, by Boost's odeint.
#include "host/fit/swing_path.hpp"

#include <array>
#include <boost/numeric/odeint/integrate/integrate_times.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <cmath>
#include <numbers>

namespace penduline {
namespace {

using Motion = std::array<double, 4>;

SwingState<double> state_of(const Motion& motion) {
  return {.theta1_rad = motion[0],
          .theta2_rad = motion[1],
          .omega1_rad_s = motion[2],
          .omega2_rad_s = motion[3]};
}

}  // namespace

std::vector<SwingState<double>> swing_path(const FreeSwing& swing, const SwingState<double>& start,
                                           std::span<const double> times_s) {
  const Pendulum<double> frictionless{
      .length_m = 1, .gravity_m_s2 = swing.stiffness_1_s2, .damping_per_s = 0};
  const auto& [linear_per_s, quadratic_per_rad, dry_rad_s2] = swing.friction;
  const auto derivative = [&](const Motion& motion, Motion& change, double /*t_s*/) {
    const SwingState<double> state = state_of(motion);
    const SwingState<double> free = swing_derivative(state, frictionless);
    const double across = std::cos(state.theta2_rad) * state.omega1_rad_s;
    const double square = across * across + state.omega2_rad_s * state.omega2_rad_s;
    const double drag = linear_per_s + quadratic_per_rad * std::sqrt(square) +
                        dry_rad_s2 / std::sqrt(square + kDryRounding_rad_s * kDryRounding_rad_s);
    change = {free.theta1_rad, free.theta2_rad, free.omega1_rad_s - drag * state.omega1_rad_s,
              free.omega2_rad_s - drag * state.omega2_rad_s};
  };
  const double step_s = 2 * std::numbers::pi / std::sqrt(swing.stiffness_1_s2) / 100;
  std::vector<SwingState<double>> path;
  path.reserve(times_s.size());
  Motion motion{start.theta1_rad, start.theta2_rad, start.omega1_rad_s, start.omega2_rad_s};
  boost::numeric::odeint::integrate_times(
      boost::numeric::odeint::runge_kutta4<Motion>(), derivative, motion, times_s.begin(),
      times_s.end(), step_s,
      [&](const Motion& at, double /*t_s*/) { path.push_back(state_of(at)); });
  return path;
}

}  // namespace penduline
