// SPDX-License-Identifier: Apache-2.0
// Tests of the Kalman filter's algebra: against the textbook's with whole matrices.
#include "common/swing_filter.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/common/simulated_swing.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

constexpr double kVariance = 50e-6 * 50e-6;

FilterTrust<double> trusting() {
  return {
      .length_share = 0.02, .damping_per_s = 0.05, .offset_m = 100e-6, .offset_walk_m_s05 = 1e-6};
}

/// A filter that has seen a second of a swing, so that all of its covariance is filled.
SwingFilter<double> after_a_second(const SensorLayout<double>& layout = paper_layout<double>()) {
  SwingFilter<double> filter(layout, {.damping_per_s = 0.01}, trusting());
  SimulatedSwing swing(1, start_of(1));
  filter.begin(swing.angles(), 0.01, 1);
  for (int i = 0; i < 20; ++i) {
    const auto gap_m = gaps_at(layout, swing.angles());
    for (std::size_t sensor = 0; sensor < layout.count; ++sensor) {
      filter.update({.sensor = sensor, .gap_m = gap_m[sensor], .variance_m2 = kVariance}, false);
    }
    static_cast<void>(swing.next());
    filter.predict(SimulatedSwing::kPeriodS, 0.01, 0.01);
  }
  return filter;
}

Eigen::MatrixXd covariance_of(const SwingFilter<double>& filter) {
  const auto states = static_cast<Eigen::Index>(filter.states());
  return Eigen::MatrixXd::NullaryExpr(states, states, [&](Eigen::Index i, Eigen::Index j) {
    return filter.covariance(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  });
}

/// The largest difference, each in units of the standard deviations that it belongs to.
double difference(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  const Eigen::VectorXd unit = expected.diagonal().cwiseSqrt().cwiseInverse();
  return (unit.asDiagonal() * (found - expected) * unit.asDiagonal()).cwiseAbs().maxCoeff();
}

TEST_CASE("A step's covariance is F P F' + Q", "[swing_filter]") {
  constexpr double kSeconds = 0.05;
  constexpr double kAcceleration = 0.4;
  SwingFilter<double> filter = after_a_second();
  const Eigen::MatrixXd before = covariance_of(filter);
  const auto transition = filter.predict(kSeconds, kAcceleration, 0.02);
  Eigen::MatrixXd f = Eigen::MatrixXd::Identity(8, 8);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      f(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = transition[i][j];
    }
  }
  // White acceleration, integrated twice over the step.
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(8, 8);
  const double power = kAcceleration * kAcceleration;
  for (Eigen::Index i = 0; i < 2; ++i) {
    q(i, i) = power * std::pow(kSeconds, 3) / 3;
    q(i, i + 2) = q(i + 2, i) = power * kSeconds * kSeconds / 2;
    q(i + 2, i + 2) = power * kSeconds;
    q(i + 6, i + 6) = 1e-6 * 1e-6 * kSeconds;
  }
  q(5, 5) = 0.02 * 0.02 * kSeconds;
  CHECK(difference(covariance_of(filter), f * before * f.transpose() + q) < 1e-12);
}

TEST_CASE("The transition is that of the filter's own differences, length and damping too",
          "[swing_filter]") {
  const Pendulum<double> pendulum{.length_m = 0.3, .damping_per_s = 0.2};
  const auto stepped_state = [&](double log_length, double damping) {
    Pendulum<double> other = pendulum;
    other.length_m *= std::exp(log_length);
    other.damping_per_s += damping;
    SwingFilter<double> filter(paper_layout<double>(), other, trusting());
    filter.begin({0.2, -0.1}, 0.01, 1);
    filter.predict(0.05, 0.1, 0.1);
    return filter.state();
  };
  SwingFilter<double> filter(paper_layout<double>(), pendulum, trusting());
  filter.begin({0.2, -0.1}, 0.01, 1);
  const auto transition = filter.predict(0.05, 0.1, 0.1);
  constexpr double kStep = 1e-5;
  for (std::size_t i = 0; i < 4; ++i) {
    const double by_length =
        (stepped_state(kStep, 0)[i] - stepped_state(-kStep, 0)[i]) / (2 * kStep);
    const double by_damping =
        (stepped_state(0, kStep)[i] - stepped_state(0, -kStep)[i]) / (2 * kStep);
    CHECK(transition[i][4] == Approx(by_length).margin(1e-8));
    CHECK(transition[i][5] == Approx(by_damping).margin(1e-8));
  }
}

