// SPDX-License-Identifier: Apache-2.0
// Tests of the true motion: the exact integrator against SciPy, the paper's schemes against Python.
#include "hal/sim/motion.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "hal/sim/sampled_rig.hpp"
#include "tests/unit/hal/simulated_rigs.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

constexpr double kPeriod_s = 0.05;
constexpr SwingStart kAskew{
    .theta_rad = 15 * kRadPerDeg, .phi_rad = 30 * kRadPerDeg, .omega_rad_s = 0.5, .psi_rad_s = 3};

Pendulum<double> pendulum(double damping_per_s) {
  return {.length_m = 0.3, .mass_kg = 0.1, .gravity_m_s2 = 9.8, .damping_per_s = damping_per_s};
}

struct Expected {
  double t_s;
  double theta1_rad;
  double theta2_rad;
};

void check_motion(Motion& motion, const std::array<Expected, 3>& expected, double tolerance) {
  for (const Expected& moment : expected) {
    CAPTURE(moment.t_s);
    motion.advance_to(moment.t_s);
    CHECK_THAT(motion.state().theta1_rad, Catch::WithinAbs(moment.theta1_rad, tolerance));
    CHECK_THAT(motion.state().theta2_rad, Catch::WithinAbs(moment.theta2_rad, tolerance));
  }
}

// scipy.integrate.solve_ivp(method="DOP853", rtol=1e-13, atol=1e-15) of the pendulum in Cartesian
// coordinates, r'' = g + lambda r - beta r' with lambda from |r| = 1; theta1 = atan2(y, -z),
// theta2 = atan2(-x, hypot(y, z)).
constexpr double kExact = 1e-9;

TEST_CASE("Case 1 moves as SciPy integrates it", "[sim]") {
  const auto motion = make_motion(Integrator::kDopri5, kCaseOne, pendulum(0.01), kPeriod_s);
  check_motion(*motion,
               {{{1, 0.10313633836039106, -0.10259213601592422},
                 {5, -0.11718161421023653, 0.11638525492831553},
                 {10, 0.10329978031661602, -0.10275300032628264}}},
               kExact);
}

TEST_CASE("A swing out of one plane moves as SciPy integrates it", "[sim]") {
  const auto motion = make_motion(Integrator::kDopri5, kAskew, pendulum(0.01), kPeriod_s);
  check_motion(*motion,
               {{{1, 0.030849381297970182, -0.1791450402271726},
                 {5, -0.2195963860867783, 0.15031487703038615},
                 {10, 0.26066203107930064, -0.048634686653378036}}},
               kExact);
}

TEST_CASE("The exact motion does not depend on where it is looked at", "[sim]") {
  const auto often = make_motion(Integrator::kDopri5, kAskew, pendulum(0.01), kPeriod_s);
  for (int i = 1; i <= 1000; ++i) {
    often->advance_to(i / 100.0);
  }
  check_motion(*often,
               {{{10, 0.26066203107930064, -0.048634686653378036},
                 {10, 0.26066203107930064, -0.048634686653378036},
                 {10, 0.26066203107930064, -0.048634686653378036}}},
               kExact);
}

TEST_CASE("Without damping the exact motion keeps its energy for a minute", "[sim]") {
  const auto motion = make_motion(Integrator::kDopri5, kAskew, pendulum(0), kPeriod_s);
  const double start_j = energy_j(motion->state(), pendulum(0));
  double worst = 0;
  for (int i = 1; i <= 1200; ++i) {
    motion->advance_to(i * kPeriod_s);
    worst = std::max(worst, std::abs(energy_j(motion->state(), pendulum(0)) / start_j - 1));
  }
  CHECK(worst <= 1e-9);
}

TEST_CASE("A pendulum at rest stays at rest", "[sim]") {
  const auto motion = make_motion(Integrator::kDopri5, {}, pendulum(0), kPeriod_s);
  motion->advance_to(10);
  CHECK(motion->state().theta1_rad == 0);
  CHECK(motion->state().theta2_rad == 0);
}

TEST_CASE("The start's rates are the change of its angles", "[sim]") {
  // Central differences of the angles at theta + omega h, phi + psi h.
  constexpr double kStep = 1e-6;
  const auto moved = [](double h) {
    return swing_state({.theta_rad = kAskew.theta_rad + kAskew.omega_rad_s * h,
                        .phi_rad = kAskew.phi_rad + kAskew.psi_rad_s * h});
  };
  const SwingState<double> after = moved(kStep);
  const SwingState<double> before = moved(-kStep);
  const SwingState<double> state = swing_state(kAskew);
  CHECK_THAT(state.omega1_rad_s,
             Catch::WithinAbs((after.theta1_rad - before.theta1_rad) / (2 * kStep), 1e-9));
  CHECK_THAT(state.omega2_rad_s,
             Catch::WithinAbs((after.theta2_rad - before.theta2_rad) / (2 * kStep), 1e-9));
}

