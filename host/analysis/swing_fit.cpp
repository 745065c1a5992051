// SPDX-License-Identifier: Apache-2.0
// A swing's unknowns in a row, and the way to a first guess.
#include "host/analysis/swing_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/fit/least_squares.hpp"

namespace penduline {
namespace {

/// The places of a model's numbers that a fit looks for, in its order.
template <class Model>
auto unknowns(Model& model, const FrictionTerms& terms, bool planar) {
  using Number = std::conditional_t<std::is_const_v<Model>, const double, double>;
  std::vector<Number*> places{&model.swing.stiffness_1_s2, &model.start.theta1_rad,
                              &model.start.omega1_rad_s, &model.zero.x_rad};
  if (!planar) {
    places.insert(places.end(),
                  {&model.start.theta2_rad, &model.start.omega2_rad_s, &model.zero.y_rad});
  }
  auto& friction = model.swing.friction;
  if (terms.linear) {
    places.push_back(&friction.linear_per_s);
  }
  if (terms.quadratic) {
    places.push_back(&friction.quadratic_per_rad);
  }
  if (terms.dry) {
    places.push_back(&friction.dry_rad_s2);
  }
  return places;
}

/// The largest tilt that the start leads to, for scales.
double amplitude_rad(const SwingModel& model) {
  const double square = model.swing.stiffness_1_s2;
  return std::sqrt(std::pow(model.start.theta1_rad, 2) + std::pow(model.start.theta2_rad, 2) +
                   (std::pow(model.start.omega1_rad_s, 2) + std::pow(model.start.omega2_rad_s, 2)) /
                       square);
}

std::vector<FitParameter> parameters_of(const SwingModel& guess, const FrictionTerms& terms,
                                        bool planar, double duration_s) {
  // What turns the phase at the series' end by a tenth of a radian or takes a tenth of the
  // amplitude matters.
  constexpr double kShare = 0.1;
  const double omega_rad_s = std::sqrt(guess.swing.stiffness_1_s2);
  const double amplitude = amplitude_rad(guess);
  const double rate_per_s = kShare / duration_s;
  std::vector<FitParameter> parameters{{.name = "stiffness_1_s2",
                                        .scale = 2 * rate_per_s * omega_rad_s,
                                        .low = guess.swing.stiffness_1_s2 / 4,
                                        .high = guess.swing.stiffness_1_s2 * 4}};
  const auto add = [&](const char* name, double scale, double low) {
    FitParameter parameter{.name = name, .scale = scale};
    parameter.low = low;
    parameters.push_back(parameter);
  };
  const double any = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < (planar ? 1 : 2); ++i) {
    add(i == 0 ? "theta1_rad" : "theta2_rad", kShare * amplitude, any);
    add(i == 0 ? "omega1_rad_s" : "omega2_rad_s", kShare * amplitude * omega_rad_s, any);
    add(i == 0 ? "zero1_rad" : "zero2_rad", kShare * amplitude, any);
  }
  // By what each takes off the amplitude in a swing (analysis.md eq. 5).
  if (terms.linear) {
    add("linear_per_s", 2 * rate_per_s, 0);
  }
  if (terms.quadratic) {
    add("quadratic_per_rad", rate_per_s * 3 * std::numbers::pi / (4 * omega_rad_s * amplitude), 0);
  }
  if (terms.dry) {
    add("dry_rad_s2", rate_per_s * std::numbers::pi * omega_rad_s * amplitude / 2, 0);
  }
  const auto places = unknowns(guess, terms, planar);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    parameters[i].start = *places[i];
  }
  return parameters;
}

/// Without the frictions that `terms` does not have.
SwingModel with_terms(SwingModel model, const FrictionTerms& terms) {
  Friction& friction = model.swing.friction;
  friction.linear_per_s = terms.linear ? friction.linear_per_s : 0;
  friction.quadratic_per_rad = terms.quadratic ? friction.quadratic_per_rad : 0;
  friction.dry_rad_s2 = terms.dry ? friction.dry_rad_s2 : 0;
  return model;
}

Eigen::VectorXd misfit(const std::vector<double>& simulated, const std::vector<double>& measured) {
  const auto as_vector = [](const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  };
  return as_vector(measured) - as_vector(simulated);
}

double rms(const Eigen::VectorXd& values) {
  return std::sqrt(values.squaredNorm() /
                   static_cast<double>(std::max<Eigen::Index>(values.size(), 1)));
}

