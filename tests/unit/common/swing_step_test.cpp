// SPDX-License-Identifier: Apache-2.0
// Tests of one step of the motion: against small steps, its Jacobian against differences.
#include "common/swing_step.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/common/simulated_swing.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

constexpr SwingParameters<double> kPaper{.stiffness_1_s2 = 9.8 / 0.3, .damping_per_s = 0.01};

template <class Scalar>
MotionStep<Scalar> step_of(const SwingVector<double>& motion, const SwingParameters<double>& swing,
                           double seconds) {
  return swing_on<Scalar>(motion.cast<Scalar>(),
                          {.stiffness_1_s2 = static_cast<Scalar>(swing.stiffness_1_s2),
                           .damping_per_s = static_cast<Scalar>(swing.damping_per_s)},
                          static_cast<Scalar>(seconds));
}

/// Angles up to 45 degrees and the rates that go with them, all signs.
template <class Visitor>
void for_each_motion(const Visitor& visit) {
  for (const double theta1 : {-0.7, -0.2, 0.0, 0.1, 0.6}) {
    for (const double theta2 : {-0.6, -0.1, 0.0, 0.3, 0.7}) {
      for (const double omega1 : {-3.0, 0.0, 1.0}) {
        for (const double omega2 : {-1.0, 0.0, 4.0}) {
          visit(SwingVector<double>(theta1, theta2, omega1, omega2));
        }
      }
    }
  }
}

/// What the angles after one step at 20 Hz and after 500 small ones differ by.
template <class Scalar>
double error_of_a_step(const SwingVector<double>& from) {
  SwingState<double> state{from[0], from[1], from[2], from[3]};
  for (int i = 0; i < 500; ++i) {
    state = stepped(state, {.damping_per_s = 0.01}, 1e-4);
  }
  const auto found = step_of<Scalar>(from, kPaper, 0.05).motion;
  Worst worst;
  worst.note(static_cast<double>(found[0]) - state.theta1_rad);
  worst.note(static_cast<double>(found[1]) - state.theta2_rad);
  return worst.value();
}

TEMPLATE_TEST_CASE("A step at 20 Hz is exact to 2e-5 of a swing's 15 degrees", "[swing_step]",
                   float, double) {
  Worst worst;
  for (int i = 0; i < 100; ++i) {
    const double phase = 0.1 * i;
    const double theta = from_degrees(15);
    const double omega = theta * std::sqrt(kPaper.stiffness_1_s2);
    worst.note(
        error_of_a_step<TestType>({theta * std::cos(phase), 0.6 * theta * std::sin(phase),
                                   -omega * std::sin(phase), 0.6 * omega * std::cos(phase)}));
  }
  CHECK(worst.value() < 2e-5 * from_degrees(15));
}

TEMPLATE_TEST_CASE("A step of the wildest swing is exact to 0.02 degrees", "[swing_step]", float,
                   double) {
  Worst worst;
  for_each_motion(
      [&](const SwingVector<double>& from) { worst.note(error_of_a_step<TestType>(from)); });
  CHECK(worst.value() < from_degrees(0.02));
}

TEST_CASE("A long way is gone in steps as short as a sample's", "[swing_step]") {
  const SwingVector<double> from(0.15, -0.1, 0.2, 0.5);
  SwingVector<double> small = from;
  for (int i = 0; i < 2000; ++i) {
    small = step_of<double>(small, kPaper, 1e-3).motion;
  }
  CHECK((step_of<double>(from, kPaper, 2).motion - small).template head<2>().norm() < 5e-4);
}

TEMPLATE_TEST_CASE("A step's Jacobian is that of its differences", "[swing_step]", float, double) {
  constexpr double kStep = 1e-5;
  Worst worst;
  for (const double seconds : {0.001, 0.05, 0.3}) {
    for_each_motion([&](const SwingVector<double>& from) {
      const auto found = step_of<TestType>(from, kPaper, seconds).jacobian;
      for (Eigen::Index j = 0; j < 6; ++j) {
        const auto moved_by = [&](double step) {
          SwingVector<double> motion = from;
          SwingParameters<double> swing = kPaper;
          double& changed = j < 4 ? motion[j] : j == 4 ? swing.stiffness_1_s2 : swing.damping_per_s;
          changed += step;
          return step_of<double>(motion, swing, seconds).motion;
        };
        const SwingVector<double> difference = (moved_by(kStep) - moved_by(-kStep)) / (2 * kStep);
        for (Eigen::Index i = 0; i < 4; ++i) {
          const double scale = std::max(1.0, std::abs(difference[i]));
          worst.note((static_cast<double>(found(i, j)) - difference[i]) / scale);
        }
      }
    });
  }
  CHECK(worst.value() < tolerance<TestType>(1e-8, 2e-5));
}

TEST_CASE("No time changes nothing", "[swing_step]") {
  const SwingVector<double> from(0.15, -0.1, 0.2, 0.5);
  const auto step = step_of<double>(from, kPaper, 0);
  CHECK(step.motion == from);
  CHECK(step.jacobian == MotionJacobian<double>::Identity());
}

}  // namespace
}  // namespace penduline::test
