// SPDX-License-Identifier: Apache-2.0
// From angles to figures: the free part, its fit, and what follows from both.
#include "host/analysis/swing_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/analysis/free_span.hpp"

namespace penduline {
namespace {

tl::expected<FreeSpan, Error> span_to_analyse(const AngleSeries& series,
                                              const AnalysisSettings& settings) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  if (!settings.from_s && !settings.to_s) {
    return find_free_span(series);
  }
  const AngleSeries part =
      series.between(settings.from_s.value_or(-kAny), settings.to_s.value_or(kAny));
  const double period_s = strongest_period_s(part);
  const double found_s = part.size() < 2 ? 0 : part.t_s.back() - part.t_s.front();
  if (!(period_s > 0) || found_s < kFewestSwings * period_s) {
    return failure(fmt::format(
        "found {:.3g} s of angles from {} to {}, expected at least {} swings", found_s,
        settings.from_s ? fmt::format("{} s", *settings.from_s) : "the beginning",
        settings.to_s ? fmt::format("{} s", *settings.to_s) : "the end", kFewestSwings));
  }
  return FreeSpan{.from_s = part.t_s.front(), .to_s = part.t_s.back(), .period_s = period_s};
}

double small_period_of(const SwingModel& model) {
  return 2 * std::numbers::pi / std::sqrt(model.swing.stiffness_1_s2);
}

/// How swings of a fitted model are cut: about where it rests.
SwingCut cut_of(const SwingFit& fit) {
  const double period_s = small_period_of(fit.model);
  return {.period_s = period_s,
          .step_s = period_s,
          .rest = tilt_point(fit.model.zero.x_rad, fit.model.zero.y_rad),
          .noise = TiltPoint{.x_rad = fit.noise.y_rad, .y_rad = fit.noise.x_rad}};
}

/// Energy over m g l of the state that an unfinished swing is in.
double energy_per_mgl(const SwingState<double>& state, const FreeSwing& swing) {
  const Pendulum<double> pendulum{
      .length_m = 1, .mass_kg = 1 / swing.stiffness_1_s2, .gravity_m_s2 = swing.stiffness_1_s2};
  return energy_j(state, pendulum);
}

/// Energy at moments after the model's start.
std::vector<double> energies(const SwingModel& model, double start_s,
                             const std::vector<double>& times_s) {
  std::vector<double> times{start_s};
  times.insert(times.end(), times_s.begin(), times_s.end());
  std::vector<double> result;
  for (const SwingState<double>& state : swing_path(model.swing, model.start, times)) {
    result.push_back(energy_per_mgl(state, model.swing));
  }
  result.erase(result.begin());
  return result;
}

/// Whether dry friction holds the mass at a moment after the start.
bool rests_at(const SwingModel& model, double time_s) {
  const SwingState<double> state =
      swing_path(model.swing, model.start, std::array{0.0, time_s}).back();
  return state.omega1_rad_s == 0 && state.omega2_rad_s == 0;
}

/// 2 pi over what a swing loses of its energy's logarithm, from `from_s` after the start on.
double quality(const SwingModel& model, double from_s) {
  const double period_s = small_period_of(model);
  const auto energy = energies(model, 0, {from_s, from_s + period_s});
  return 2 * std::numbers::pi / std::log(energy[0] / energy[1]);
}

/// The model's own first swing.
std::vector<SwingEllipse> first_ellipses(const SwingModel& model, double duration_s, bool planar) {
  constexpr int kRowsPerSwing = 32;
  const double period_s = small_period_of(model);
  std::vector<double> times;
  for (int i = 0; i * period_s <= duration_s * kRowsPerSwing; ++i) {
    times.push_back(i * period_s / kRowsPerSwing);
  }
  SwingModel from_rest = model;
  from_rest.zero = {};
  return swing_ellipses(simulated_angles(from_rest, times, planar),
                        {.period_s = period_s,
                         .step_s = period_s,
                         .rest = TiltPoint{},
                         .noise = TiltPoint{.x_rad = 1, .y_rad = 1}});
}

/// The rate of the model's ellipse in the middle of the swing's time.
double model_precession_of(const SwingModel& model, double duration_s) {
  const auto ellipses = first_ellipses(model, duration_s, false);
  Eigen::VectorXd angles(static_cast<Eigen::Index>(ellipses.size()));
  std::ranges::transform(ellipses, angles.begin(),
                         [](const SwingEllipse& ellipse) { return ellipse.orientation_rad.value; });
  return middle_rate_rad_s(ellipses, angles, Eigen::VectorXd::Ones(angles.size())).value;
}

void describe_ellipse(SwingAnalysis& analysis) {
  const SwingFit& fit = analysis.friction.chosen;
  const bool planar = analysis.series.planar;
  const double one_swing_s = 1.01 * small_period_of(fit.model);
  const auto of_first = [&](Measured SwingEllipse::*figure) {
    return fit.figure([&, planar](const SwingModel& model) {
      return (first_ellipses(model, one_swing_s, planar).front().*figure).value;
    });
  };
  analysis.semi_major_rad = of_first(&SwingEllipse::semi_major_rad);
  if (planar) {
    return;
  }
  analysis.semi_minor_rad = of_first(&SwingEllipse::semi_minor_rad);
  const double near = first_ellipses(fit.model, one_swing_s, false).front().orientation_rad.value;
  Measured orientation = fit.figure([&](const SwingModel& model) {
    const double angle = first_ellipses(model, one_swing_s, false).front().orientation_rad.value;
    return near + std::remainder(angle - near, std::numbers::pi);
  });
  orientation.value = std::remainder(orientation.value, std::numbers::pi);
  analysis.orientation_rad = orientation;
  const double omega0_rad_s = std::sqrt(fit.model.swing.stiffness_1_s2);
  analysis.precession = precession(analysis.ellipses, omega0_rad_s);
  const double duration_s = analysis.series.t_s.back() - analysis.series.t_s.front();
  if (analysis.precession) {
    analysis.model_precession_rad_s =
        fit.figure([&](const SwingModel& model) { return model_precession_of(model, duration_s); });
  }
}

void describe_friction(SwingAnalysis& analysis) {
  const SwingFit& fit = analysis.friction.chosen;
  const auto figure = [&](double Friction::*term) {
    return fit.figure([&](const SwingModel& model) { return model.swing.friction.*term; });
  };
  if (fit.terms.linear) {
    analysis.linear_per_s = figure(&Friction::linear_per_s);
  }
  if (fit.terms.quadratic) {
    analysis.quadratic_per_rad = figure(&Friction::quadratic_per_rad);
  }
  if (fit.terms.dry) {
    analysis.dry_rad_s2 = figure(&Friction::dry_rad_s2);
  }
  if (fit.terms.count() > 0) {
    const double duration_s = analysis.series.t_s.back() - analysis.series.t_s.front();
    const double last_s = duration_s - small_period_of(fit.model);
    analysis.quality_at_start =
        fit.figure([](const SwingModel& model) { return quality(model, 0); });
    analysis.came_to_rest = rests_at(fit.model, duration_s);
    if (!analysis.came_to_rest) {
      analysis.quality_at_end =
          fit.figure([&](const SwingModel& model) { return quality(model, last_s); });
    }
  }
}

void describe_decay(SwingAnalysis& analysis) {
  const SwingFit& fit = analysis.friction.chosen;
  const SwingCut cut = cut_of(fit);
  analysis.ellipses = swing_ellipses(analysis.series, cut);
  const auto by_model = swing_ellipses(analysis.simulated, cut);
  std::vector<double> middles(by_model.size());
  std::ranges::transform(by_model, middles.begin(), &SwingEllipse::t_s);
  const auto energy = energies(fit.model, analysis.series.t_s.front(), middles);
  double squares = 0;
  for (std::size_t i = 0; i < analysis.ellipses.size(); ++i) {
    const SwingEllipse& ellipse = analysis.ellipses[i];
    const double difference = ellipse.semi_major_rad.value - by_model[i].semi_major_rad.value;
    squares += difference * difference;
    analysis.decay_max_difference = std::max(analysis.decay_max_difference, std::abs(difference));
    analysis.decay.push_back({.t_s = ellipse.t_s,
                              .semi_major_rad = ellipse.semi_major_rad,
                              .model_semi_major_rad = by_model[i].semi_major_rad.value,
                              .energy_per_mgl = 2 - std::cos(ellipse.semi_major_rad.value) -
                                                std::cos(ellipse.semi_minor_rad.value),
                              .model_energy_per_mgl = energy[i]});
  }
  if (!by_model.empty()) {
    const double start_rad = by_model.front().semi_major_rad.value;
    analysis.decay_max_difference /= start_rad;
    analysis.decay_rms_difference =
        std::sqrt(squares / static_cast<double>(by_model.size())) / start_rad;
  }
}

void describe_period(SwingAnalysis& analysis) {
  const SwingFit& fit = analysis.friction.chosen;
  analysis.small_period_s = fit.figure(small_period_of);
  const double gravity_m_s2 = analysis.settings.gravity_m_s2;
  analysis.gravity_m_s2 = {.value = gravity_m_s2};
  if (analysis.settings.length_m) {
    analysis.length_m = {.value = *analysis.settings.length_m};
    analysis.gravity_m_s2 = fit.figure([&](const SwingModel& model) {
      return model.swing.stiffness_1_s2 * *analysis.settings.length_m;
    });
  } else {
    analysis.length_m = fit.figure(
        [&](const SwingModel& model) { return gravity_m_s2 / model.swing.stiffness_1_s2; });
  }
  analysis.period = period_trend(analysis.ellipses, analysis.small_period_s.value);
}

}  // namespace

