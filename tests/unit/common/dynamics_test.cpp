// SPDX-License-Identifier: Apache-2.0
// Tests of the equations of motion: against Newton's law, energy, periods, the conical swing.
#include "common/dynamics.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/common/simulated_swing.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

using State = SwingState<double>;

/// 0.1 ms steps, whose error is far below every bar here.
template <class Visitor>
State run(State state, const Pendulum<double>& pendulum, double time_s, const Visitor& visit) {
  const int steps = static_cast<int>(std::ceil(time_s / 1e-4));
  for (int i = 0; i < steps; ++i) {
    state = stepped(state, pendulum, time_s / steps);
    visit(state);
  }
  return state;
}

/// A swing that goes round, at up to 45 degrees.
constexpr State kEllipse{0.5, -0.6, 1.5, 2.0};

TEMPLATE_TEST_CASE("Accelerations are those of Newton's law on the sphere", "[dynamics]", float,
                   double) {
  // numpy: p'' = gravity + tension along the rod, differentiated through theta1 = atan2(y, -z) and
  // theta2 = asin(-x / l); then less damping times the rates
  struct Case {
    double theta1, theta2, omega1, omega2, length, gravity, damping, alpha1, alpha2;
  };
  const Case expected =
      GENERATE(Case{0.1, 0, 0, 0, 0.3, 9.8, 0, -3.2612249437963885, 0},
               Case{0, 0.1, 0, 0, 0.3, 9.8, 0, 0, -3.261224943796387},
               Case{0.2, -0.3, 1.5, -2, 0.3, 9.8, 0, -4.9372588817591065, 10.09645238500293},
               Case{-0.9, 0.7, -3, 4, 0.5, 9.81, 0.25, 0.6292554485765975, -13.291394695685687},
               Case{0.5, 1.2, 2, 1, 0.3, 9.8, 0.01, -32.951758103081815, -28.080340490041554},
               Case{1, -1, 0, 0, 2, 1.62, 0, -1.2615002569704712, 0.36826545786440096});
  const auto derivative = swing_derivative(
      SwingState<TestType>{
          static_cast<TestType>(expected.theta1), static_cast<TestType>(expected.theta2),
          static_cast<TestType>(expected.omega1), static_cast<TestType>(expected.omega2)},
      Pendulum<TestType>{.length_m = static_cast<TestType>(expected.length),
                         .gravity_m_s2 = static_cast<TestType>(expected.gravity),
                         .damping_per_s = static_cast<TestType>(expected.damping)});
  // float: 50 rad/s^2 to a few roundings of 6e-8.
  const double bar = tolerance<TestType>(5e-14, 2e-5);
  CHECK_THAT(derivative.omega1_rad_s, Catch::WithinAbs(expected.alpha1, bar));
  CHECK_THAT(derivative.omega2_rad_s, Catch::WithinAbs(expected.alpha2, bar));
}

TEST_CASE("The angles change by the rates", "[dynamics]") {
  const State derivative = swing_derivative(kEllipse, Pendulum<double>{});
  CHECK(derivative.theta1_rad == kEllipse.omega1_rad_s);
  CHECK(derivative.theta2_rad == kEllipse.omega2_rad_s);
}

TEST_CASE("At rest nothing changes", "[dynamics]") {
  const State derivative = swing_derivative(State{}, Pendulum<double>{});
  CHECK(derivative.omega1_rad_s == 0);
  CHECK(derivative.omega2_rad_s == 0);
}

TEST_CASE("Energy is that of a point mass on the sphere", "[dynamics]") {
  CHECK(energy_j(State{}, Pendulum<double>{}) == 0);
  // 0.1 * 9.8 * 0.3 * (1 - cos 0.2 * cos 0.3), in Python
  CHECK_THAT(energy_j(State{0.2, 0.3, 0, 0}, Pendulum<double>{}),
             Catch::WithinAbs(0.01872975110624543, 1e-16));
  // At the bottom 0.1 * (0.3^2 * (2^2 + 1^2)) / 2
  CHECK_THAT(energy_j(State{0, 0, 2, 1}, Pendulum<double>{}), Catch::WithinAbs(0.0225, 1e-16));
}

