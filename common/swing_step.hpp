// SPDX-License-Identifier: Apache-2.0
// One step of the pendulum's motion in time, with its exact derivative by where it started and by
// what is not known of the pendulum.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "common/dynamics.hpp"

namespace penduline {

/// What the motion depends on besides the state: gravity over length, and damping.
template <class Scalar>
struct SwingParameters {
  Scalar stiffness_1_s2 = 0;
  Scalar damping_per_s = 0;
};

/// theta1, theta2, omega1, omega2 in radians and seconds.
template <class Scalar>
using SwingVector = Eigen::Matrix<Scalar, 4, 1>;

/// Derivative of a motion by theta1, theta2, omega1, omega2 as they were at the start, by the
/// stiffness and by the damping.
template <class Scalar>
using MotionJacobian = Eigen::Matrix<Scalar, 4, 6>;

template <class Scalar>
struct MotionStep {
  SwingVector<Scalar> motion;
  MotionJacobian<Scalar> jacobian;
};

namespace swing_step {

/// The motion's change per second (method.md eq. 4) and that of its Jacobian (the variational
/// equations).
template <class Scalar>
[[nodiscard]] MotionStep<Scalar> rate(const MotionStep<Scalar>& at,
                                      const SwingParameters<Scalar>& parameters) {
  const Scalar sin1 = std::sin(at.motion[0]);
  const Scalar cos1 = std::cos(at.motion[0]);
  const Scalar sin2 = std::sin(at.motion[1]);
  const Scalar cos2 = std::cos(at.motion[1]);
  const Scalar omega1 = at.motion[2];
  const Scalar omega2 = at.motion[3];
  const Scalar stiffness = parameters.stiffness_1_s2;
  const Scalar damping = parameters.damping_per_s;
  const Scalar secant2 = 1 / cos2;
  const Scalar tan2 = sin2 * secant2;
  const Scalar pull1 = sin1 * secant2;
  const Scalar pull2 = cos1 * sin2;
  const Scalar turn = 2 * tan2 * omega1;

  MotionStep<Scalar> change;
  change.motion << omega1, omega2, turn * omega2 - stiffness * pull1 - damping * omega1,
      -sin2 * cos2 * omega1 * omega1 - stiffness * pull2 - damping * omega2;

  // Derivatives of the accelerations by theta1, theta2, omega1, omega2.
  const SwingVector<Scalar> of_1(
      -stiffness * cos1 * secant2,
      (2 * omega1 * omega2 * secant2 - stiffness * sin1 * tan2) * secant2,
      2 * tan2 * omega2 - damping, turn);
  const SwingVector<Scalar> of_2(
      stiffness * sin1 * sin2,
      (sin2 * sin2 - cos2 * cos2) * omega1 * omega1 - stiffness * cos1 * cos2,
      -2 * sin2 * cos2 * omega1, -damping);
  for (Eigen::Index i = 0; i < change.jacobian.cols(); ++i) {
    const auto column = at.jacobian.col(i);
    change.jacobian.col(i) << column[2], column[3], of_1.dot(column), of_2.dot(column);
  }
  change.jacobian(2, 4) -= pull1;
  change.jacobian(3, 4) -= pull2;
  change.jacobian(2, 5) -= omega1;
  change.jacobian(3, 5) -= omega2;
  return change;
}

/// `from` and `seconds` of `change` on top.
template <class Scalar>
[[nodiscard]] MotionStep<Scalar> moved(const MotionStep<Scalar>& from,
                                       const MotionStep<Scalar>& change, Scalar seconds) {
  return {.motion = from.motion + seconds * change.motion,
          .jacobian = from.jacobian + seconds * change.jacobian};
}

/// One step of the classical Runge-Kutta method of fourth order; its Jacobian is that of the step
/// itself, not an approximation of its own.
template <class Scalar>
[[nodiscard]] MotionStep<Scalar> runge_kutta(const MotionStep<Scalar>& from,
                                             const SwingParameters<Scalar>& parameters,
                                             Scalar seconds) {
  MotionStep<Scalar> sum = rate(from, parameters);
  MotionStep<Scalar> stage = rate(moved(from, sum, seconds / 2), parameters);
  sum = moved(sum, stage, Scalar(2));
  stage = rate(moved(from, stage, seconds / 2), parameters);
  sum = moved(sum, stage, Scalar(2));
  stage = rate(moved(from, stage, seconds), parameters);
  return moved(from, moved(sum, stage, Scalar(1)), seconds / 6);
}

}  // namespace swing_step

/// The motion `seconds` later, in as many steps as keep each one's error below 2e-5 of the
/// amplitude: 0.3 rad of the small swing at the most.
template <class Scalar>
[[nodiscard]] MotionStep<Scalar> swing_on(const SwingVector<Scalar>& motion,
                                          const SwingParameters<Scalar>& parameters,
                                          Scalar seconds) {
  constexpr Scalar kLongestStepRad = Scalar(0.3);
  MotionStep<Scalar> step{.motion = motion, .jacobian = MotionJacobian<Scalar>::Identity()};
  const Scalar phase_rad = seconds * std::sqrt(parameters.stiffness_1_s2);
  const int steps =
      phase_rad > kLongestStepRad ? static_cast<int>(std::ceil(phase_rad / kLongestStepRad)) : 1;
  for (int i = 0; i < steps; ++i) {
    step = swing_step::runge_kutta(step, parameters, seconds / static_cast<Scalar>(steps));
  }
  return step;
}

}  // namespace penduline