TEST_CASE("A measurement's update is the textbook's", "[swing_filter]") {
  const std::size_t sensor = GENERATE(0U, 1U);
  SwingFilter<double> filter = after_a_second();
  const Eigen::MatrixXd before = covariance_of(filter);
  const auto state = filter.state();
  const auto expected = gap_gradient<double>(paper_layout<double>(), sensor, {state[0], state[1]});
  Eigen::VectorXd h = Eigen::VectorXd::Zero(8);
  h[0] = expected.by_theta1_m;
  h[1] = expected.by_theta2_m;
  h[6 + static_cast<Eigen::Index>(sensor)] = 1;
  const double misfit = 20e-6;
  const double gap_m = expected.gap_m + state[6 + sensor] + misfit;
  const double variance = h.dot(before * h) + kVariance;
  const GapMeasurement<double> measured{sensor, gap_m, kVariance};
  CHECK(filter.innovation(measured).misfit_m == Approx(misfit).epsilon(1e-9));
  CHECK(filter.innovation(measured).variance_m2 == Approx(variance).epsilon(1e-12));
  filter.update(measured, false);
  const Eigen::VectorXd gain = before * h / variance;
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(filter.state()[i] ==
          Approx(state[i] + gain[static_cast<Eigen::Index>(i)] * misfit).margin(1e-12));
  }
  CHECK(difference(covariance_of(filter), before - gain * variance * gain.transpose()) < 1e-10);
}

TEST_CASE("With the motion only, what is known of the pendulum stays as it is", "[swing_filter]") {
  SwingFilter<double> filter = after_a_second();
  const auto before = filter.state();
  const double length_variance = filter.variance(4);
  filter.update({0, gaps_at(paper_layout<double>(), {before[0], before[1]})[0] + 1e-3, kVariance},
                true);
  for (std::size_t i = 4; i < 8; ++i) {
    CHECK(filter.state()[i] == before[i]);
  }
  CHECK(filter.variance(4) == Approx(length_variance).epsilon(1e-12));
  CHECK(filter.state()[1] != before[1]);
}

TEST_CASE("A measurement far off is taken where its curve says, not its tangent",
          "[swing_filter]") {
  // Nothing known but one angle: the gap under Sx alone then gives theta2.
  const SensorLayout<double> layout = paper_layout<double>();
  SwingFilter<double> filter(layout, {}, {.length_share = 0, .damping_per_s = 0});
  filter.begin({0, 0}, 1, 1);
  const Angles<double> truth{0, from_degrees(25)};
  for (const std::size_t sensor : {0U, 1U}) {
    filter.update({sensor, gaps_at(layout, truth)[sensor], 1e-12}, false);
  }
  CHECK(filter.state()[1] == Approx(truth.theta2_rad).margin(from_degrees(0.2)));
}

TEST_CASE("The covariance stays symmetric and positive over an hour", "[swing_filter]") {
  SwingFilter<float> filter(paper_layout<float>(), {.damping_per_s = 0.01F}, {});
  SimulatedSwing swing(1, start_of(1));
  filter.begin({static_cast<float>(swing.angles().theta1_rad),
                static_cast<float>(swing.angles().theta2_rad)},
               0.1F, 1);
  for (int i = 0; i < 72'000; ++i) {
    const auto gap_m = gaps_at(paper_layout<double>(), swing.angles());
    filter.update({0, static_cast<float>(gap_m[0]), 1e-10F}, false);
    filter.update({1, static_cast<float>(gap_m[1]), 1e-10F}, false);
    static_cast<void>(swing.next());
    filter.predict(0.05F, 0.002F, 0.005F);
  }
  Eigen::MatrixXf covariance(6, 6);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      CHECK(filter.covariance(i, j) == filter.covariance(j, i));
      covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          filter.covariance(i, j);
    }
  }
  const Eigen::VectorXf unit = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXf correlation = unit.asDiagonal() * covariance * unit.asDiagonal();
  CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf>(correlation).eigenvalues()[0] > -1e-4F);
  CHECK(filter.state()[0] == Approx(swing.angles().theta1_rad).margin(1e-3));
}

}  // namespace
}  // namespace penduline::test
