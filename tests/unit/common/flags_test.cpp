// SPDX-License-Identifier: Apache-2.0
// Tests of the list of flags, which code, files and documentation share.
#include "common/flags.hpp"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <set>
#include <string_view>

namespace penduline::test {
namespace {

TEST_CASE("Every description is of one bit", "[flags]") {
  for (const FlagDescription& description : kFlagDescriptions) {
    CAPTURE(description.name);
    CHECK(std::has_single_bit(description.bit));
  }
}

TEST_CASE("The descriptions stand in the order of their bits, none twice", "[flags]") {
  CHECK(std::ranges::adjacent_find(kFlagDescriptions, std::ranges::greater_equal{},
                                   &FlagDescription::bit) == kFlagDescriptions.end());
}

TEST_CASE("No two flags have one name", "[flags]") {
  std::set<std::string_view> names;
  for (const FlagDescription& description : kFlagDescriptions) {
    names.insert(description.name);
  }
  CHECK(names.size() == kFlagDescriptions.size());
}

TEST_CASE("Names are words that a file's cell can hold", "[flags]") {
  for (const FlagDescription& description : kFlagDescriptions) {
    CAPTURE(description.name);
    CHECK_FALSE(description.name.empty());
    CHECK(description.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") ==
          std::string_view::npos);
  }
}

TEST_CASE("The device's flags are bits 0 to 7, the pipeline's are above", "[flags]") {
  CHECK((flag::kSaturated | flag::kOverrun | flag::kRestarted | flag::kLate) < 256U);
  CHECK(std::min({flag::kDropout, flag::kOutOfOrder, flag::kMissing, flag::kFilling,
                  flag::kOutOfRange, flag::kFolded, flag::kIllConditioned, flag::kNoSolution}) ==
        256U);
}

}  // namespace
}  // namespace penduline::test
