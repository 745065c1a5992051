// SPDX-License-Identifier: Apache-2.0
// Nested models against each other.
#include "host/analysis/friction_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace penduline {
namespace {

constexpr std::array<FrictionTerms, 8> kModels = {
    {{},
     {.linear = true},
     {.quadratic = true},
     {.linear = true, .quadratic = true},
     {.dry = true},
     {.linear = true, .dry = true},
     {.quadratic = true, .dry = true},
     {.linear = true, .quadratic = true, .dry = true}}};

/// Where a model's fit starts: what the linear friction takes, shared among the model's terms at
/// the mean amplitude (analysis.md eq. 5).
SwingModel shared_out(const SwingFit& linear, const FrictionTerms& terms, double duration_s) {
  SwingModel guess = linear.model;
  if (terms.count() == 0) {
    return guess;
  }
  const double omega_rad_s = std::sqrt(guess.swing.stiffness_1_s2);
  const double rate_per_s = guess.swing.friction.linear_per_s / 2;
  const double start_rad =
      std::hypot(std::hypot(guess.start.theta1_rad, guess.start.theta2_rad),
                 std::hypot(guess.start.omega1_rad_s, guess.start.omega2_rad_s) / omega_rad_s);
  const double amplitude_rad = start_rad * std::exp(-rate_per_s * duration_s / 2);
  const double share_per_s = rate_per_s / terms.count();
  guess.swing.friction = {
      .linear_per_s = 2 * share_per_s,
      .quadratic_per_rad = share_per_s * 3 * std::numbers::pi / (4 * omega_rad_s * amplitude_rad),
      .dry_rad_s2 = share_per_s * std::numbers::pi * omega_rad_s * amplitude_rad / 2};
  return guess;
}

/// For a model that no swing of this kind comes near.
SwingFit no_fit(const SwingFit& other, const FrictionTerms& terms) {
  SwingFit fit = other;
  fit.terms = terms;
  fit.chi_square = std::numeric_limits<double>::infinity();
  fit.values.conservativeResize(other.values.size() - (other.terms.count() - terms.count()));
  return fit;
}

double degrees_of_freedom(const SwingFit& fit, double repetition) {
  const auto rows = static_cast<double>(fit.residual1_rad.size() + fit.residual2_rad.size());
  return std::max(rows / repetition - static_cast<double>(fit.values.size()), 1.0);
}

/// Both fits are weighed alike; `full` has one term more.
FrictionTest f_test(const SwingFit& without, const SwingFit& full) {
  const double freedom = degrees_of_freedom(full, full.repetition);
  const double gained = std::max(without.chi_square - full.chi_square, 0.0);
  FrictionTest test{.f = gained / full.chi_square * freedom};
  if (!std::isfinite(test.f)) {
    return {.f = test.f, .probability = 0};
  }
  const boost::math::fisher_f_distribution<double> distribution(1, freedom);
  test.probability = boost::math::cdf(boost::math::complement(distribution, test.f));
  return test;
}

}  // namespace

tl::expected<FrictionChoice, Error> choose_friction(const AngleSeries& series,
                                                    const SwingFit& linear,
                                                    const std::function<bool()>& stopped) {
  const double duration_s = series.t_s.back() - series.t_s.front();
  // An angle that nothing disturbs is not known better than a thousandth of the other.
  const double larger = std::max({linear.noise.x_rad, linear.noise.y_rad, 1e-9});
  TiltPoint noise{.x_rad = std::max(linear.noise.x_rad, 1e-3 * larger),
                  .y_rad = std::max(linear.noise.y_rad, 1e-3 * larger)};
  const FrictionTerms all{.linear = true, .quadratic = true, .dry = true};
  auto first = fit_swing(series, all, shared_out(linear, all, duration_s), noise, stopped);
  if (!first) {
    return tl::unexpected(first.error());
  }
  // Now that the misfit of the linear model is out of it, the noise itself.
  const double floor = 1e-3 * std::max({first->noise.x_rad, first->noise.y_rad, 1e-9});
  noise = {.x_rad = std::max(first->noise.x_rad, floor),
           .y_rad = std::max(first->noise.y_rad, floor)};
  std::vector<SwingFit> fits;
  for (const FrictionTerms& terms : kModels) {
    SwingModel guess = shared_out(linear, terms, duration_s);
    if (terms == all) {
      guess = first->model;
    }
    auto fit = fit_swing(series, terms, guess, noise, stopped);
    if (!fit && stopped && stopped()) {
      return tl::unexpected(fit.error());
    }
    fits.push_back(fit ? std::move(*fit) : no_fit(*first, terms));
  }
  const SwingFit& full = fits.back();
  if (!std::isfinite(full.chi_square)) {
    return failure("the fit found no minimum: the swing does not follow the equations of motion");
  }
  const auto rows = static_cast<double>(series.size() * (series.planar ? 1 : 2));
  const double independent = rows / full.repetition;
  FrictionChoice choice;
  double least = std::numeric_limits<double>::infinity();
  for (const SwingFit& fit : fits) {
    const double bic = independent * std::log(fit.chi_square / rows) +
                       static_cast<double>(fit.values.size()) * std::log(independent);
    least = std::min(least, bic);
    const double square = std::isfinite(fit.chi_square)
                              ? fit.residual1_rad.squaredNorm() + fit.residual2_rad.squaredNorm()
                              : fit.chi_square;
    choice.candidates.push_back(
        {.terms = fit.terms, .residual_rad = std::sqrt(square / rows), .bic = bic});
  }
  for (FrictionCandidate& candidate : choice.candidates) {
    candidate.bic -= least;
    candidate.supported = candidate.bic <= kBicMargin;
  }
  std::size_t best = kModels.size() - 1;
  for (std::size_t i = kModels.size(); i-- > 0;) {
    // Binary order has linear before quadratic before dry.
    if (choice.candidates[i].supported &&
        (!choice.candidates[best].supported || kModels[i].count() <= kModels[best].count())) {
      best = i;
    }
  }
  choice.chosen = fits[best];
  choice.full = full;
  choice.linear = f_test(fits[6], full);
  choice.quadratic = f_test(fits[5], full);
  choice.dry = f_test(fits[3], full);
  return choice;
}

std::string name_of(const FrictionTerms& terms) {
  std::vector<std::string> names;
  if (terms.linear) {
    names.emplace_back("linear");
  }
  if (terms.quadratic) {
    names.emplace_back("quadratic");
  }
  if (terms.dry) {
    names.emplace_back("dry");
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, " + "));
}

}  // namespace penduline
