// SPDX-License-Identifier: Apache-2.0
// Tests that the paper's six equations, solved plainly, give the angles that our inverse gives.
#include "tests/property/paper_six_unknowns.hpp"

#include <catch2/catch.hpp>

#include "common/denavit_hartenberg.hpp"
#include "common/gauss_newton.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

using Unknowns = PaperSixUnknowns::Unknowns;
using Jacobian = PaperSixUnknowns::Jacobian;

Unknowns residuals_at(const PaperSixUnknowns& equations, const Unknowns& unknowns) {
  Unknowns residuals;
  equations(unknowns.data(), residuals.data(), nullptr);
  return residuals;
}

Unknowns some_unknowns() {
  Unknowns unknowns;
  unknowns << 0.31, -0.42, 0.004, 0.019, 0.023, -0.006;
  return unknowns;
}

TEST_CASE("The paper's equations measure the ends of its two chains", "[paper_six_unknowns]") {
  const Unknowns unknowns = some_unknowns();
  const PaperSixUnknowns equations{.gap_x_m = 0.017, .gap_y_m = 0.026};
  const Angles<double> angles{unknowns[0], unknowns[1]};
  Unknowns expected;
  expected << sensor_x_chain<double>(angles, 0.02, unknowns[2], unknowns[3]).topRightCorner<3, 1>(),
      sensor_y_chain<double>(angles, 0.02, unknowns[4], unknowns[5]).topRightCorner<3, 1>();
  Unknowns target;
  target << 0.02, 0, -0.017, 0, 0.02, -0.026;
  CHECK((residuals_at(equations, unknowns) - (expected - target)).norm() <= 1e-16);
}

TEST_CASE("The Jacobian of the paper's equations is that of central differences",
          "[paper_six_unknowns]") {
  const PaperSixUnknowns equations;
  const Unknowns unknowns = some_unknowns();
  Unknowns residuals;
  Jacobian jacobian;
  equations(unknowns.data(), residuals.data(), jacobian.data());
  constexpr double kStep = 1e-5;
  Jacobian differences;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Unknowns step = Unknowns::Unit(i) * kStep;
    differences.col(i) =
        (residuals_at(equations, unknowns + step) - residuals_at(equations, unknowns - step)) /
        (2 * kStep);
  }
  // Step squared times a third derivative of 0.02 m, and rounding over the step: 1e-12.
  CHECK((jacobian - differences).cwiseAbs().maxCoeff() <= 1e-11);
}

TEST_CASE("The paper's equations hold at rest", "[paper_six_unknowns]") {
  const PaperSixUnknowns equations;
  CHECK(residuals_at(equations, equations.rest()).norm() == 0);
}

TEST_CASE("Newton on the paper's equations agrees with Gauss-Newton over +-20 degrees",
          "[paper_six_unknowns]") {
  const auto layout = paper_layout<double>();
  const GaussNewton<double> inverse(layout);
  Worst worst;
  for (int i = -20; i <= 20; ++i) {
    for (int j = -20; j <= 20; ++j) {
      const auto gap_m = gaps_at(layout, {from_degrees(i), from_degrees(j)});
      const PaperSixUnknowns equations{.gap_x_m = gap_m[0], .gap_y_m = gap_m[1]};
      Unknowns unknowns = equations.rest();
      CAPTURE(i, j);
      REQUIRE(equations.newton(unknowns));
      const auto result = inverse.solve(gap_m);
      REQUIRE(result.has_value());
      worst.note(angle_error(result->slopes, Angles<double>{unknowns[0], unknowns[1]}));
    }
  }
  CHECK(worst.value() <= 1e-10);
}

}  // namespace
}  // namespace penduline::test
