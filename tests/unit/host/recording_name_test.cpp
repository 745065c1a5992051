// SPDX-License-Identifier: Apache-2.0
// Tests of the names of recordings.
#include "host/recorder/recording_name.hpp"

#include <catch2/catch.hpp>
#include <cstdint>

#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

/// 2026-11-21T07:00:03.25Z, from `date -u +%s`.
constexpr std::int64_t kSomeUtcUs = 1'795'244'403'250'000;

TEST_CASE("A name without percent signs stays as it is", "[recorder]") {
  CHECK(dated_name("a/rec.csv", kSomeUtcUs) == "a/rec.csv");
}

TEST_CASE("strftime's conversions become the time in UTC", "[recorder]") {
  CHECK(dated_name("%Y-%m-%d/rec-%Y%m%dT%H%M%SZ.csv", kSomeUtcUs) ==
        "2026-11-21/rec-20261121T070003Z.csv");
  CHECK(dated_name("100%%.csv", kSomeUtcUs) == "100%.csv");
}

TEST_CASE("A number stands before the extension", "[recorder]") {
  CHECK(numbered_name("rec.csv", 7) == "rec-0007.csv");
  CHECK(numbered_name("a.b/rec.part.csv", 9999) == "a.b/rec.part-9999.csv");
  CHECK(numbered_name("./rec", 12345) == "./rec-12345");
}

TEST_CASE("The next number is behind the largest, not in a hole", "[recorder]") {
  const TemporaryFolder folder;
  const std::string path = folder.path("rec.csv");
  CHECK(next_number(path) == 1);
  CHECK(folder.write("rec.csv", "") == path);
  CHECK(next_number(path) == 1);
  for (const char* name : {"rec-0002.csv", "rec-0010.csv"}) {
    REQUIRE_FALSE(folder.write(name, "").empty());
  }
  CHECK(next_number(path) == 11);
}

TEST_CASE("Files that only look like numbered ones do not count", "[recorder]") {
  const TemporaryFolder folder;
  for (const char* name : {"rec-7.txt", "other-8.csv", "rec-9a.csv", "rec-.csv", "rec--3.csv",
                           "rec-12345678901.csv", "-5.csv", "rec-.c", "xrec-0006.csv"}) {
    REQUIRE_FALSE(folder.write(name, "").empty());
  }
  CHECK(next_number(folder.path("rec.csv")) == 1);
}

TEST_CASE("In a folder that is not there the first number is next", "[recorder]") {
  CHECK(next_number("/nonexistent/rec.csv") == 1);
}

}  // namespace
