// SPDX-License-Identifier: Apache-2.0
// Tests of the estimator ekf: how it starts, what it makes of missing and stray readings, pauses,
// kicks and hands.
#include "common/swing_tracker.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/unit/common/simulated_swing.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

/// A tracker that sees a swing from its start.
class Followed {
 public:
  explicit Followed(std::uint64_t seed = 1, const Rig<double>& rig = noisy_rig<double>())
      : swing_(seed, start_of(seed)), tracker_(rig, {}) {}

  [[nodiscard]] SimulatedSwing& swing() { return swing_; }
  Estimate<double> push() {
    return push_with([](Sample&) {});
  }
  template <class Spoil>
  Estimate<double> push_with(const Spoil& spoil) {
    const Angles<double> truth = swing_.angles();
    Sample sample = swing_.next();
    spoil(sample);
    Estimate<double> estimate = tracker_.update(sample);
    error_rad_ = NAN;
    if (estimate.attitude) {
      const auto& [theta1, theta2] = estimate.attitude->angles;
      error_rad_ = std::hypot(theta1 - truth.theta1_rad, theta2 - truth.theta2_rad);
    }
    return estimate;
  }
  Estimate<double> push_for(double seconds) {
    Estimate<double> estimate = push();
    for (int i = 1; i < seconds / SimulatedSwing::kPeriodS; ++i) {
      estimate = push();
    }
    return estimate;
  }
  /// Of both angles, of the last sample.
  [[nodiscard]] double error_deg() const { return error_rad_ / from_degrees(1); }
  [[nodiscard]] const SwingFilter<double>& filter() const { return tracker_.filter(); }

 private:
  SimulatedSwing swing_;
  SwingTracker<double> tracker_;
  double error_rad_ = NAN;
};

TEST_CASE("The first sample gives the closed form's angles, rates unknown", "[swing_tracker]") {
  Followed followed;
  const auto estimate = followed.push();
  REQUIRE(estimate.attitude);
  CHECK(followed.error_deg() < 0.5);
  CHECK(estimate.omega_rad_s->first == Approx(0).margin(1e-3));
  CHECK(estimate.sigma_rad->first < from_degrees(0.3));
  CHECK(estimate.flags == 0);
}

