// SPDX-License-Identifier: Apache-2.0
// The solvers of the comparison, ours and peers, as callables from gaps to angles.
#pragma once

#include <ceres/tiny_solver.h>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <unsupported/Eigen/NonLinearOptimization>

#include "common/closed_form.hpp"
#include "common/gauss_newton.hpp"
#include "tests/property/paper_six_unknowns.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::bench {

template <class Scalar>
using Gaps = std::array<Scalar, kMaxSensors>;

/// The closed form alone.
template <class Scalar>
class ClosedFormSolver {
 public:
  explicit ClosedFormSolver(const SensorLayout<Scalar>& layout)
      : layout_(layout), inverse_(layout) {}

  std::optional<Angles<Scalar>> operator()(const Gaps<Scalar>& gap_m) const {
    const auto result = inverse_.solve(test::rises_of(layout_, gap_m));
    return result ? std::optional(angles_of(result->slopes)) : std::nullopt;
  }

 private:
  SensorLayout<Scalar> layout_;
  ClosedForm<Scalar> inverse_;
};

/// What the pipeline does.
template <class Scalar>
class GaussNewtonSolver {
 public:
  explicit GaussNewtonSolver(const SensorLayout<Scalar>& layout) : inverse_(layout) {}

  std::optional<Angles<Scalar>> operator()(const Gaps<Scalar>& gap_m) const {
    const auto result = inverse_.solve(gap_m);
    return result ? std::optional(angles_of(result->slopes)) : std::nullopt;
  }

 private:
  GaussNewton<Scalar> inverse_;
};

/// The paper's six equations at the given gaps.
[[nodiscard]] inline test::PaperSixUnknowns six_equations(const Gaps<double>& gap_m) {
  return {.gap_x_m = gap_m[0], .gap_y_m = gap_m[1]};
}

/// Where a peer starts: at zero as Appendix A does, or at the pendulum's rest.
enum class Start { kZero, kRest };

using Unknowns = test::PaperSixUnknowns::Unknowns;

[[nodiscard]] inline Unknowns start_values(Start start) {
  return start == Start::kRest ? test::PaperSixUnknowns().rest() : Unknowns(Unknowns::Zero());
}

/// How closely TinySolver is asked to solve.
enum class Tolerance {
  kDefault,  ///< its own: costs in m^2 below 1e-6 count as nothing, so angles are good to 1e-3 rad
  kTight,    ///< angles to 1e-8 rad
};

class TinySolver {
 public:
  TinySolver(Start start, Tolerance tolerance) : start_(start_values(start)) {
    if (tolerance == Tolerance::kTight) {
      solver_.options.function_tolerance = 1e-20;
      solver_.options.cost_threshold = 1e-24;
      solver_.options.gradient_tolerance = 1e-16;
    }
  }

  std::optional<Angles<double>> operator()(const Gaps<double>& gap_m) {
    Unknowns unknowns = start_;
    solver_.Solve(six_equations(gap_m), &unknowns);
    return Angles<double>{unknowns[0], unknowns[1]};
  }

 private:
  Unknowns start_;
  ceres::TinySolver<test::PaperSixUnknowns> solver_;
};

/// Eigen's port of MINPACK's hybrj: Powell's hybrid method, which fsolve uses too.
class HybridSolver {
 public:
  explicit HybridSolver(Start start) : start_(start_values(start)) {}

  std::optional<Angles<double>> operator()(const Gaps<double>& gap_m) const {
    Equations equations{six_equations(gap_m)};
    Eigen::HybridNonLinearSolver<Equations> solver(equations);
    Eigen::VectorXd unknowns = start_;
    solver.hybrj1(unknowns);
    return Angles<double>{unknowns[0], unknowns[1]};
  }

 private:
  struct Equations {
    test::PaperSixUnknowns six;

    int operator()(const Eigen::VectorXd& unknowns, Eigen::VectorXd& residuals) const {
      return six(unknowns.data(), residuals.data(), nullptr) ? 0 : -1;
    }
    int df(const Eigen::VectorXd& unknowns, Eigen::MatrixXd& jacobian) const {
      std::array<double, 6> residuals{};
      return six(unknowns.data(), residuals.data(), jacobian.data()) ? 0 : -1;
    }
  };

  Unknowns start_;
};

}  // namespace penduline::bench
