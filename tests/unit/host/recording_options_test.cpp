// SPDX-License-Identifier: Apache-2.0
// Tests of durations and sizes as a user writes them.
#include "host/cli/recording_options.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace penduline;

TEST_CASE("Durations have a unit from seconds to days", "[options]") {
  CHECK(parse_duration_us("1s") == 1'000'000);
  CHECK(parse_duration_us("90 s") == 90'000'000);
  CHECK(parse_duration_us("1.5min") == 90'000'000);
  CHECK(parse_duration_us("1h") == 3'600'000'000);
  CHECK(parse_duration_us("1000d") == 86'400'000'000'000);
}

TEST_CASE("Sizes have units of 1000 or 1024", "[options]") {
  CHECK(parse_size_bytes("10kB") == 10'000U);
  CHECK(parse_size_bytes("100MB") == 100'000'000U);
  CHECK(parse_size_bytes("1.5GB") == 1'500'000'000U);
  CHECK(parse_size_bytes("16KiB") == 16'384U);
  CHECK(parse_size_bytes("1MiB") == 1'048'576U);
  CHECK(parse_size_bytes("2 GiB") == 2'147'483'648U);
}

TEST_CASE("What is no duration or size, or out of range, is none", "[options]") {
  for (const char* text : {"", "1", "s", "1h30min", "-1h", "nan h", "1hour", "0.5s", "1001d",
                           "inf d", "100MB", "1 0s", "1e3s s"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_duration_us(text));
  }
  for (const char* text : {"", "100", "MB", "9kB", "1001GB", "-100MB", "1h", "100mb", "1TB"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_size_bytes(text));
  }
}

}  // namespace