TEST_CASE("Each estimate is of its own sample's moment", "[swing_tracker]") {
  Followed followed;
  CHECK(followed.push().t_us == 50'000);
  const auto estimate = followed.push();
  CHECK(estimate.t_us == 100'000);
  CHECK(estimate.seq == 1);
}

TEST_CASE("Until gaps have a solution there are no angles, and that is said", "[swing_tracker]") {
  Followed followed;
  const auto lacking = followed.push_with([](Sample& sample) { sample.missing = 1; });
  CHECK_FALSE(lacking.attitude);
  CHECK(lacking.flags == (flag::kMissing | flag::kNoSolution));
  CHECK(followed.push().attitude);
}

TEST_CASE("With one sensor gone its angle lives on the motion, less sure each time",
          "[swing_tracker]") {
  Followed followed;
  const auto before = followed.push_for(10);
  Estimate<double> estimate;
  for (int i = 0; i < 20; ++i) {
    estimate = followed.push_with([](Sample& sample) { sample.missing = 1; });
    CHECK(estimate.flags == flag::kMissing);
    CHECK(followed.error_deg() < 0.15);
  }
  CHECK(estimate.sigma_rad->second > before.sigma_rad->second);
}

TEST_CASE("A pause is bridged by the motion and flagged", "[swing_tracker]") {
  Followed followed;
  const auto before = followed.push_for(10);
  for (int i = 0; i < 40; ++i) {
    followed.swing().lose();
  }
  const auto blind = followed.push_with([](Sample& sample) { sample.missing = 3; });
  CHECK(blind.flags == (flag::kDropout | flag::kMissing));
  CHECK(followed.error_deg() < 0.2);
  CHECK(blind.sigma_rad->first > before.sigma_rad->first);
  CHECK_FALSE(blind.residual_m);
}

TEST_CASE("A saturated sample is not used", "[swing_tracker]") {
  Followed followed;
  followed.push_for(5);
  const auto estimate = followed.push_with([](Sample& sample) {
    sample.readings[0].on += 6000;
    sample.flags = flag::kSaturated;
  });
  CHECK(estimate.flags == flag::kSaturated);
  CHECK(followed.error_deg() < 0.15);
}

TEST_CASE("A stray reading is left out and flagged", "[swing_tracker]") {
  Followed followed;
  followed.push_for(5);
  const auto estimate = followed.push_with([](Sample& sample) { sample.readings[0].on += 3000; });
  CHECK(estimate.flags == flag::kStray);
  CHECK(followed.error_deg() < 0.15);
  CHECK(followed.push().flags == 0);
}

TEST_CASE("A kick is noticed and followed within a second", "[swing_tracker]") {
  const std::uint64_t seed = GENERATE(range(std::uint64_t{1}, std::uint64_t{11}));
  Followed followed(seed);
  followed.push_for(8);
  followed.swing().kick(0.6, -0.4);
  Flags seen = 0;
  for (int i = 0; i < 20; ++i) {
    seen |= followed.push().flags;
  }
  CHECK((seen & flag::kDisturbed) != 0);
  double squares = 0;
  for (int i = 0; i < 20; ++i) {
    followed.push();
    squares += followed.error_deg() * followed.error_deg() / 2;
  }
  CHECK(std::sqrt(squares / 20) < 0.15);
  const double length_m = followed.filter().length_m();
  CHECK(length_m == Approx(0.3).epsilon(0.003));
}

TEST_CASE("A pendulum that is held is followed as well as raw angles would", "[swing_tracker]") {
  const std::uint64_t seed = GENERATE(range(std::uint64_t{1}, std::uint64_t{11}));
  Followed followed(seed);
  followed.push_for(8);
  const Angles<double> hand{0.12, 0.05};
  double squares = 0;
  for (int i = 0; i < 60; ++i) {
    followed.swing().hold(hand);
    followed.push();
    squares += i < 20 ? 0 : followed.error_deg() * followed.error_deg() / 2;
  }
  CHECK(std::sqrt(squares / 40) < 0.25);
  followed.push_for(2);
  CHECK(followed.error_deg() < 0.3);
}

TEST_CASE("A board that starts anew begins the filter anew", "[swing_tracker]") {
  Followed followed;
  const auto before = followed.push_for(5);
  const auto estimate = followed.push_with([](Sample& sample) { sample.flags = flag::kRestarted; });
  CHECK((estimate.flags & flag::kRestarted) != 0);
  CHECK(estimate.sigma_rad->first > 2 * before.sigma_rad->first);
}

TEST_CASE("Samples out of order begin the filter anew", "[swing_tracker]") {
  Followed followed;
  followed.push_for(5);
  const auto estimate = followed.push_with([](Sample& sample) { sample.t_us = 1; });
  CHECK(estimate.flags == flag::kOutOfOrder);
  CHECK(followed.error_deg() < 0.5);
}

TEST_CASE("Readings that no pendulum gives end in no row beyond what can hang", "[swing_tracker]") {
  std::mt19937_64 random(1);
  SwingTracker<double> tracker(noisy_rig<double>(), {});
  for (std::uint64_t i = 0; i < 5000; ++i) {
    Sample sample{.seq = i, .t_us = static_cast<std::int64_t>(i + 1) * 50'000};
    sample.readings[0].on = static_cast<std::int32_t>(random() % 65536);
    sample.readings[1].on = static_cast<std::int32_t>(random() % 65536);
    const auto estimate = tracker.update(sample);
    if (estimate.attitude) {
      CHECK(std::abs(estimate.attitude->angles.theta1_rad) < 1.5);
      CHECK(std::abs(estimate.attitude->angles.theta2_rad) < 1.5);
      CHECK(estimate.sigma_rad->first >= 0);
    } else {
      CHECK((estimate.flags & flag::kNoSolution) != 0);
    }
  }
}

TEST_CASE("Of three sensors one may be dead from the start", "[swing_tracker]") {
  Rig<double> rig = linear_rig(three_sensor_layout<double>());
  SwingTracker<double> tracker(rig, {.sensor_count = 3});
  const Angles<double> tilt{from_degrees(5), from_degrees(-3)};
  Sample sample = sample_of(0, gaps_at(rig.layout, tilt));
  sample.missing = 4;
  const auto estimate = tracker.update(sample);
  REQUIRE(estimate.attitude);
  CHECK(estimate.attitude->angles.theta1_rad == Approx(tilt.theta1_rad).margin(1e-3));
}

TEST_CASE("In float the tracker finds what it does in double", "[swing_tracker]") {
  SimulatedSwing swing(3, start_of(3));
  SwingTracker<double> wide(noisy_rig<double>(), {});
  SwingTracker<float> narrow(noisy_rig<float>(), {});
  Worst angles;
  Worst sigmas;
  for (int i = 0; i < 1200; ++i) {
    const Sample sample = swing.next();
    const auto expected = wide.update(sample);
    const auto found = narrow.update(sample);
    angles.note(static_cast<double>(found.attitude->angles.theta1_rad) -
                expected.attitude->angles.theta1_rad);
    angles.note(static_cast<double>(found.attitude->angles.theta2_rad) -
                expected.attitude->angles.theta2_rad);
    sigmas.note(static_cast<double>(found.sigma_rad->first) / expected.sigma_rad->first - 1);
  }
  CHECK(angles.value() < from_degrees(0.001));
  CHECK(sigmas.value() < 0.01);
}

TEST_CASE("At 5 Hz a swing is followed as well", "[swing_tracker]") {
  // The simulated swing has 20 samples a second: every fourth makes 5 Hz.
  SimulatedSwing swing(2, start_of(2));
  SwingTracker<double> tracker(noisy_rig<double>(), {.rate_hz = 5});
  Worst worst;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Angles<double> truth = swing.angles();
    Sample sample = swing.next();
    sample.seq /= 4;
    if (i % 4 == 0) {
      const auto estimate = tracker.update(sample);
      CHECK(estimate.flags == 0);
      if (i > 80) {
        worst.note(estimate.attitude->angles.theta1_rad - truth.theta1_rad);
      }
    }
  }
  CHECK(worst.value() < from_degrees(0.3));
}

}  // namespace
}  // namespace penduline::test
