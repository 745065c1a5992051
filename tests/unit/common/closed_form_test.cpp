// SPDX-License-Identifier: Apache-2.0
// Tests of the closed form: the whole good region, conditioning, no answer where no tilt fits.
#include "common/closed_form.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

std::optional<ClosedFormResult<double>> solve_at(const SensorLayout<double>& layout,
                                                 const Angles<double>& angles) {
  return ClosedForm<double>(layout).solve(rises_of(layout, gaps_at(layout, angles)));
}

/// Slopes for given rises under the paper's two sensors.
std::optional<ClosedFormResult<double>> solve_rises(double rise_x_m, double rise_y_m) {
  const std::array<double, 2> rises_m = {rise_x_m, rise_y_m};
  return ClosedForm<double>(paper_layout<double>()).solve(rises_m);
}

/// On the paper's diagonal A = B, where the two sensors see the same.
Angles<double> on_diagonal(double tilt_deg) {
  const double slope = std::tan(from_degrees(tilt_deg)) / std::sqrt(2.0);
  return angles_of(Slopes<double>{slope, slope});
}

TEST_CASE("The closed form gives the angles back over the whole good region", "[closed_form]") {
  const auto layout = paper_layout<double>();
  Worst worst;
  for_each_good_tilt([&](const Angles<double>& angles) {
    const auto result = solve_at(layout, angles);
    REQUIRE(result.has_value());
    worst.note(angle_error(result->slopes, angles));
  });
  CHECK(worst.value() <= 1e-14);
}

TEST_CASE("In float the closed form stays near the double one on the same gaps", "[closed_form]") {
  const auto layout = paper_layout<float>();
  const ClosedForm<float> narrow(layout);
  const ClosedForm<double> wide(widened(layout));
  Worst worst;
  for_each_good_tilt([&](const Angles<double>& angles) {
    const auto gap_m = rounded<float>(gaps_at(widened(layout), angles));
    const auto result = narrow.solve(rises_of(layout, gap_m));
    REQUIRE(result.has_value());
    const auto reference = wide.solve(rises_of(widened(layout), rounded<double>(gap_m)));
    worst.note(angle_error(result->slopes, angles_of(reference->slopes)));
  });
  CHECK(worst.value() <= 5e-7);
}

TEMPLATE_TEST_CASE("At rest the answer is rest, with conditioning 1", "[closed_form]", float,
                   double) {
  const std::array<TestType, 2> rises_m{};
  const auto result = ClosedForm<TestType>(paper_layout<TestType>()).solve(rises_m);
  REQUIRE(result.has_value());
  CHECK(result->slopes.a == 0);
  CHECK(result->slopes.b == 0);
  CHECK(result->conditioning == 1);
}

TEST_CASE("Conditioning is 1 - (a/dx + b/dy) lp in components of the unit normal",
          "[closed_form]") {
  const auto layout = paper_layout<double>();
  Worst worst;
  for_each_good_tilt([&](const Angles<double>& angles) {
    worst.note(solve_at(layout, angles)->conditioning - paper_conditioning(angles));
  });
  CHECK(worst.value() <= 1e-14);
}

TEST_CASE("Conditioning falls to nothing on the singular line A = B at 45 degrees",
          "[closed_form]") {
  // reading.md: theta1 = 35.3, theta2 = -30 deg; exactly, atan(1 / sqrt 2) and -asin(1/2).
  const Angles<double> singular{std::atan(1 / std::sqrt(2.0)), from_degrees(-30)};
  const auto result = solve_at(paper_layout<double>(), singular);
  // The root of a rounding error: sqrt(1e-16), or no root at all.
  CHECK((!result || result->conditioning < 1e-7));
}

TEST_CASE("Near the singular line every answer can be known by its conditioning", "[closed_form]") {
  for (double tilt_deg = 31; tilt_deg <= 45; tilt_deg += 0.125) {
    CAPTURE(tilt_deg);
    const auto result = solve_at(paper_layout<double>(), on_diagonal(tilt_deg));
    CHECK((!result || result->conditioning < 0.3));
  }
}

TEST_CASE("Just beyond the singular line an answer is the other root, and ill-conditioned",
          "[closed_form]") {
  const auto layout = paper_layout<double>();
  const Angles<double> beyond = on_diagonal(50);
  const auto result = solve_at(layout, beyond);
  REQUIRE(result.has_value());
  CHECK(angle_error(result->slopes, beyond) > from_degrees(1));
  CHECK(result->conditioning < 0.3);
}

