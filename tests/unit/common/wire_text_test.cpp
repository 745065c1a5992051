// SPDX-License-Identifier: Apache-2.0
// Tests of the short texts and of the names of values.
#include "common/wire/text.hpp"

#include <catch2/catch.hpp>
#include <set>
#include <string_view>

#include "common/wire/choices.hpp"

namespace penduline::test {
namespace {

using namespace wire;

TEST_CASE("A short text comes back", "[wire]") {
  CHECK(characters_of(text_of("pico")) == "pico");
  CHECK(characters_of(text_of("")).empty());
}

TEST_CASE("A text may use all of its bytes, a longer one is cut", "[wire]") {
  CHECK(characters_of(text_of("0123456789abcdef")) == "0123456789abcdef");
  CHECK(characters_of(text_of("0123456789abcdefg")) == "0123456789abcdef");
}

TEST_CASE("A text ends at its first zero", "[wire]") {
  CHECK(characters_of(Text{'a', '\0', 'b'}) == "a");
}

template <class Choices>
void check_choices(const Choices& choices) {
  std::set<std::string_view> names;
  int expected = 0;
  for (const auto& choice : choices) {
    CAPTURE(choice.name);
    CHECK(static_cast<int>(choice.value) == expected++);
    CHECK(name_of(choices, choice.value) == choice.name);
    names.insert(choice.name);
  }
  CHECK(names.size() == choices.size());
}

TEST_CASE("Values count from 0 and have names of their own", "[wire]") {
  check_choices(kEmitterModes);
  check_choices(kRebootTargets);
  check_choices(kResetCauses);
  check_choices(kStoreStates);
  check_choices(kResults);
}

TEST_CASE("A value of a newer peer is named unrecognised", "[wire]") {
  CHECK(name_of(kResults, static_cast<Result>(200)) == "unrecognised");
}

}  // namespace
}  // namespace penduline::test
