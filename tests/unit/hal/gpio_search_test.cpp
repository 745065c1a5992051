// SPDX-License-Identifier: Apache-2.0
// Tests of what a search for a GPIO line comes to; the search itself is tested in tests/kernel.
#include "hal/linux/gpio_search.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace penduline;

std::string error_of(const GpioFindings& findings) {
  return only_place("MAGNET", findings).error().message;
}

TEST_CASE("One line of a name is the one", "[gpio]") {
  const GpioPlace place{.chip = "gpiochip1", .offset = 27};
  CHECK(only_place("MAGNET", {.chips = {"gpiochip0", "gpiochip1"}, .places = {place}}) == place);
  // Whatever is on a chip that nobody may open.
  CHECK(only_place("MAGNET", {.chips = {"gpiochip1"},
                              .unreadable = {"/dev/gpiochip0: Permission denied"},
                              .places = {place}}) == place);
}

TEST_CASE("A name that is nowhere is told with the chips that were searched", "[gpio]") {
  CHECK(error_of({.chips = {"gpiochip0", "gpiochip1"}}) ==
        "GPIO line 'MAGNET': not found on gpiochip0, gpiochip1; gpioinfo lists the lines' names");
}

TEST_CASE("A machine without chips is told", "[gpio]") {
  CHECK(error_of({}) ==
        "GPIO line 'MAGNET': found no GPIO chip, expected /dev/gpiochip0 or others");
}

TEST_CASE("A chip that may not be opened may have the line", "[gpio]") {
  CHECK(error_of({.chips = {"gpiochip0"}, .unreadable = {"/dev/gpiochip1: Permission denied"}}) ==
        "GPIO line 'MAGNET': /dev/gpiochip1: Permission denied, expected to find the line there "
        "(as a rule the group gpio may open chips)");
}

TEST_CASE("A name that two lines have is ambiguous, with their places", "[gpio]") {
  CHECK(error_of(
            {.chips = {"gpiochip0", "gpiochip1"},
             .places = {{.chip = "gpiochip0", .offset = 3}, {.chip = "gpiochip1", .offset = 5}}}) ==
        "GPIO line 'MAGNET': found line 3 of gpiochip0 and line 5 of gpiochip1, expected one line "
        "of this name");
}

}  // namespace
