// SPDX-License-Identifier: Apache-2.0
// Tests of what the light on the board shows.
#include "firmware/lights.hpp"

#include <catch2/catch.hpp>

namespace penduline::test {
namespace {

/// How often the light goes on in a second that begins at `from_us`, looked at each millisecond.
int flashes(const Lights& lights, std::uint64_t from_us) {
  int flashes = 0;
  bool before = false;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const bool lit = lights.lit(from_us + i * 1000);
    flashes += lit && !before ? 1 : 0;
    before = lit;
  }
  return flashes;
}

TEST_CASE("The light flashes once a second for 60 ms", "[lights]") {
  const Lights lights;
  CHECK(flashes(lights, 0) == 1);
  CHECK(flashes(lights, 5'000'000'000) == 1);
  CHECK(lights.lit(7'059'999));
  CHECK_FALSE(lights.lit(7'060'000));
  CHECK_FALSE(lights.lit(7'999'999));
}

TEST_CASE("To be found it flickers five times a second, for as long as asked", "[lights]") {
  Lights lights;
  lights.identify(3'000'000, 2);
  CHECK(flashes(lights, 3'000'000) == 5);
  CHECK(flashes(lights, 4'000'000) == 5);
  CHECK(flashes(lights, 5'000'000) == 1);
}

TEST_CASE("Zero seconds end the flicker", "[lights]") {
  Lights lights;
  lights.identify(3'000'000, 255);
  lights.identify(4'000'000, 0);
  CHECK(flashes(lights, 4'000'000) == 1);
}

}  // namespace
}  // namespace penduline::test
