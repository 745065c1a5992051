// SPDX-License-Identifier: Apache-2.0
// Tests of a gap's derivative by the angles: against differences, over the whole range.
#include "common/gap_gradient.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

TEMPLATE_TEST_CASE("The gap's derivative by the angles is that of its differences",
                   "[gap_gradient]", float, double) {
  const SensorLayout<TestType> layout =
      layout_of<TestType>({{0.02, 0, -0.011}, {-0.005, 0.03, 0.002}}, 0.02);
  constexpr double kStep = 1e-5;
  Worst worst;
  for_each_good_tilt([&](const Angles<double>& angles) {
    for (std::size_t i = 0; i < layout.count; ++i) {
      const auto gap_at = [&](double by1, double by2) {
        return gaps_at(widened(layout), {angles.theta1_rad + by1, angles.theta2_rad + by2})[i];
      };
      const auto found = gap_gradient<TestType>(
          layout, i,
          {static_cast<TestType>(angles.theta1_rad), static_cast<TestType>(angles.theta2_rad)});
      worst.note(static_cast<double>(found.gap_m) - gap_at(0, 0));
      worst.note(static_cast<double>(found.by_theta1_m) -
                 (gap_at(kStep, 0) - gap_at(-kStep, 0)) / (2 * kStep));
      worst.note(static_cast<double>(found.by_theta2_m) -
                 (gap_at(0, kStep) - gap_at(0, -kStep)) / (2 * kStep));
    }
  });
  CHECK(worst.value() < tolerance<TestType>(1e-10, 1e-7));
}

}  // namespace
}  // namespace penduline::test
