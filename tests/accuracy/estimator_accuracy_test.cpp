// SPDX-License-Identifier: Apache-2.0
// What the estimators are off by, over 50 simulated swings of 20 s with gaps off by 50 um; and
// whether what they say of their errors is true. docs/accuracy.md has the figures.
#include <Eigen/LU>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <optional>
#include <random>
#include <string_view>
#include <vector>

#include "common/swing_tracker.hpp"
#include "host/estimator/estimator.hpp"
#include "tests/unit/common/simulated_swing.hpp"
#include "tests/unit/host/scripted_source.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

constexpr std::uint64_t kSeeds = 50;
constexpr int kSamples = 400;
constexpr int kFirstSecond = 20;

/// A swing as it was and as an estimator has it, sample by sample.
struct Run {
  std::vector<SwingState<double>> truth;
  std::vector<Estimate<double>> estimates;
};

Run run(EstimatorKind kind, const Rig<double>& rig, std::uint64_t seed) {
  SimulatedSwing swing(seed, start_of(seed));
  const auto estimator = make_estimator({.kind = kind}, rig, {}).value();
  Run result;
  KeepingSink sink;
  for (int i = 0; i < kSamples; ++i) {
    result.truth.push_back(swing.state());
    REQUIRE(estimator->take(swing.next(), sink));
  }
  REQUIRE(estimator->finish(sink));
  result.estimates = sink.estimates;
  REQUIRE(result.estimates.size() == result.truth.size());
  return result;
}

/// RMS over both angles, all seeds and all samples after the first second.
double rms_deg(EstimatorKind kind, const Rig<double>& rig) {
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Run swing = run(kind, rig, seed);
    for (std::size_t i = kFirstSecond; i < kSamples; ++i) {
      const auto& [theta1, theta2] = swing.estimates[i].attitude.value().angles;
      squares += std::pow(theta1 - swing.truth[i].theta1_rad, 2) +
                 std::pow(theta2 - swing.truth[i].theta2_rad, 2);
    }
  }
  return std::sqrt(squares / (2.0 * kSeeds * (kSamples - kFirstSecond))) / from_degrees(1);
}

Rig<double> raw_rig() {
  Rig<double> rig = noisy_rig<double>();
  rig.filter = FilterDesign<double>{0, 1};
  return rig;
}

void tell(std::string_view what, double value, std::string_view unit) {
  std::cout << what << ": " << value << ' ' << unit << '\n';
}

TEST_CASE("Raw angles of gaps off by 50 um are off by 0.143 deg", "[estimators]") {
  const double rms = rms_deg(EstimatorKind::kGaussNewton, raw_rig());
  tell("raw", rms, "deg RMS");
  CHECK(rms == Approx(0.143).epsilon(0.02));
}

TEST_CASE("ekf is within 0.04 deg without lag, the smoother within 0.025", "[estimators]") {
  const double filtered = rms_deg(EstimatorKind::kKalman, noisy_rig<double>());
  const double smoothed = rms_deg(EstimatorKind::kSmoother, noisy_rig<double>());
  tell("ekf", filtered, "deg RMS");
  tell("smoother", smoothed, "deg RMS");
  CHECK(filtered <= 0.04);
  CHECK(smoothed <= 0.025);
}

TEST_CASE("With the length 2 % wrong ekf is no worse than half of raw", "[estimators]") {
  const double wrong = GENERATE(0.98, 1.02);
  Rig<double> rig = noisy_rig<double>();
  rig.pendulum.length_m *= wrong;
  const double rms = rms_deg(EstimatorKind::kKalman, rig);
  tell("ekf, length 2 % wrong", rms, "deg RMS");
  CHECK(rms <= 0.143 / 2);
}

TEST_CASE("A length 2 % wrong is learned to 0.3 % within 20 s", "[estimators]") {
  const double wrong = GENERATE(0.98, 1.02);
  Rig<double> rig = noisy_rig<double>();
  rig.pendulum.length_m *= wrong;
  Worst worst;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SimulatedSwing swing(seed, start_of(seed));
    SwingTracker<double> tracker(rig, {});
    for (int i = 0; i < kSamples; ++i) {
      tracker.update(swing.next());
    }
    worst.note(tracker.filter().length_m() / 0.3 - 1);
  }
  tell("length after 20 s, worst of 50", 100 * worst.value(), "%");
  CHECK(worst.value() < 0.003);
}

/// Swings as the filter believes them to be: length, damping and what moves the pendulum are drawn
/// from the rig's own uncertainties.
class BelievedSwing {
 public:
  BelievedSwing(std::uint64_t seed, const Rig<double>& rig) : random_(seed), rig_(rig) {
    std::normal_distribution<double> normal;
    Pendulum<double> pendulum = rig.pendulum;
    pendulum.length_m *= std::exp(rig.trust.length_share * normal(random_));
    pendulum.damping_per_s += rig.trust.damping_per_s * normal(random_);
    swing_.emplace(seed, start_of(seed), pendulum);
    swing_->disturb_by(rig.trust.acceleration_rad_s15);
  }
  [[nodiscard]] SimulatedSwing& operator*() { return *swing_; }

 private:
  std::mt19937_64 random_;
  Rig<double> rig_;
  std::optional<SimulatedSwing> swing_;
};

/// Bounds of the mean of 50 squares of two normalized errors, 95 % (scipy.stats.chi2.ppf of 0.025
/// and 0.975 with 100 degrees of freedom, over 100).
constexpr double kLeastMean = 0.7422192747492373;
constexpr double kMostMean = 1.2956119718583659;

TEMPLATE_TEST_CASE("The normalized error stays within its chi-square bounds", "[estimators]", float,
                   double) {
  // A damping that may be 0.02 off, as of a rig that was analyzed: a swing of 0.3 would grow.
  Rig<double> rig = noisy_rig<double>();
  rig.trust.damping_per_s = 0.02;
  rig.trust.damping_walk_per_s15 = 0;
  Rig<TestType> used = noisy_rig<TestType>();
  used.trust.damping_per_s = TestType(0.02);
  used.trust.damping_walk_per_s15 = 0;
  std::array<double, kSamples> sum{};
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    BelievedSwing swing(seed, rig);
    SwingTracker<TestType> tracker(used, {});
    for (std::size_t i = 0; i < kSamples; ++i) {
      const Angles<double> truth = (*swing).angles();
      tracker.update((*swing).next());
      const auto& filter = tracker.filter();
      const Eigen::Vector2d error(static_cast<double>(filter.state()[0]) - truth.theta1_rad,
                                  static_cast<double>(filter.state()[1]) - truth.theta2_rad);
      Eigen::Matrix2d covariance;
      covariance << static_cast<double>(filter.variance(0)),
          static_cast<double>(filter.covariance(0, 1)),
          static_cast<double>(filter.covariance(0, 1)), static_cast<double>(filter.variance(1));
      sum[i] += error.dot(covariance.inverse() * error) / 2;
    }
  }
  double mean = 0;
  int inside = 0;
  for (std::size_t i = kFirstSecond; i < kSamples; ++i) {
    const double of_seeds = sum[i] / kSeeds;
    mean += of_seeds / (kSamples - kFirstSecond);
    inside += of_seeds > kLeastMean && of_seeds < kMostMean ? 1 : 0;
  }
  const double share = static_cast<double>(inside) / (kSamples - kFirstSecond);
  tell("normalized error squared, mean", mean, "");
  tell("moments within the 95 % bounds", 100 * share, "%");
  CHECK(mean == Approx(1).margin(0.1));
  CHECK(share >= 0.95);
}

}  // namespace
