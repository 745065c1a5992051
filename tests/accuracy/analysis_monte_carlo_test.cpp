// SPDX-License-Identifier: Apache-2.0
// What an analysis makes of noisy swings, over many seeds: as good as any could be, and its sigmas
// true.
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "hal/sim/motion.hpp"
#include "host/analysis/swing_analysis.hpp"
#include "host/units.hpp"

using namespace penduline;

namespace {

constexpr double kNoiseRad = 0.1 * kDegree;
constexpr int kSeeds = 60;
constexpr Pendulum<double> kPendulum{
    .length_m = 0.3, .mass_kg = 0.1, .gravity_m_s2 = 9.8, .damping_per_s = 0.01};

std::vector<double> times_at_20_hz(double seconds) {
  std::vector<double> times;
  for (int i = 0; i < static_cast<int>(20 * seconds); ++i) {
    times.push_back(0.05 * i);
  }
  return times;
}

/// The exact integrator's angles with noise of their own on each.
AngleSeries noisy_swing(const SwingStart& start, double seconds, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, kNoiseRad);
  const auto motion = make_motion(Integrator::kDopri5, start, kPendulum, 0.05);
  AngleSeries series{.t_s = times_at_20_hz(seconds)};
  for (const double t_s : series.t_s) {
    motion->advance_to(t_s);
    series.theta1_rad.push_back(motion->state().theta1_rad + noise(random));
    series.theta2_rad.push_back(motion->state().theta2_rad + noise(random));
  }
  return series;
}

/// Cramer-Rao bound of the linear damping's sigma: from the derivatives of the true angles by all
/// that a fit does not know.
double bound_per_s(const SwingStart& start, double seconds) {
  const auto times = times_at_20_hz(seconds);
  const auto rows = static_cast<Eigen::Index>(times.size());
  const SwingState<double> state = swing_state(start);
  const Eigen::VectorXd truth{{kPendulum.damping_per_s, kPendulum.gravity_m_s2 / kPendulum.length_m,
                               state.theta1_rad, state.theta2_rad, state.omega1_rad_s,
                               state.omega2_rad_s, 0, 0}};
  const auto angles = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd result(2 * rows);
    const auto path = swing_path(
        {.stiffness_1_s2 = at[1], .friction = {.linear_per_s = at[0]}},
        {.theta1_rad = at[2], .theta2_rad = at[3], .omega1_rad_s = at[4], .omega2_rad_s = at[5]},
        times);
    for (Eigen::Index i = 0; i < rows; ++i) {
      result[i] = path[static_cast<std::size_t>(i)].theta1_rad + at[6];
      result[rows + i] = path[static_cast<std::size_t>(i)].theta2_rad + at[7];
    }
    return result;
  };
  constexpr double kStep = 1e-5;
  Eigen::MatrixXd jacobian(2 * rows, truth.size());
  for (Eigen::Index i = 0; i < truth.size(); ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(truth.size(), i);
    jacobian.col(i) = (angles(truth + step) - angles(truth - step)) / (2 * kStep);
  }
  const Eigen::MatrixXd information = jacobian.transpose() * jacobian / (kNoiseRad * kNoiseRad);
  return std::sqrt(information.inverse()(0, 0));
}

}  // namespace

