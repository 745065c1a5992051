// SPDX-License-Identifier: Apache-2.0
// Tests of the pipeline under faults: missing readings, breaks, saturation, and recovery from each.
#include "common/pipeline.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/common/pipeline_feed.hpp"

namespace penduline::test {
namespace {

TEMPLATE_TEST_CASE("Two sensors with one reading missing give no attitude, then fill again",
                   "[pipeline]", float, double) {
  auto feed = paper_feed<TestType>();
  feed.fill();
  Sample sample = feed.next();
  sample.missing = GENERATE(1U, 2U);
  const auto estimate = feed.push(sample);
  CHECK_FALSE(estimate.attitude.has_value());
  CHECK(estimate.flags == flag::kMissing);
  check_fills_from_here(feed);
}

TEMPLATE_TEST_CASE("With three sensors the others answer for a missing one", "[pipeline]", float,
                   double) {
  auto feed = three_sensor_feed<TestType>();
  feed.fill();
  Sample sample = feed.next();
  sample.missing = GENERATE(1U, 2U, 4U);
  const auto without = feed.push(sample);
  CHECK(without.flags == flag::kMissing);
  CHECK(error_of(without, some_tilt()) <= kCountTolerance);
  for (int i = 0; i < kTaps - 1; ++i) {
    CAPTURE(i);
    const auto estimate = feed.push();
    REQUIRE(estimate.flags == flag::kFilling);
    REQUIRE(error_of(estimate, some_tilt()) <= kCountTolerance);
  }
  CHECK(feed.push().flags == 0);
}

TEST_CASE("Three sensors with two readings missing give no attitude", "[pipeline]") {
  auto feed = three_sensor_feed<double>();
  feed.fill();
  Sample sample = feed.next();
  sample.missing = 0b101;
  CHECK_FALSE(feed.push(sample).attitude.has_value());
}

TEST_CASE("Sensors that are left on one line through the pivot give no solution", "[pipeline]") {
  // 0.1 mm beside the line, so that there would be an answer, which noise would throw about.
  const auto layout = layout_of<double>({{0.02, 0, 0}, {-0.02, 1e-4, 0}, {0, 0.02, 0}}, 0.02);
  Feed<double> feed(linear_rig(layout));
  feed.fill();
  Sample sample = feed.next();
  sample.missing = 0b100;
  const auto estimate = feed.push(sample);
  CHECK_FALSE(estimate.attitude.has_value());
  CHECK(estimate.flags == (flag::kMissing | flag::kNoSolution));
}

TEST_CASE("A missing bit of a sensor that the rig has not changes nothing", "[pipeline]") {
  auto feed = paper_feed<double>();
  feed.fill();
  Sample sample = feed.next();
  sample.missing = 0b100;
  CHECK(feed.push(sample).flags == 0);
}

TEMPLATE_TEST_CASE("After a dropout the filter starts over", "[pipeline]", float, double) {
  auto feed = paper_feed<TestType>();
  feed.fill();
  (void)feed.next();  // lost
  const auto estimate = feed.push();
  CHECK(estimate.flags == (flag::kDropout | flag::kFilling));
  CHECK_FALSE(estimate.attitude.has_value());
  for (int i = 0; i < kTaps - 2; ++i) {
    REQUIRE(feed.push().flags == flag::kFilling);
  }
  CHECK(error_of(feed.push(), some_tilt()) <= kCountTolerance);
}

TEST_CASE("After a restart the filter starts over", "[pipeline]") {
  auto feed = paper_feed<double>();
  feed.fill();
  auto restarted = paper_feed<double>();  // for its samples, which count from 0 again
  Sample sample = restarted.next();
  sample.flags = flag::kRestarted;
  const auto estimate = feed.push(sample);
  CHECK(estimate.flags == (flag::kRestarted | flag::kDropout | flag::kFilling));
  CHECK(estimate.t_us == sample.t_us - kDelay);
  CHECK_FALSE(estimate.attitude.has_value());
  CHECK(feed.push(restarted.next()).flags == flag::kFilling);
}

TEST_CASE("After a sample out of order the filter starts over", "[pipeline]") {
  auto feed = paper_feed<double>();
  feed.fill();
  Sample again = feed.next();
  again.seq = 3;
  const auto estimate = feed.push(again);
  CHECK(estimate.flags == (flag::kOutOfOrder | flag::kFilling));
  CHECK_FALSE(estimate.attitude.has_value());
}

TEST_CASE("A saturated sample is told of in every row that it goes into", "[pipeline]") {
  auto feed = paper_feed<double>();
  feed.fill();
  Sample sample = feed.next();
  sample.flags = flag::kSaturated;
  CHECK(feed.push(sample).flags == flag::kSaturated);
  for (int i = 0; i < kTaps - 1; ++i) {
    CAPTURE(i);
    REQUIRE(feed.push().flags == flag::kSaturated);
  }
  CHECK(feed.push().flags == 0);
}

TEST_CASE("A second saturated sample counts from itself", "[pipeline]") {
  auto feed = paper_feed<double>();
  feed.fill();
  int flagged = 0;
  for (int i = 0; i < 40; ++i) {
    Sample sample = feed.next();
    sample.flags = i == 0 || i == 5 ? flag::kSaturated : 0;
    flagged += (feed.push(sample).flags & flag::kSaturated) != 0 ? 1 : 0;
  }
  CHECK(flagged == 5 + kTaps);
}

TEST_CASE("A dropout puts a saturated sample out of every later row", "[pipeline]") {
  auto feed = paper_feed<double>();
  feed.fill();
  Sample sample = feed.next();
  sample.flags = flag::kSaturated;
  feed.push(sample);
  (void)feed.next();  // lost
  CHECK((feed.push().flags & flag::kSaturated) == 0);
}

TEST_CASE("The device's other flags stand in their own row only", "[pipeline]") {
  auto feed = paper_feed<double>();
  feed.fill();
  Sample sample = feed.next();
  sample.flags = flag::kOverrun;
  CHECK(feed.push(sample).flags == flag::kOverrun);
  CHECK(feed.push().flags == 0);
}

}  // namespace
}  // namespace penduline::test