TEST_CASE("Without damping the energy stays over a period", "[dynamics]") {
  const Pendulum<double> pendulum;
  const double energy = energy_j(kEllipse, pendulum);
  Worst worst;
  run(kEllipse, pendulum, 1.2,
      [&](const State& state) { worst.note(energy_j(state, pendulum) / energy - 1); });
  CHECK(worst.value() <= 1e-12);
}

TEST_CASE("Damping takes energy at every moment of a swing", "[dynamics]") {
  const Pendulum<double> pendulum{.damping_per_s = 0.5};
  double energy = energy_j(kEllipse, pendulum);
  bool falls = true;
  run(kEllipse, pendulum, 1.2, [&](const State& state) {
    const double next = energy_j(state, pendulum);
    falls = falls && next < energy;
    energy = next;
  });
  CHECK(falls);
}

TEST_CASE("A small damped swing decays by half its damping", "[dynamics]") {
  const Pendulum<double> pendulum{.damping_per_s = 0.2};
  const State start{.theta1_rad = 1e-4};
  const double energy = energy_j(start, pendulum);
  // Ten damped periods, 2 pi / sqrt(g/l - (beta/2)^2): the energy is exp(-beta t) of what it was.
  const double time_s = 10 * 2 * std::numbers::pi / std::sqrt(9.8 / 0.3 - 0.01);
  const State end = run(start, pendulum, time_s, [](const State&) {});
  CHECK_THAT(energy_j(end, pendulum) / energy / std::exp(-0.2 * time_s), Catch::WithinAbs(1, 1e-7));
}

TEMPLATE_TEST_CASE("A pendulum of 0.3 m swings at 0.9096 Hz", "[dynamics]", float, double) {
  // numpy.sqrt(9.8 / 0.3) / 2 / numpy.pi
  CHECK_THAT(small_swing_hz(Pendulum<TestType>{}),
             Catch::WithinAbs(0.9096462681059556, tolerance<TestType>(1e-15, 1e-7)));
}

TEST_CASE("A quarter of a large swing takes as long as the elliptic integral says", "[dynamics]") {
  // 4 * sqrt(0.3 / 9.8) * scipy.special.ellipk(sin(20 deg)**2): the period from 40 degrees
  constexpr double kPeriod = 1.1337819494136665;
  const bool about_x = GENERATE(true, false);
  const double amplitude = from_degrees(40);
  const State start = about_x ? State{.theta1_rad = amplitude} : State{.theta2_rad = amplitude};
  const State end = run(start, Pendulum<double>{}, kPeriod / 4, [](const State&) {});
  CHECK_THAT(about_x ? end.theta1_rad : end.theta2_rad, Catch::WithinAbs(0, 1e-11));
}

TEST_CASE("In conical motion at 10 degrees and 5.76 rad/s the mass keeps its height",
          "[dynamics]") {
  const Pendulum<double> pendulum;
  const double tilt = from_degrees(10);
  const double turn_rad_s = std::sqrt(9.8 / (0.3 * std::cos(tilt)));
  CHECK_THAT(turn_rad_s, Catch::WithinAbs(5.76, 0.005));
  // The rod along +X, moving along +Y with l sin(tilt) times the turn's rate.
  const State start{.theta2_rad = -tilt, .omega1_rad_s = std::tan(tilt) * turn_rad_s};
  Worst worst;
  run(start, pendulum, 2 * std::numbers::pi / turn_rad_s, [&](const State& state) {
    worst.note(rod_at({state.theta1_rad, state.theta2_rad}).z() + std::cos(tilt));
  });
  CHECK(worst.value() <= 1e-12);
}

TEST_CASE("Conical motion comes back to where it began after one turn", "[dynamics]") {
  const double tilt = from_degrees(10);
  const double turn_rad_s = std::sqrt(9.8 / (0.3 * std::cos(tilt)));
  const State start{.theta2_rad = -tilt, .omega1_rad_s = std::tan(tilt) * turn_rad_s};
  const State end =
      run(start, Pendulum<double>{}, 2 * std::numbers::pi / turn_rad_s, [](const State&) {});
  CHECK_THAT(end.theta1_rad, Catch::WithinAbs(0, 1e-11));
  CHECK_THAT(end.theta2_rad, Catch::WithinAbs(-tilt, 1e-11));
}

}  // namespace
}  // namespace penduline::test
