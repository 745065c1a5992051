// SPDX-License-Identifier: Apache-2.0
// A pipeline with a stream of samples before it, for the tests of the pipeline.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>

#include "common/pipeline.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {

inline constexpr int kTaps = 16;
inline constexpr std::int64_t kDelay = 375'000;  ///< 7.5 periods of 50 ms, in microseconds

inline Angles<double> some_tilt() {
  return {from_degrees(8), from_degrees(-6)};
}

/// A pipeline and its samples, one tilt each, numbered from 0.
template <class Scalar>
class Feed {
 public:
  explicit Feed(const Rig<Scalar>& rig)
      : layout_(widened(rig.layout)),
        pipeline_(rig, Acquisition<Scalar>{.sensor_count = rig.layout.count}) {}

  /// The next sample, which may still be spoilt before it goes in.
  [[nodiscard]] Sample next(const Angles<double>& angles = some_tilt()) {
    return next_with(gaps_at(layout_, angles));
  }
  [[nodiscard]] Sample next_with(const std::array<double, kMaxSensors>& gap_m) {
    return sample_of(seq_++, gap_m);
  }
  Estimate<Scalar> push(const Sample& sample) { return pipeline_.update(sample); }
  Estimate<Scalar> push() { return push(next()); }

  /// As many samples as fill the filter, and the last one's estimate.
  Estimate<Scalar> fill(const Angles<double>& angles = some_tilt()) {
    for (int i = 0; i < kTaps - 1; ++i) {
      push(next(angles));
    }
    return push(next(angles));
  }
  Estimate<Scalar> fill_with(const std::array<double, kMaxSensors>& gap_m) {
    for (int i = 0; i < kTaps - 1; ++i) {
      push(next_with(gap_m));
    }
    return push(next_with(gap_m));
  }

 private:
  SensorLayout<double> layout_;
  Pipeline<Scalar> pipeline_;
  std::uint64_t seq_ = 0;
};

template <class Scalar>
Feed<Scalar> paper_feed() {
  return Feed<Scalar>(linear_rig(paper_layout<Scalar>()));
}

template <class Scalar>
Feed<Scalar> three_sensor_feed() {
  return Feed<Scalar>(linear_rig(three_sensor_layout<Scalar>()));
}

template <class Scalar>
double error_of(const Estimate<Scalar>& estimate, const Angles<double>& expected) {
  return std::hypot(double{estimate.attitude.value().angles.theta1_rad} - expected.theta1_rad,
                    double{estimate.attitude.value().angles.theta2_rad} - expected.theta2_rad);
}

// Half a count is 0.15 um, over 2 cm and a conditioning of 0.76: 1e-5 rad a sensor.
inline constexpr double kCountTolerance = 3e-5;

/// The filter is empty before this row: 15 more without an attitude, then one with.
template <class Scalar>
void check_fills_from_here(Feed<Scalar>& feed) {
  for (int i = 0; i < kTaps - 1; ++i) {
    CAPTURE(i);
    const auto estimate = feed.push();
    REQUIRE_FALSE(estimate.attitude.has_value());
    REQUIRE(estimate.flags == flag::kFilling);
  }
  const auto estimate = feed.push();
  CHECK(estimate.flags == 0);
  CHECK(error_of(estimate, some_tilt()) <= kCountTolerance);
}

}  // namespace penduline::test
