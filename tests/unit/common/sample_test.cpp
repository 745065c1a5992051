// SPDX-License-Identifier: Apache-2.0
// Tests of a sample: which readings it has, and the volts that a reading means.
#include "common/sample.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>

#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

TEST_CASE("A sample has every reading unless it says that one is missing", "[sample]") {
  const Sample sample{.missing = 0b1000'0010};
  for (std::size_t sensor = 0; sensor < kMaxSensors; ++sensor) {
    CAPTURE(sensor);
    CHECK(sample.has_reading(sensor) == (sensor != 1 && sensor != 7));
  }
}

TEMPLATE_TEST_CASE("Full scale is the reference voltage", "[sample]", float, double) {
  CHECK_THAT(signal_v(Reading{.on = 65535}, Acquisition<TestType>{}),
             Catch::WithinAbs(3.3, tolerance<TestType>(1e-15, 4e-7)));
}

TEMPLATE_TEST_CASE("A signal is what the emitter adds to the ambient light", "[sample]", float,
                   double) {
  // (30000 - 10000) / 50000 * 2.5 V
  const Acquisition<TestType> acquisition{.full_scale_counts = 50000, .reference_v = TestType(2.5)};
  CHECK_THAT(signal_v(Reading{30000, 10000}, acquisition),
             Catch::WithinAbs(1.0, tolerance<TestType>(1e-15, 2e-7)));
}

TEST_CASE("A signal below the ambient light is negative", "[sample]") {
  CHECK(signal_v(Reading{100, 102}, Acquisition<double>{}) < 0);
}

TEMPLATE_TEST_CASE("The farthest counts of 32 bits do not wrap round", "[sample]", float, double) {
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  const Acquisition<TestType> one_to_one{.full_scale_counts = 1, .reference_v = 1};
  CHECK(signal_v(Reading{kMost, kLeast}, one_to_one) == static_cast<TestType>(4294967295.0));
  CHECK(signal_v(Reading{kLeast, kMost}, one_to_one) == static_cast<TestType>(-4294967295.0));
}

TEMPLATE_TEST_CASE("The nominal period is rounded to the microsecond", "[sample]", float, double) {
  CHECK(Acquisition<TestType>{.rate_hz = 20}.period_us() == 50'000);
  CHECK(Acquisition<TestType>{.rate_hz = 30}.period_us() == 33'333);
  CHECK(Acquisition<TestType>{.rate_hz = 60}.period_us() == 16'667);
}

TEMPLATE_TEST_CASE("The longest step of a fast stream leaves room for whole microseconds",
                   "[sample]", float, double) {
  // 1.43 us: the times step by 1 or 2.
  CHECK(Acquisition<TestType>{.rate_hz = 700'000}.longest_step_us() >= 2);
}

}  // namespace
}  // namespace penduline::test
