// SPDX-License-Identifier: Apache-2.0
// Tests of what stands in for newlib's reduction of angles on a board, against long double.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/unit/common/test_rig.hpp"

extern "C" int __ieee754_rem_pio2f(float angle_rad, float* rest_rad);  // NOLINT: newlib's name

namespace penduline::test {
namespace {

struct Reduced {
  int quarters;
  std::array<float, 2> rest_rad;
};

Reduced reduced(float angle_rad) {
  Reduced result{};
  result.quarters = __ieee754_rem_pio2f(angle_rad, result.rest_rad.data());
  return result;
}

constexpr long double kQuarterRad = std::numbers::pi_v<long double> / 2;

/// By how much the quarters and the rest are not the angle.
double error_at(float angle_rad) {
  const auto [quarters, rest_rad] = reduced(angle_rad);
  return static_cast<double>(quarters * kQuarterRad + rest_rad[0] + rest_rad[1] -
                             static_cast<long double>(angle_rad));
}

TEST_CASE("Quarter turns and the rest are the angle, to 1e-10 rad", "[quarter_turns]") {
  Worst error;
  Worst rest;
  for (float angle_rad = -199; angle_rad < 199; angle_rad += 0.0137F) {
    error.note(error_at(angle_rad));
    rest.note(double{reduced(angle_rad).rest_rad[0]});
  }
  for (int quarters = -127; quarters <= 127; ++quarters) {
    error.note(error_at(static_cast<float>(quarters * kQuarterRad)));
  }
  CHECK(error.value() < 1e-10);
  CHECK(rest.value() < std::numbers::pi / 4 + 1e-5);
}

TEST_CASE("The quarter turns are counted to both sides", "[quarter_turns]") {
  CHECK(reduced(0.8F).quarters == 1);
  CHECK(reduced(-0.8F).quarters == -1);
  CHECK(reduced(3.0F).quarters == 2);
  CHECK(reduced(100.0F).quarters == 64);
}

TEST_CASE("An angle that no pendulum has leaves NaN", "[quarter_turns]") {
  for (const float angle_rad :
       {200.0F, -200.0F, std::numeric_limits<float>::infinity(), std::nanf("")}) {
    CHECK(std::isnan(reduced(angle_rad).rest_rad[0]));
    CHECK(std::isnan(reduced(angle_rad).rest_rad[1]));
  }
}

}  // namespace
}  // namespace penduline::test
