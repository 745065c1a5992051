// SPDX-License-Identifier: Apache-2.0
// Tests of the pipeline: a constant tilt comes out, and the flags of gaps and of the inverse.
#include "common/pipeline.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "tests/unit/common/pipeline_feed.hpp"

namespace penduline::test {
namespace {

TEMPLATE_TEST_CASE("A constant tilt comes out once the filter is full", "[pipeline]", float,
                   double) {
  auto feed = paper_feed<TestType>();
  const auto estimate = feed.fill();
  REQUIRE(estimate.attitude.has_value());
  CHECK(error_of(estimate, some_tilt()) <= kCountTolerance);
  CHECK(estimate.flags == 0);
}

TEMPLATE_TEST_CASE("The mass hangs at the rod's length along its direction", "[pipeline]", float,
                   double) {
  const auto estimate = paper_feed<TestType>().fill();
  const Vector3<double> expected = 0.3 * rod_at(some_tilt());
  CHECK((estimate.attitude.value().mass_m.template cast<double>() - expected).norm() <=
        0.3 * kCountTolerance);
}

TEMPLATE_TEST_CASE("While the filter fills rows have no attitude and say so", "[pipeline]", float,
                   double) {
  auto feed = paper_feed<TestType>();
  check_fills_from_here(feed);
}

TEST_CASE("A row without an attitude has no residual either", "[pipeline]") {
  CHECK_FALSE(paper_feed<double>().push().residual_m.has_value());
}

TEST_CASE("Every row refers to 7.5 periods before its newest sample", "[pipeline]") {
  auto feed = paper_feed<double>();
  for (int i = 0; i < 40; ++i) {
    const Sample sample = feed.next();
    CAPTURE(i);
    REQUIRE(feed.push(sample).t_us == sample.t_us - kDelay);
  }
}

TEST_CASE("Every row has its newest sample's number", "[pipeline]") {
  auto feed = paper_feed<double>();
  for (std::uint64_t seq = 0; seq < 40; ++seq) {
    REQUIRE(feed.push().seq == seq);
  }
}

TEST_CASE("Light that falls on the sensors either way changes nothing", "[pipeline]") {
  auto dark = paper_feed<double>();
  auto lit = paper_feed<double>();
  for (int i = 0; i < kTaps; ++i) {
    const auto expected = dark.push();
    Sample sample = lit.next();
    for (Reading& reading : sample.readings) {
      reading.on += 1000 + i;
      reading.off += 1000 + i;
    }
    const auto estimate = lit.push(sample);
    REQUIRE(estimate.attitude.has_value() == (i == kTaps - 1));
    if (estimate.attitude) {
      CHECK(estimate.attitude->mass_m == expected.attitude->mass_m);
    }
  }
}

TEST_CASE("With a filter of order 0 the first row has an attitude at its own time", "[pipeline]") {
  auto rig = linear_rig(paper_layout<double>());
  rig.filter = FilterDesign<double>{};
  Feed<double> feed(rig);
  const auto estimate = feed.push();
  REQUIRE(estimate.attitude.has_value());
  CHECK(estimate.flags == 0);
  CHECK(estimate.t_us == 50'000);
}

TEST_CASE("A rig without a filter gets the default one", "[pipeline]") {
  auto rig = linear_rig(paper_layout<double>());
  rig.filter.reset();
  const std::size_t taps = default_filter(20.0, small_swing_hz(rig.pendulum)).order + 1;
  Feed<double> feed(rig);
  for (std::size_t i = 1; i < taps; ++i) {
    REQUIRE_FALSE(feed.push().attitude.has_value());
  }
  CHECK(feed.push().attitude.has_value());
}

TEST_CASE("A gap outside its response's range is flagged and still answered", "[pipeline]") {
  auto rig = linear_rig(paper_layout<double>());
  rig.responses[1].farthest_m = 0.015;
  const auto estimate = Feed<double>(rig).fill();
  CHECK(estimate.flags == flag::kOutOfRange);
  CHECK(error_of(estimate, some_tilt()) <= kCountTolerance);
}

TEST_CASE("One sample out of range is told of in every row that it goes into", "[pipeline]") {
  auto rig = linear_rig(paper_layout<double>());
  rig.responses[1].farthest_m = 0.03;
  Feed<double> feed(rig);
  feed.fill();
  Sample sample = feed.next();
  sample.readings[1] = {};  // no light: 31 mm
  CHECK(feed.push(sample).flags == flag::kOutOfRange);
  for (int i = 0; i < kTaps - 1; ++i) {
    CAPTURE(i);
    REQUIRE(feed.push().flags == flag::kOutOfRange);
  }
  CHECK(feed.push().flags == 0);
}

TEST_CASE("A gap nearer than its response's peak is flagged and still answered", "[pipeline]") {
  auto rig = linear_rig(paper_layout<double>());
  rig.responses[0].peak_m = 0.028;
  const auto estimate = Feed<double>(rig).fill();
  CHECK(estimate.flags == flag::kFolded);
  CHECK(estimate.attitude.has_value());
}

TEST_CASE("A beam that misses the disc is out of range", "[pipeline]") {
  auto rig = linear_rig(paper_layout<double>());
  rig.disc_diameter_m = 0.034;
  CHECK(Feed<double>(rig).fill().flags == flag::kOutOfRange);
}

TEST_CASE("A signal that belongs to no gap leaves no attitude", "[pipeline]") {
  auto rig = linear_rig(paper_layout<double>());
  rig.responses[0].model = InverseSquareResponse<double>{.a_v_m2 = 2e-4, .b_m = 0.004, .c_v = 3.3};
  const auto estimate = Feed<double>(rig).fill();
  CHECK_FALSE(estimate.attitude.has_value());
  CHECK(estimate.flags == flag::kOutOfRange);
}

TEMPLATE_TEST_CASE("Gaps that no tilt gives have no attitude, and the next good ones have",
                   "[pipeline]", float, double) {
  auto feed = paper_feed<TestType>();
  const auto estimate = feed.fill_with({0.013, 0.013});
  CHECK_FALSE(estimate.attitude.has_value());
  CHECK_FALSE(estimate.residual_m.has_value());
  CHECK(estimate.flags == flag::kNoSolution);
  CHECK(error_of(feed.fill(), some_tilt()) <= kCountTolerance);
}

TEMPLATE_TEST_CASE("Near the singular line the answer is flagged", "[pipeline]", float, double) {
  // On the diagonal A = B at 38 degrees: conditioning 1 - sqrt(2) sin(38 deg) = 0.13.
  const double slope = std::tan(from_degrees(38)) / std::sqrt(2.0);
  const auto estimate = paper_feed<TestType>().fill(angles_of(Slopes<double>{slope, slope}));
  CHECK(estimate.attitude.has_value());
  CHECK(estimate.flags == flag::kIllConditioned);
}

TEST_CASE("The residual tells how far three sensors disagree", "[pipeline]") {
  auto feed = three_sensor_feed<double>();
  auto gap_m = gaps_at(three_sensor_layout<double>(), {});
  gap_m[0] += 30e-6;
  // At rest under three sensors 120 degrees apart no tilt mends the mean: 10 um in each.
  CHECK_THAT(feed.fill_with(gap_m).residual_m.value(), Catch::WithinAbs(10e-6, 3e-7));
}

TEST_CASE("Float and double agree to 2e-6 rad over a swing", "[pipeline]") {
  auto narrow = paper_feed<float>();
  auto wide = paper_feed<double>();
  Worst worst;
  int answered = 0;
  for (int i = 0; i < 400; ++i) {
    const double phase = 2 * std::numbers::pi * 0.9096 * 0.05 * i;
    const Sample sample =
        wide.next({from_degrees(14) * std::cos(phase), from_degrees(11) * std::sin(phase)});
    const auto expected = wide.push(sample);
    const auto estimate = narrow.push(sample);
    REQUIRE(estimate.flags == expected.flags);
    REQUIRE(estimate.t_us == expected.t_us);
    REQUIRE(estimate.attitude.has_value() == expected.attitude.has_value());
    if (expected.attitude) {
      worst.note(error_of(estimate, expected.attitude->angles));
      ++answered;
    }
  }
  CHECK(answered == 400 - 15);
  CHECK(worst.value() <= 2e-6);
}

}  // namespace
}  // namespace penduline::test