SwingEllipse SwingAnalysis::first_swing() const {
  const TiltPoint& zero = friction.chosen.model.zero;
  SwingEllipse swing;
  swing.t_s = series.t_s.front() + small_period_s.value / 2;
  swing.semi_major_rad = semi_major_rad;
  swing.semi_minor_rad = semi_minor_rad;
  swing.orientation_rad = orientation_rad.value_or(Measured{});
  swing.centre = tilt_point(zero.x_rad, zero.y_rad);
  return swing;
}

tl::expected<SwingAnalysis, Error> analyze_swing(const AngleSeries& series,
                                                 const AnalysisSettings& settings) {
  const auto span = span_to_analyse(series, settings);
  if (!span) {
    return tl::unexpected(span.error());
  }
  SwingAnalysis analysis;
  analysis.series = series.between(span->from_s, span->to_s);
  analysis.all_rows = series.size();
  analysis.settings = settings;
  const auto linear = fit_from_nothing(analysis.series, span->period_s, settings.stopped);
  if (!linear) {
    return tl::unexpected(linear.error());
  }
  auto friction = choose_friction(analysis.series, *linear, settings.stopped);
  if (!friction) {
    return tl::unexpected(friction.error());
  }
  analysis.friction = std::move(*friction);
  const SwingFit& fit = analysis.friction.chosen;
  analysis.simulated = simulated_angles(fit.model, analysis.series.t_s, series.planar);
  describe_decay(analysis);
  describe_period(analysis);
  describe_friction(analysis);
  describe_ellipse(analysis);
  const double duration_s = analysis.series.t_s.back() - analysis.series.t_s.front();
  const auto energy_after = [&](double seconds) {
    return fit.figure(
        [&](const SwingModel& model) { return energies(model, 0, {seconds}).front(); });
  };
  analysis.energy_at_start_per_mgl = energy_after(0);
  analysis.energy_at_end_per_mgl = energy_after(duration_s);
  analysis.comparison = compare_with_simulation(analysis.series, fit);
  return analysis;
}

}  // namespace penduline
