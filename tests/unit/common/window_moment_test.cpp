// SPDX-License-Identifier: Apache-2.0
// Tests of the window's moment: nominal while it fills, the middle of its times once full.
#include "common/window_moment.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>

namespace penduline::test {
namespace {

TEST_CASE("Until the window is full the moment is half its nominal length before the newest",
          "[window_moment]") {
  WindowMoment moment(16, 50'000);
  for (int i = 0; i < 15; ++i) {
    CAPTURE(i);
    // Jitter does not enter yet.
    const std::int64_t newest_us = 50'000 * i + 17 * i * i;
    REQUIRE(moment.push(newest_us) == newest_us - 375'000);
  }
}

TEST_CASE("An even period leaves the moment where it was when the window becomes full",
          "[window_moment]") {
  WindowMoment moment(16, 50'000);
  for (int i = 0; i < 100; ++i) {
    CAPTURE(i);
    REQUIRE(moment.push(50'000 * i) == 50'000 * i - 375'000);
  }
}

TEST_CASE("With jitter a full window's moment is midway between its oldest and newest time",
          "[window_moment]") {
  constexpr std::array<std::int64_t, 8> kTimes = {1000,    51'020,  99'990,  150'300,
                                                  200'000, 250'100, 301'000, 349'000};
  WindowMoment moment(4, 50'000);
  for (std::size_t i = 0; i < kTimes.size(); ++i) {
    CAPTURE(i);
    const std::int64_t at_us = moment.push(kTimes[i]);
    if (i >= 3) {
      CHECK(at_us == (kTimes[i - 3] + kTimes[i]) / 2);
    }
  }
}

TEST_CASE("A window of one sample is that sample's own moment", "[window_moment]") {
  WindowMoment moment(1, 50'000);
  CHECK(moment.push(123) == 123);
  CHECK(moment.push(50'456) == 50'456);
}

TEST_CASE("A window made of nothing is of one sample", "[window_moment]") {
  WindowMoment moment;
  CHECK(moment.push(77) == 77);
}

TEST_CASE("The longest window keeps all its times", "[window_moment]") {
  WindowMoment moment(kMaxTaps, 1000);
  std::int64_t at_us = 0;
  for (std::int64_t i = 0; i < 200; ++i) {
    at_us = moment.push(i * i);
  }
  CHECK(at_us == (199 * 199 + 136 * 136) / 2);
}

TEST_CASE("A cleared window is filled anew", "[window_moment]") {
  WindowMoment moment(4, 1000);
  for (const std::int64_t t_us : {0, 1000, 2000, 3000, 4000}) {
    moment.push(t_us);
  }
  moment.clear();
  CHECK(moment.push(10'000) == 8500);
  CHECK(moment.push(20'000) == 18'500);
  CHECK(moment.push(30'000) == 28'500);
  CHECK(moment.push(40'000) == 25'000);
}

TEST_CASE("Times beyond 32 bits of microseconds, 71.6 minutes, keep every microsecond",
          "[window_moment]") {
  constexpr std::int64_t kWrap = std::int64_t{1} << 32;
  WindowMoment moment(3, 50'000);
  moment.push(kWrap - 50'001);
  moment.push(kWrap - 1);
  CHECK(moment.push(kWrap + 49'999) == kWrap - 1);
  CHECK(moment.push(1'000 * kWrap) == (1'001 * kWrap - 1) / 2);
}

TEST_CASE("Half a microsecond is rounded down", "[window_moment]") {
  WindowMoment moment(2, 1000);
  moment.push(10);
  CHECK(moment.push(1011) == 510);
}

}  // namespace
}  // namespace penduline::test
