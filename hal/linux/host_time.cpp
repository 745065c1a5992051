// SPDX-License-Identifier: Apache-2.0
// Reading the clocks without an interruption between them.
#include "hal/linux/host_time.hpp"

#include <ctime>
#include <limits>

namespace penduline {
namespace {

std::int64_t now_us(clockid_t clock) {
  constexpr std::int64_t kUsPerSecond = 1'000'000;
  constexpr std::int64_t kNsPerUs = 1000;
  timespec now{};
  ::clock_gettime(clock, &now);
  return now.tv_sec * kUsPerSecond + now.tv_nsec / kNsPerUs;
}

}  // namespace

HostTime host_time_now() {
  constexpr int kTries = 5;
  constexpr std::int64_t kCloseUs = 5;
  HostTime closest{};
  std::int64_t least_us = std::numeric_limits<std::int64_t>::max();
  for (int i = 0; i < kTries && least_us > kCloseUs; ++i) {
    const std::int64_t before_us = now_us(CLOCK_MONOTONIC);
    const std::int64_t utc_us = now_us(CLOCK_REALTIME);
    const std::int64_t passed_us = now_us(CLOCK_MONOTONIC) - before_us;
    if (passed_us < least_us) {
      least_us = passed_us;
      closest = {.monotonic_us = before_us + passed_us / 2, .utc_us = utc_us};
    }
  }
  return closest;
}

}  // namespace penduline