TEST_CASE("Rises greater than any tilt gives have no answer", "[closed_form]") {
  // On the diagonal the rise 0.02 (s - (sqrt(1 + 2 s^2) - 1)) is greatest at s = 1 / sqrt 2:
  // 0.02 (1 / sqrt 2 - sqrt 2 + 1) m.
  const double greatest_m = 0.02 * (1 - std::sqrt(0.5));
  CHECK(solve_rises(greatest_m - 1e-9, greatest_m - 1e-9).has_value());
  CHECK_FALSE(solve_rises(greatest_m + 1e-9, greatest_m + 1e-9).has_value());
  CHECK_FALSE(solve_rises(0.02, 0.02).has_value());
  CHECK_FALSE(solve_rises(1e6, 1e6).has_value());
}

TEST_CASE("Rises that are no numbers have no answer", "[closed_form]") {
  CHECK_FALSE(solve_rises(std::nan(""), 0).has_value());
  CHECK_FALSE(solve_rises(0, std::nan("")).has_value());
}

TEST_CASE("Sensors far out on the disc have an answer for every tilt to 85 degrees",
          "[closed_form]") {
  // At 5 cm the curvature is positive: no singular line. Beyond 70 degrees half_linear <= 0.
  const auto layout = layout_of<double>({{0.05, 0, 0}, {0, 0.05, 0}}, 0.02);
  Worst worst;
  for (int i = -85; i <= 85; ++i) {
    for (int j = -85; j <= 85; ++j) {
      const Angles<double> angles{from_degrees(i), from_degrees(j)};
      const auto result = solve_at(layout, angles);
      REQUIRE(result.has_value());
      worst.note(angle_error(result->slopes, angles));
    }
  }
  CHECK(worst.value() <= 1e-14);
}

TEST_CASE("Where the curvature is nothing the quadratic's straight line is solved",
          "[closed_form]") {
  // lp / dx = 0.6, lp / dy = 0.8: curvature 1 - 0.36 - 0.64, to rounding.
  const auto layout = layout_of<double>({{0.02 / 0.6, 0, 0}, {0, 0.025, 0}}, 0.02);
  const Angles<double> angles{from_degrees(-20), from_degrees(15)};
  const auto result = solve_at(layout, angles);
  REQUIRE(result.has_value());
  CHECK(angle_error(result->slopes, angles) <= 1e-14);
}

TEST_CASE("The closed form is exact for many sensors where their gaps agree", "[closed_form]") {
  const auto layout = layout_of<double>(
      {{0.021, 0.003, 0.001}, {-0.004, 0.026, -0.002}, {-0.018, -0.009, 0.003}, {0.007, -0.022, 0}},
      0.025);
  const Angles<double> angles{from_degrees(31), from_degrees(-23)};
  const auto result = solve_at(layout, angles);
  REQUIRE(result.has_value());
  CHECK(angle_error(result->slopes, angles) <= 1e-14);
}

TEMPLATE_TEST_CASE("Sensors on one line through the pivot do not determine the tilt",
                   "[closed_form]", float, double) {
  CHECK_FALSE(determines_tilt(layout_of<TestType>({}, 0.02)));
  CHECK_FALSE(determines_tilt(layout_of<TestType>({{0.02, 0, 0}}, 0.02)));
  CHECK_FALSE(determines_tilt(layout_of<TestType>({{0.02, 0, 0}, {-0.03, 0, 0.01}}, 0.02)));
  CHECK_FALSE(determines_tilt(
      layout_of<TestType>({{0.01, 0.02, 0}, {0.02, 0.04, 0}, {-0.015, -0.03, 0}}, 0.02)));
  CHECK_FALSE(determines_tilt(layout_of<TestType>({{0, 0, 0}, {0, 0, 0.01}}, 0.02)));
}

TEMPLATE_TEST_CASE("Sensors on a line beside the pivot determine the tilt", "[closed_form]", float,
                   double) {
  CHECK(determines_tilt(paper_layout<TestType>()));
  CHECK(determines_tilt(layout_of<TestType>({{0.02, 0.01, 0}, {-0.02, 0.01, 0}}, 0.02)));
}

TEMPLATE_TEST_CASE("A spread of 100 to 1 is where the tilt stops being determined", "[closed_form]",
                   float, double) {
  CHECK(determines_tilt(layout_of<TestType>({{0.099, 0, 0}, {0, 0.001, 0}}, 0.02)));
  CHECK_FALSE(determines_tilt(layout_of<TestType>({{0.101, 0, 0}, {0, 0.001, 0}}, 0.02)));
}

}  // namespace
}  // namespace penduline::test
