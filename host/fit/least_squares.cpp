// SPDX-License-Identifier: Apache-2.0
// NLopt for the search, Gauss-Newton for the last digits, a singular value decomposition for what
// is known.
#include "host/fit/least_squares.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <stdexcept>

namespace penduline {
namespace {

/// The problem in parameters divided by their scales.
class ScaledProblem {
 public:
  ScaledProblem(const std::vector<FitParameter>& parameters, std::size_t residual_count,
                const FitResiduals& residuals, const std::function<bool()>& stopped)
      : parameters_(parameters),
        count_(static_cast<Eigen::Index>(residual_count)),
        residuals_(residuals),
        stopped_(stopped),
        scales_(static_cast<Eigen::Index>(parameters.size())) {
    std::ranges::transform(parameters, scales_.begin(), &FitParameter::scale);
  }

  [[nodiscard]] const Eigen::VectorXd& scales() const { return scales_; }
  [[nodiscard]] Eigen::VectorXd of_each(double FitParameter::*member) const {
    Eigen::VectorXd values(scales_.size());
    std::ranges::transform(parameters_, values.begin(), member);
    return values.cwiseQuotient(scales_);
  }

  [[nodiscard]] Eigen::VectorXd residuals(const Eigen::VectorXd& scaled) const {
    Eigen::VectorXd result(count_);
    residuals_(scaled.cwiseProduct(scales_), result);
    return result;
  }

  [[nodiscard]] bool stopped() const { return stopped_ && stopped_(); }

  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& scaled) const {
    constexpr double kStep = 1e-4;
    Eigen::MatrixXd result(count_, scaled.size());
    Eigen::VectorXd moved = scaled;
    for (Eigen::Index i = 0; i < scaled.size(); ++i) {
      moved[i] = scaled[i] + kStep;
      result.col(i) = residuals(moved);
      moved[i] = scaled[i] - kStep;
      result.col(i) -= residuals(moved);
      moved[i] = scaled[i];
    }
    return result / (2 * kStep);
  }

