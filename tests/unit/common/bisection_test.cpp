// SPDX-License-Identifier: Apache-2.0
// Tests of bisection: the last place before the turn, to the last bit, and always an end.
#include "common/bisection.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

namespace penduline::test {
namespace {

TEMPLATE_TEST_CASE("Bisection finds the last place before the turn, to the last bit", "[bisection]",
                   float, double) {
  const TestType turn = TestType(0.7);
  const TestType found =
      bisect(TestType(0), TestType(1), [&](TestType value) { return value > turn; });
  CHECK(found == turn);
}

TEST_CASE("Bisection finds a square root to the last bit", "[bisection]") {
  // Python's math.sqrt(2)
  const double found = bisect(1.0, 2.0, [](double value) { return value * value > 2; });
  CHECK_THAT(found, Catch::WithinULP(1.4142135623730951, 1));
}

TEST_CASE("Where everything is beyond, the low end is the answer", "[bisection]") {
  CHECK(bisect(1.0, 2.0, [](double) { return true; }) == 1);
}

TEST_CASE("Where nothing is beyond, the answer is the last number before the high end",
          "[bisection]") {
  CHECK(bisect(1.0, 2.0, [](double) { return false; }) == std::nextafter(2.0, 0.0));
}

TEST_CASE("Ends that are neighbours or equal leave nothing to halve", "[bisection]") {
  const double next = std::nextafter(1.0, 2.0);
  CHECK(bisect(1.0, next, [](double) { return false; }) == 1);
  CHECK(bisect(1.0, 1.0, [](double) { return false; }) == 1);
}

TEST_CASE("Ends that are no numbers come to an end", "[bisection]") {
  CHECK(std::isnan(bisect(std::nan(""), 1.0, [](double) { return false; })));
}

}  // namespace
}  // namespace penduline::test
