// SPDX-License-Identifier: Apache-2.0
// Tests of the smoother: its rows, its memory, starts anew; against least squares over all samples.
#include "host/estimator/smoother.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "host/fit/swing_path.hpp"
#include "tests/unit/common/simulated_swing.hpp"
#include "tests/unit/host/scripted_source.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

std::vector<Sample> samples_of(SimulatedSwing& swing, int count) {
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    samples.push_back(swing.next());
  }
  return samples;
}

std::vector<Estimate<double>> smoothed(const std::vector<Sample>& samples,
                                       const Rig<double>& rig = noisy_rig<double>()) {
  Smoother smoother(rig, {});
  KeepingSink sink;
  for (const Sample& sample : samples) {
    REQUIRE(smoother.take(sample, sink));
  }
  REQUIRE(smoother.finish(sink));
  return sink.estimates;
}

double theta1(const Estimate<double>& estimate) {
  return estimate.attitude.value().angles.theta1_rad;
}

TEST_CASE("Each sample has its smoothed row, in order", "[smoother]") {
  SimulatedSwing swing(1, start_of(1));
  const auto samples = samples_of(swing, 1700);
  const auto rows = smoothed(samples);
  REQUIRE(rows.size() == samples.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(rows[i].seq == i);
    CHECK(rows[i].t_us == samples[i].t_us);
    CHECK(rows[i].sigma_rad->first < from_degrees(0.2));
  }
}

TEST_CASE("The last row is the filter's, all others are surer than it", "[smoother]") {
  SimulatedSwing swing(1, start_of(1));
  const auto samples = samples_of(swing, 300);
  const auto rows = smoothed(samples);
  SwingTracker<double> tracker(noisy_rig<double>(), {});
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto filtered = tracker.update(samples[i]);
    if (i + 1 == samples.size()) {
      CHECK(theta1(rows[i]) == theta1(filtered));
      CHECK(rows[i].sigma_rad->first == filtered.sigma_rad->first);
    } else {
      CHECK(rows[i].sigma_rad->first < filtered.sigma_rad->first);
    }
  }
}

TEST_CASE("Without any noise of the motion the smoother is least squares over all samples",
          "[smoother]") {
  // Only the start is unknown, so its four numbers and their covariance follow from one linear
  // system, Jacobians by differences of the path.
  Rig<double> rig = noisy_rig<double>();
  rig.trust = {.length_share = 0,
               .damping_per_s = 0,
               .acceleration_rad_s15 = 1e-9,
               .damping_walk_per_s15 = 0};
  const SwingState<double> start{.theta1_rad = 0.03, .theta2_rad = -0.02, .omega1_rad_s = 0.1};
  SimulatedSwing swing(1, start);
  constexpr int kCount = 200;
  const auto samples = samples_of(swing, kCount);
  const auto rows = smoothed(samples, rig);

  std::vector<double> times_s;
  for (int i = 0; i < kCount; ++i) {
    times_s.push_back(0.05 * i);
  }
  const FreeSwing free{.stiffness_1_s2 = 9.8 / 0.3, .friction = {.linear_per_s = 0.01}};
  Flags flags = 0;
  const auto misfits = [&](const Eigen::Vector4d& from) {
    const auto path = swing_path(free, {from[0], from[1], from[2], from[3]}, times_s);
    Eigen::VectorXd result(2 * kCount);
    for (int i = 0; i < kCount; ++i) {
      const auto& state = path[static_cast<std::size_t>(i)];
      const auto expected = gaps_at(rig.layout, {state.theta1_rad, state.theta2_rad});
      const auto measured = measure_gaps(rig, {}, samples[static_cast<std::size_t>(i)], flags);
      result[2 * i] = (measured.gap[0].gap_m - expected[0]) / 50e-6;
      result[2 * i + 1] = (measured.gap[1].gap_m - expected[1]) / 50e-6;
    }
    return result;
  };
  Eigen::Vector4d at(start.theta1_rad, start.theta2_rad, start.omega1_rad_s, start.omega2_rad_s);
  Eigen::MatrixXd jacobian(2 * kCount, 4);
  for (int round = 0; round < 3; ++round) {
    for (Eigen::Index j = 0; j < 4; ++j) {
      const Eigen::Vector4d step = 1e-5 * Eigen::Vector4d::Unit(j);
      jacobian.col(j) = (misfits(at + step) - misfits(at - step)) / 2e-5;
    }
    at -= jacobian.colPivHouseholderQr().solve(misfits(at));
  }
  const Eigen::Matrix4d covariance = (jacobian.transpose() * jacobian).inverse();
  // The filter linearized its first steps where little was known yet.
  const double sigma1 = std::sqrt(covariance(0, 0));
  CHECK(rows[0].sigma_rad->first == Approx(sigma1).epsilon(0.01));
  CHECK(rows[0].sigma_rad->second == Approx(std::sqrt(covariance(1, 1))).epsilon(0.01));
  CHECK(std::abs(theta1(rows[0]) - at[0]) < 0.25 * sigma1);
  CHECK(std::abs(rows[0].omega_rad_s->first - at[2]) < 0.25 * std::sqrt(covariance(2, 2)));
}