 private:
  const std::vector<FitParameter>& parameters_;
  Eigen::Index count_;
  const FitResiduals& residuals_;
  const std::function<bool()>& stopped_;
  Eigen::VectorXd scales_;
};

/// Half the sum of squares and its gradient, as NLopt asks for them.
double cost(unsigned count, const double* scaled, double* gradient, void* data) {
  const auto& problem = *static_cast<const ScaledProblem*>(data);
  if (problem.stopped()) {
    throw nlopt::forced_stop();
  }
  const Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(scaled, count);
  const Eigen::VectorXd residuals = problem.residuals(at);
  if (gradient != nullptr) {
    Eigen::Map<Eigen::VectorXd>(gradient, count) = problem.jacobian(at).transpose() * residuals;
  }
  const double sum = residuals.squaredNorm() / 2;
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

/// Near the minimum; where NLopt gives up for its rounding errors, as near as it came.
Eigen::VectorXd search(const ScaledProblem& problem) {
  const Eigen::VectorXd start = problem.of_each(&FitParameter::start);
  const auto vector_of = [](const Eigen::VectorXd& values) {
    return std::vector<double>(values.begin(), values.end());
  };
  nlopt::opt optimizer(nlopt::LD_SLSQP, static_cast<unsigned>(start.size()));
  optimizer.set_lower_bounds(vector_of(problem.of_each(&FitParameter::low)));
  optimizer.set_upper_bounds(vector_of(problem.of_each(&FitParameter::high)));
  optimizer.set_min_objective(cost, const_cast<ScaledProblem*>(&problem));
  optimizer.set_ftol_rel(1e-9);
  optimizer.set_maxeval(500);
  std::vector<double> at = vector_of(start);
  double least = 0;
  try {
    optimizer.optimize(at, least);
  } catch (const std::runtime_error&) {
    // Near a minimum without noise it runs into rounding, or out of steps; `at` is the best so far.
  }
  return Eigen::Map<const Eigen::VectorXd>(at.data(), start.size());
}

/// The Jacobian's decomposition, with what a parameter at its bound cannot do left out.
struct Linearized {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  Eigen::JacobiSVD<Eigen::MatrixXd> svd{};
  Eigen::VectorXd step{};  ///< to be taken back: to the minimum, as far as is seen from here
  std::vector<std::size_t> held{};  ///< parameters at a bound that would go beyond it
};

/// Which bound a parameter is next to, by its scale: -1 the lower, 1 the upper, 0 none.
double bound_at(double value, double low, double high) {
  constexpr double kNear = 1e-4;
  return value - low < kNear ? -1 : high - value < kNear ? 1 : 0;
}

/// Puts and holds those parameters at bounds that the step would take beyond them, one after the
/// other, for without one of them others may turn back.
Linearized linearize(const ScaledProblem& problem, Eigen::VectorXd& at) {
  const Eigen::VectorXd low = problem.of_each(&FitParameter::low);
  const Eigen::VectorXd high = problem.of_each(&FitParameter::high);
  Linearized result{.residuals = problem.residuals(at), .jacobian = problem.jacobian(at)};
  while (true) {
    result.svd.compute(result.jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
    result.step = result.svd.solve(result.residuals);
    Eigen::Index farthest = -1;
    double beyond = 0;
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      const double outwards = -result.step[i] * bound_at(at[i], low[i], high[i]);
      if (outwards > beyond) {
        beyond = outwards;
        farthest = i;
      }
    }
    if (farthest < 0) {
      return result;
    }
    result.held.push_back(static_cast<std::size_t>(farthest));
    const double bound = result.step[farthest] > 0 ? low[farthest] : high[farthest];
    if (at[farthest] != bound) {
      at[farthest] = bound;
      result.residuals = problem.residuals(at);
    }
    result.jacobian.col(farthest).setZero();
  }
}

/// Inverse of J^T J. A direction that no residual sees gets a variance beyond all scales.
Eigen::MatrixXd inverse_normal(const Linearized& at) {
  constexpr double kBlind = 1e-12;
  const Eigen::VectorXd& singular = at.svd.singularValues();
  const double least = std::max(singular[0], 1.0) * kBlind;
  const Eigen::VectorXd weights = singular.cwiseMax(least).cwiseInverse().cwiseAbs2();
  return at.svd.matrixV() * weights.asDiagonal() * at.svd.matrixV().transpose();
}

/// Goes downhill by Gauss-Newton steps, shortened where they overshoot, until a step is nothing
/// beside the parameters' sigmas. False where it cannot, or is stopped.
bool polish(const ScaledProblem& problem, Eigen::VectorXd& at, Linearized& here) {
  constexpr int kMostSteps = 50;
  constexpr double kNothing = 1e-3;
  const Eigen::VectorXd low = problem.of_each(&FitParameter::low);
  const Eigen::VectorXd high = problem.of_each(&FitParameter::high);
  for (int i = 0; i < kMostSteps && !problem.stopped(); ++i) {
    here = linearize(problem, at);
    // In residuals' standard deviations: what the step would still gain.
    if ((here.jacobian * here.step).norm() <
        kNothing * std::max(1.0, here.residuals.norm() / std::sqrt(here.residuals.size()))) {
      return true;
    }
    double share = 1;
    // A bound in the way ends the step there and does not bend it.
    const auto room = [&](Eigen::Index j) {
      const double to_bound = here.step[j] > 0 ? at[j] - low[j] : at[j] - high[j];
      return here.step[j] == 0 || !std::isfinite(to_bound) ? 1.0 : to_bound / here.step[j];
    };
    for (Eigen::Index j = 0; j < at.size(); ++j) {
      share = std::min(share, std::max(room(j), 0.0));
    }
    const double first_share = share;
    const auto moved = [&] { return (at - share * here.step).cwiseMax(low).cwiseMin(high).eval(); };
    while (share > 1e-6 * first_share &&
           !(problem.residuals(moved()).squaredNorm() < here.residuals.squaredNorm())) {
      share /= 4;
    }
    if (share <= 1e-6 * first_share) {
      // No way down is left: the rounding of the residuals is all there is.
      return (here.jacobian * here.step).norm() < 1e-2 * here.residuals.norm();
    }
    at = moved();
  }
  return false;
}

}  // namespace

double Fit::sigma(std::size_t parameter) const {
  const auto i = static_cast<Eigen::Index>(parameter);
  return std::sqrt(covariance(i, i));
}

tl::expected<Fit, Error> fit_least_squares(const std::vector<FitParameter>& parameters,
                                           std::size_t residual_count,
                                           const FitResiduals& residuals,
                                           const std::function<bool()>& stopped) {
  if (residual_count < parameters.size()) {
    return failure(fmt::format("found {} measurements for {} unknowns, expected at least as many",
                               residual_count, parameters.size()));
  }
  const ScaledProblem problem(parameters, residual_count, residuals, stopped);
  if (!problem.residuals(problem.of_each(&FitParameter::start)).allFinite()) {
    return failure("the fit's first guess has no answer");
  }
  Fit fit;
  Linearized here;
  Eigen::VectorXd at = problem.of_each(&FitParameter::start);
  // From a start that is near, Gauss-Newton is there in a few steps.
  if (!polish(problem, at, here)) {
    at = search(problem);
    if (!polish(problem, at, here)) {
      return failure(problem.stopped()
                         ? "the fit was stopped"
                         : "the fit found no minimum: the model does not describe these data");
    }
  }
  fit.at_bound = here.held;
  std::ranges::sort(fit.at_bound);
  fit.residuals = here.residuals;
  const auto freedom = std::max<std::size_t>(residual_count - parameters.size(), 1);
  fit.scatter = here.residuals.norm() / std::sqrt(static_cast<double>(freedom));
  fit.values = at.cwiseProduct(problem.scales());
  fit.covariance = problem.scales().asDiagonal() * inverse_normal(here) *
                   problem.scales().asDiagonal() * (fit.scatter * fit.scatter);
  for (const std::size_t held : fit.at_bound) {
    fit.covariance.row(static_cast<Eigen::Index>(held)).setZero();
    fit.covariance.col(static_cast<Eigen::Index>(held)).setZero();
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const bool held = std::ranges::find(fit.at_bound, i) != fit.at_bound.end();
    if (!held && !(fit.sigma(i) <= parameters[i].coarsest_sigma)) {
      fit.undetermined.push_back(i);
    }
  }
  return fit;
}

}  // namespace penduline