// A Python loop of Eqs. 12 to 19 as printed, dt = 0.05 s; angles of the rod from (theta, phi).
TEST_CASE("Euler takes the paper's first steps", "[sim]") {
  const auto motion = make_motion(Integrator::kEuler, kCaseOne, pendulum(0.01), kPeriod_s);
  check_motion(*motion,
               {{{0.05, 0.12404187831712417, -0.12309845838946604},
                 {0.10, 0.1138728963267768, -0.1131416947032574},
                 {0.50, -0.17178929533846563, 0.1693090331858676}}},
               1e-14);
}

TEST_CASE("Euler is where the paper's loop is after 200 iterations", "[sim]") {
  // By then it has wound up to theta = -82.6 rad and grown its rounding 10000 times.
  const auto motion = make_motion(Integrator::kEuler, kCaseOne, pendulum(0.01), kPeriod_s);
  motion->advance_to(10);
  CHECK_THAT(motion->state().theta1_rad, Catch::WithinAbs(-0.7613911651701938, 1e-10));
  CHECK_THAT(motion->state().theta2_rad, Catch::WithinAbs(0.6039349750025546, 1e-10));
}

TEST_CASE("Euler takes case 2 round as the paper's loop does", "[sim]") {
  const auto motion = make_motion(Integrator::kEuler, kCaseTwo, pendulum(0.01), kPeriod_s);
  check_motion(*motion,
               {{{0.05, 0.13566800959599742, -0.11013858823289562},
                 {0.10, 0.13543362627979072, -0.08927801836534767},
                 {0.25, 0.05664938146723619, -0.005466517699055857}}},
               1e-14);
}

TEST_CASE("With updated velocities case 1 is where the same Python loop is", "[sim]") {
  const auto motion = make_motion(Integrator::kSemiImplicit, kCaseOne, pendulum(0.01), kPeriod_s);
  check_motion(*motion,
               {{{0.05, 0.1138728963267768, -0.1131416947032574},
                 {0.50, -0.12381995747053995, 0.12288155397749158},
                 {10.0, 0.07888908073807709, -0.07864473743414041}}},
               1e-12);
}

/// Runs a simulation and tells when it had blown up.
double blown_up_at_s(Integrator integrator, const SwingStart& start, double duration_s) {
  SimulationSettings settings = ideal(start);
  settings.integrator = integrator;
  settings.duration_s = duration_s;
  SampledRig rig(paper_rig(), settings);
  for (Sample sample; rig.read(sample).value();) {
  }
  return rig.blown_up_at_s();
}

TEST_CASE("Euler has doubled case 1's energy by 0.45 s", "[sim]") {
  // The Python loop: 1.86 times at 0.40 s, 2.01 times at 0.45 s.
  CHECK(blown_up_at_s(Integrator::kEuler, kCaseOne, 10) == Approx(0.45).epsilon(1e-12));
}

TEST_CASE("With updated velocities case 1 does not blow up", "[sim]") {
  CHECK(std::isinf(blown_up_at_s(Integrator::kSemiImplicit, kCaseOne, 600)));
}

TEST_CASE("The exact motion does not blow up", "[sim]") {
  CHECK(std::isinf(blown_up_at_s(Integrator::kDopri5, kCaseOne, 60)));
  CHECK(std::isinf(blown_up_at_s(Integrator::kDopri5, kCaseTwo, 60)));
}

TEST_CASE("Euler runs away in case 2, and the error says when", "[sim]") {
  SimulationSettings settings = ideal(kCaseTwo);
  settings.integrator = Integrator::kEuler;
  SampledRig rig(paper_rig(), settings);
  Sample sample;
  tl::expected<bool, Error> more = true;
  while (more && *more) {
    more = rig.read(sample);
  }
  // The Python loop: omega = -1.3e7 rad/s at 0.5 s.
  REQUIRE_FALSE(more);
  CHECK(more.error().message ==
        "sim: no angles any more at t = 0.500 s: the integrator has run away");
}

TEST_CASE("A swing through the X axis ends there, for theta1 has no value", "[sim]") {
  // From 120 degrees in the XZ plane the rod passes the horizontal.
  SimulationSettings settings = ideal({.theta_rad = 2.094, .phi_rad = 0});
  SampledRig rig(paper_rig(), settings);
  Sample sample;
  tl::expected<bool, Error> more = true;
  while (more && *more) {
    more = rig.read(sample);
  }
  REQUIRE_FALSE(more);
  CHECK(
      more.error().message.ends_with("the rod has come to lie along the X axis, where theta1 has "
                                     "no value"));
}

TEST_CASE("A release from a ten-millionth of a degree keeps its energy", "[sim]") {
  CHECK(std::isinf(blown_up_at_s(Integrator::kDopri5, {.theta_rad = 1.7e-9, .phi_rad = 0.8}, 10)));
}

TEST_CASE("A pendulum that is held stays where it starts", "[sim]") {
  const auto motion =
      make_motion(Integrator::kHeld, {.theta_rad = 0.2, .omega_rad_s = 3}, {}, 0.05);
  motion->advance_to(10);
  CHECK(motion->state().theta2_rad == Approx(-0.2));
  CHECK(motion->state().omega2_rad_s == 0);
}

}  // namespace
