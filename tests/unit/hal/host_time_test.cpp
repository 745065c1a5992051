// SPDX-License-Identifier: Apache-2.0
// Tests of the host's two clocks at one moment.
#include "hal/linux/host_time.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdint>
#include <cstdlib>

namespace {

using namespace penduline;
using std::chrono::duration_cast;
using std::chrono::microseconds;

TEST_CASE("Both clocks are the system's, between a reading before and one after", "[linux]") {
  using Steady = std::chrono::steady_clock;
  using System = std::chrono::system_clock;
  const auto steady_us = [] {
    return duration_cast<microseconds>(Steady::now().time_since_epoch()).count();
  };
  const auto system_us = [] {
    return duration_cast<microseconds>(System::now().time_since_epoch()).count();
  };
  const std::int64_t monotonic_before = steady_us();
  const std::int64_t utc_before = system_us();
  const HostTime now = host_time_now();
  CHECK(now.monotonic_us >= monotonic_before);
  CHECK(now.monotonic_us <= steady_us());
  CHECK(now.utc_us >= utc_before);
  CHECK(now.utc_us <= system_us());
}

TEST_CASE("Readings in a row agree on how the clocks stand", "[linux]") {
  const HostTime first = host_time_now();
  for (int i = 0; i < 1000; ++i) {
    const HostTime now = host_time_now();
    // Half a millisecond is what the system may slew and a busy machine may be late in this time.
    REQUIRE(std::abs((now.utc_us - now.monotonic_us) - (first.utc_us - first.monotonic_us)) < 500);
  }
}

}  // namespace
