// SPDX-License-Identifier: Apache-2.0
// Properties of the monotone cubic: it never turns round, never overshoots, and has an inverse.
#include <rapidcheck/catch.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <span>

#include "common/monotone_cubic.hpp"
#include "tests/property/generators.hpp"

namespace penduline::test {
namespace {

/// Points of a curve between 0.1 and 10 apart in x and 0.001 and 100 apart in y.
struct Points {
  std::array<double, kMaxCurvePoints> x{};
  std::array<double, kMaxCurvePoints> y{};
  std::size_t count = 0;

  [[nodiscard]] MonotoneCubic<double> curve() const {
    return {std::span(x).first(count), std::span(y).first(count)};
  }
  [[nodiscard]] double height() const { return std::abs(y[count - 1] - y[0]); }
  [[nodiscard]] double largest() const { return std::max(std::abs(y[0]), std::abs(y[count - 1])); }
};

Points any_points() {
  Points points{.count = *rc::gen::inRange<std::size_t>(2, kMaxCurvePoints + 1)};
  const double direction = *rc::gen::element(-1.0, 1.0);
  points.x[0] = *in_steps(-10, 10);
  points.y[0] = *in_steps(-10, 10);
  for (std::size_t i = 1; i < points.count; ++i) {
    points.x[i] = points.x[i - 1] + std::pow(10, *in_steps(-1, 1));
    points.y[i] = points.y[i - 1] + direction * std::pow(10, *in_steps(-3, 2));
  }
  return points;
}

TEST_CASE("The curve is monotone between any two places", "[property]") {
  rc::prop("a later x has no earlier y", [] {
    const Points points = any_points();
    const auto curve = points.curve();
    const double width = points.x[points.count - 1] - points.x[0];
    const double first = *in_steps(-0.2, 1.2);
    const double second = *in_steps(-0.2, 1.2);
    const double low = curve(points.x[0] + width * std::min(first, second));
    const double high = curve(points.x[0] + width * std::max(first, second));
    // Rounding of a value and of the steps to it.
    const double slack = 1e-14 * (points.largest() + points.height());
    const bool rising = points.y[1] > points.y[0];
    RC_ASSERT((rising ? high >= low - slack : high <= low + slack));
  });
}

TEST_CASE("Between two points the curve does not leave their values", "[property]") {
  rc::prop("no overshoot", [] {
    const Points points = any_points();
    const auto curve = points.curve();
    const auto segment = *rc::gen::inRange<std::size_t>(0, points.count - 1);
    const double x = std::lerp(points.x[segment], points.x[segment + 1], *in_steps(0, 1));
    const auto [low, high] = std::minmax(points.y[segment], points.y[segment + 1]);
    const double slack = 1e-14 * (points.largest() + points.height());
    RC_ASSERT(curve(x) >= low - slack);
    RC_ASSERT(curve(x) <= high + slack);
  });
}

TEST_CASE("The inverse undoes the curve, beyond its ends too", "[property]") {
  rc::prop("f(inverse(y)) == y", [] {
    const Points points = any_points();
    const auto curve = points.curve();
    const double y =
        points.y[0] + (points.y[points.count - 1] - points.y[0]) * *in_steps(-0.2, 1.2);
    // One step of x weighs as the steepest segment has it.
    double steepest = 0;
    for (std::size_t i = 1; i < points.count; ++i) {
      steepest = std::max(
          steepest, std::abs((points.y[i] - points.y[i - 1]) / (points.x[i] - points.x[i - 1])));
    }
    const double farthest =
        std::abs(curve.inverse(y)) + std::abs(points.x[0]) + std::abs(points.x[points.count - 1]);
    const double slack = 1e-14 * (points.largest() + points.height()) + 1e-15 * steepest * farthest;
    RC_ASSERT(std::abs(curve(curve.inverse(y)) - y) <= slack);
  });
}

}  // namespace
}  // namespace penduline::test