TEST_CASE("What comes more than 20 s later changes a row by less than its sigma's hundredth",
          "[smoother]") {
  SimulatedSwing swing(1, start_of(1));
  auto samples = samples_of(swing, 2400);
  const auto whole = smoothed(samples);
  samples.resize(1100);
  const auto less = smoothed(samples);
  for (std::size_t i = 0; i < 600; ++i) {
    CHECK(std::abs(theta1(whole[i]) - theta1(less[i])) < 0.01 * whole[i].sigma_rad->first);
  }
}

TEST_CASE("Rows are handed on while samples still come", "[smoother]") {
  SimulatedSwing swing(1, start_of(1));
  Smoother smoother(noisy_rig<double>(), {});
  KeepingSink sink;
  for (int i = 0; i < 2400; ++i) {
    REQUIRE(smoother.take(swing.next(), sink));
    CHECK(sink.estimates.size() + 801 > static_cast<std::size_t>(i));
  }
}

TEST_CASE("At most 40 000 samples wait, however many there are in 40 s", "[smoother]") {
  // 10 kHz, of a pendulum at rest: 40 s would be 400 000.
  SimulatedSwing still(1, {});
  Sample sample = still.next(0);
  Smoother smoother(noisy_rig<double>(), {.rate_hz = 10'000});
  KeepingSink sink;
  for (std::size_t i = 0; i < 50'000; ++i) {
    sample.seq = i;
    sample.t_us = 100 * static_cast<std::int64_t>(i);
    REQUIRE(smoother.take(sample, sink));
    REQUIRE(i + 1 - sink.estimates.size() < Smoother::kMostSteps);
  }
  CHECK(sink.estimates.size() == 20'000);
  REQUIRE(smoother.finish(sink));
  REQUIRE(sink.estimates.size() == 50'000);
  CHECK(sink.estimates.back().seq == 49'999);
}

TEST_CASE("Nothing is smoothed across a board's new start", "[smoother]") {
  SimulatedSwing swing(1, start_of(1));
  auto samples = samples_of(swing, 100);
  SimulatedSwing other(2, start_of(2));
  auto after = samples_of(other, 100);
  after[0].flags = flag::kRestarted;
  const auto alone = smoothed(samples);
  samples.insert(samples.end(), after.begin(), after.end());
  const auto both = smoothed(samples);
  REQUIRE(both.size() == 200);
  for (std::size_t i = 0; i < 100; ++i) {
    CHECK(theta1(both[i]) == theta1(alone[i]));
  }
  CHECK((both[100].flags & flag::kRestarted) != 0);
}

TEST_CASE("Rows without an answer keep their place", "[smoother]") {
  SimulatedSwing swing(1, start_of(1));
  auto samples = samples_of(swing, 10);
  samples[0].missing = 1;
  samples[1].missing = 2;
  const auto rows = smoothed(samples);
  REQUIRE(rows.size() == 10);
  CHECK_FALSE(rows[0].attitude);
  CHECK_FALSE(rows[1].attitude);
  CHECK(rows[1].seq == 1);
  CHECK(rows[2].attitude);
}

}  // namespace