TEST_CASE("The damping from 10 s at 20 Hz is within 1.25 times the Cramer-Rao bound") {
  const SwingStart start{.theta_rad = 10 * kDegree, .phi_rad = 0.6};
  const double bound = bound_per_s(start, 10);
  // The bound of the amplitude's rate, half the damping: sqrt(24 / N) noise / (A T).
  CHECK(bound / 2 == Approx(3.5e-4).epsilon(0.05));
  double squares = 0;
  double squares_in_sigmas = 0;
  double length_squares_in_sigmas = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const auto analysis = analyze_swing(noisy_swing(start, 10, seed), {.gravity_m_s2 = 9.8});
    INFO("seed " << seed << ": " << (analysis ? "" : analysis.error().message));
    REQUIRE(analysis);
    REQUIRE(analysis->linear_per_s);
    const double error = analysis->linear_per_s->value - kPendulum.damping_per_s;
    squares += error * error;
    squares_in_sigmas += std::pow(error / analysis->linear_per_s->sigma, 2);
    length_squares_in_sigmas +=
        std::pow((analysis->length_m.value - kPendulum.length_m) / analysis->length_m.sigma, 2);
  }
  const double rms = std::sqrt(squares / kSeeds);
  WARN("damping: RMS error " << rms << " 1/s, Cramer-Rao bound " << bound << " 1/s; in sigmas "
                             << std::sqrt(squares_in_sigmas / kSeeds) << ", length "
                             << std::sqrt(length_squares_in_sigmas / kSeeds));
  CHECK(rms < 1.25 * bound);
  // scipy.stats.chi2.ppf([0.005, 0.995], 60)
  CHECK(squares_in_sigmas > 35.53);
  CHECK(squares_in_sigmas < 91.95);
  CHECK(length_squares_in_sigmas > 35.53);
  CHECK(length_squares_in_sigmas < 91.95);
}

TEST_CASE("The precession of 15 by 5 deg is found within 1 %, with its sigma") {
  const double omega0_rad_s = std::sqrt(9.8 / 0.3);
  const SwingStart start{.theta_rad = 15 * kDegree,
                         .psi_rad_s = 5 * kDegree * omega0_rad_s / std::sin(15 * kDegree)};
  // The same parabola through the ellipses of the motion without noise, which swing_trends_test.cpp
  // holds against SciPy.
  const auto motion = make_motion(Integrator::kDopri5, start, kPendulum, 0.05);
  AngleSeries exact{.t_s = times_at_20_hz(20)};
  for (const double t_s : exact.t_s) {
    motion->advance_to(t_s);
    exact.theta1_rad.push_back(motion->state().theta1_rad);
    exact.theta2_rad.push_back(motion->state().theta2_rad);
  }
  const double period_s = 2 * std::numbers::pi / omega0_rad_s;
  const auto truth =
      precession(swing_ellipses(exact, {.period_s = period_s,
                                        .step_s = period_s,
                                        .rest = TiltPoint{},
                                        .noise = TiltPoint{.x_rad = 1e-3, .y_rad = 1e-3}}),
                 omega0_rad_s);
  REQUIRE(truth);
  double by_model = 0;
  double measured = 0;
  double in_sigmas = 0;
  constexpr int kFewerSeeds = 20;
  for (unsigned seed = 1; seed <= kFewerSeeds; ++seed) {
    const auto analysis = analyze_swing(noisy_swing(start, 20, seed), {.gravity_m_s2 = 9.8});
    INFO("seed " << seed << ": " << (analysis ? "" : analysis.error().message));
    REQUIRE(analysis);
    REQUIRE(analysis->precession);
    const Measured& found = analysis->precession->measured_rad_s;
    const double error = found.value - truth->measured_rad_s.value;
    measured += error * error;
    in_sigmas += std::pow(error / found.sigma, 2);
    by_model += std::pow(analysis->model_precession_rad_s->value - truth->measured_rad_s.value, 2);
  }
  const double rate = truth->measured_rad_s.value;
  WARN("precession " << rate << " rad/s; RMS error measured "
                     << std::sqrt(measured / kFewerSeeds) / rate << " of it, by the model "
                     << std::sqrt(by_model / kFewerSeeds) / rate << "; in sigmas "
                     << std::sqrt(in_sigmas / kFewerSeeds));
  CHECK(std::sqrt(measured / kFewerSeeds) < 0.01 * rate);
  CHECK(std::sqrt(by_model / kFewerSeeds) < 0.005 * rate);
  // scipy.stats.chi2.ppf([0.005, 0.995], 20)
  CHECK(in_sigmas > 7.43);
  CHECK(in_sigmas < 40.0);
}
