// SPDX-License-Identifier: Apache-2.0
// Flags stay for as many samples as the filter has taps, no more.
#include <catch2/catch.hpp>

#include "common/window_flags.hpp"

namespace {

using namespace penduline;

TEST_CASE("A flag stays while its sample is in the window", "[window_flags]") {
  WindowFlags window(3);
  CHECK(window.push(0) == 0);
  CHECK(window.push(flag::kSaturated) == flag::kSaturated);
  CHECK(window.push(0) == flag::kSaturated);
  CHECK(window.push(0) == flag::kSaturated);
  CHECK(window.push(0) == 0);
}

TEST_CASE("Flags of different samples add up and leave one by one", "[window_flags]") {
  WindowFlags window(2);
  CHECK(window.push(flag::kFolded) == flag::kFolded);
  CHECK(window.push(flag::kOutOfRange) == (flag::kFolded | flag::kOutOfRange));
  CHECK(window.push(0) == flag::kOutOfRange);
}

TEST_CASE("A window of one sample has that sample's flags", "[window_flags]") {
  WindowFlags window(1);
  CHECK(window.push(flag::kFolded) == flag::kFolded);
  CHECK(window.push(0) == 0);
}

TEST_CASE("A window of the most taps keeps a flag for all of them", "[window_flags]") {
  WindowFlags window(kMaxTaps);
  CHECK(window.push(flag::kFolded) == flag::kFolded);
  for (std::size_t i = 1; i < kMaxTaps; ++i) {
    REQUIRE(window.push(0) == flag::kFolded);
  }
  CHECK(window.push(0) == 0);
}

TEST_CASE("Clearing forgets the flags", "[window_flags]") {
  WindowFlags window(3);
  CHECK(window.push(flag::kFolded) == flag::kFolded);
  window.clear();
  CHECK(window.push(0) == 0);
}

}  // namespace