/// The state at the series' start and what decides the path, from its first swings.
SwingModel first_guess(const AngleSeries& series, double period_s,
                       const std::vector<SwingEllipse>& ellipses) {
  // A line of cosine and sine through each angle, as the ellipses have them for the tilt's point.
  const AngleSeries head = series.between(series.t_s.front(), series.t_s.front() + period_s);
  const double omega_rad_s = 2 * std::numbers::pi / period_s;
  const auto rows = static_cast<Eigen::Index>(head.size());
  Eigen::MatrixXd design(rows, 3);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double angle = omega_rad_s * (head.t_s[static_cast<std::size_t>(i)] - head.t_s.front());
    design.row(i) << std::cos(angle), std::sin(angle), 1;
  }
  const auto solve = [&](const std::vector<double>& values) {
    const Eigen::Map<const Eigen::VectorXd> targets(values.data(), rows);
    return fit_linear(design, targets, Eigen::VectorXd::Ones(rows)).factors;
  };
  const Eigen::VectorXd first = solve(head.theta1_rad);
  const Eigen::VectorXd second = solve(head.theta2_rad);
  SwingModel guess;
  guess.start = {.theta1_rad = first[0],
                 .theta2_rad = second[0],
                 .omega1_rad_s = omega_rad_s * first[1],
                 .omega2_rad_s = omega_rad_s * second[1]};
  guess.zero = {.x_rad = first[2], .y_rad = second[2]};
  const double square = ellipses.front().square_rad2();
  guess.swing.stiffness_1_s2 = std::pow(omega_rad_s * (1 + square / 16), 2);
  const double duration_s = ellipses.back().t_s - ellipses.front().t_s;
  const double lost = std::log(
      std::max(ellipses.front().semi_major_rad.value / ellipses.back().semi_major_rad.value, 1.0));
  guess.swing.friction.linear_per_s = duration_s > 0 ? 2 * lost / duration_s : 0;
  return guess;
}

}  // namespace

SwingModel SwingFit::model_of(const Eigen::VectorXd& of_values) const {
  SwingModel changed = model;
  const auto places = unknowns(changed, terms, planar);
  for (std::size_t i = 0; i < places.size(); ++i) {
    *places[i] = of_values[static_cast<Eigen::Index>(i)];
  }
  return changed;
}

Measured SwingFit::figure(const std::function<double(const SwingModel&)>& of) const {
  return propagated(values, covariance,
                    [&](const Eigen::VectorXd& at) { return of(model_of(at)); });
}

AngleSeries simulated_angles(const SwingModel& model, const std::vector<double>& times_s,
                             bool planar) {
  AngleSeries series{.t_s = times_s, .planar = planar};
  for (const SwingState<double>& state : swing_path(model.swing, model.start, times_s)) {
    series.theta1_rad.push_back(state.theta1_rad + model.zero.x_rad);
    series.theta2_rad.push_back(planar ? 0 : state.theta2_rad + model.zero.y_rad);
  }
  return series;
}

tl::expected<SwingFit, Error> fit_swing(const AngleSeries& series, FrictionTerms terms,
                                        const SwingModel& guess, const TiltPoint& noise,
                                        const std::function<bool()>& stopped) {
  SwingFit result{.terms = terms, .planar = series.planar};
  result.model = with_terms(guess, terms);
  const auto rows = static_cast<Eigen::Index>(series.size());
  const auto residuals_of = [&](const Eigen::VectorXd& values, Eigen::VectorXd& residuals) {
    const AngleSeries simulated =
        simulated_angles(result.model_of(values), series.t_s, series.planar);
    residuals.head(rows) = misfit(simulated.theta1_rad, series.theta1_rad) / noise.x_rad;
    if (!series.planar) {
      residuals.tail(rows) = misfit(simulated.theta2_rad, series.theta2_rad) / noise.y_rad;
    }
  };
  const double duration_s = series.t_s.back() - series.t_s.front();
  const auto fit =
      fit_least_squares(parameters_of(result.model, terms, series.planar, duration_s),
                        series.size() * (series.planar ? 1 : 2), residuals_of, stopped);
  if (!fit) {
    return tl::unexpected(fit.error());
  }
  result.model = result.model_of(fit->values);
  result.values = fit->values;
  result.residual1_rad = fit->residuals.head(rows) * noise.x_rad;
  result.noise.x_rad = rms(result.residual1_rad);
  result.repetition = repetition(result.residual1_rad);
  if (!series.planar) {
    result.residual2_rad = fit->residuals.tail(rows) * noise.y_rad;
    result.noise.y_rad = rms(result.residual2_rad);
    result.repetition = std::max(result.repetition, repetition(result.residual2_rad));
  }
  result.chi_square = fit->residuals.squaredNorm();
  result.covariance = fit->covariance * result.repetition;
  return result;
}

tl::expected<SwingFit, Error> fit_from_nothing(const AngleSeries& series, double period_s,
                                               const std::function<bool()>& stopped) {
  const auto ellipses =
      swing_ellipses(series, {.period_s = period_s, .step_s = period_s, .rest = {}, .noise = {}});
  if (ellipses.empty()) {
    return failure("found no whole swing with samples enough");
  }
  SwingModel guess = first_guess(series, period_s, ellipses);
  const double duration_s = series.t_s.back() - series.t_s.front();
  // The phase at the end must be known to less than half a turn before the end can be fitted.
  for (int swings = 3;; swings *= 2) {
    const double span_s = swings * period_s;
    const AngleSeries head = span_s < duration_s
                                 ? series.between(series.t_s.front(), series.t_s.front() + span_s)
                                 : series;
    const double amplitude = ellipses.front().semi_major_rad.value;
    auto fit =
        fit_swing(head, {.linear = true}, guess, {.x_rad = amplitude, .y_rad = amplitude}, stopped);
    if (!fit || span_s >= duration_s) {
      return fit;
    }
    guess = fit->model;
  }
}

}  // namespace penduline
