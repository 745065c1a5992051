// SPDX-License-Identifier: Apache-2.0
// An analysis in words and numbers.
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <vector>

#include "host/analysis/analysis_report.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

/// As many decimals as two digits of the sigma need: "0.30012 +- 0.00034".
std::string with_sigma(const Measured& figure, double unit = 1) {
  const double value = figure.value / unit;
  const double sigma = figure.sigma / unit;
  if (!(sigma > 0) || !std::isfinite(sigma)) {
    return fmt::format("{:.6g}", value);
  }
  const int decimals = 1 - static_cast<int>(std::floor(std::log10(sigma)));
  if (decimals < 0 || decimals > 9) {
    return fmt::format("{:.6g} +- {:.2g}", value, sigma);
  }
  return fmt::format("{:.{}f} +- {:.{}f}", value, decimals, sigma, decimals);
}

/// What an analysis has to say, line after line.
class Report {
 public:
  void heading(const std::string& text) {
    fmt::format_to(std::back_inserter(text_), "\n{}\n", text);
    heading_ = text;
  }
  void line(const std::string& name, const std::string& value) {
    fmt::format_to(std::back_inserter(text_), "  {:<26}{}\n", name, value);
    figures_.emplace_back(heading_.empty() ? name : heading_ + ": " + name, value);
  }
  void note(const std::string& text) { fmt::format_to(std::back_inserter(text_), "  {}\n", text); }
  void free(const std::string& text) { text_ += text; }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const AnalysisFigures& figures() const { return figures_; }

 private:
  std::string text_;
  std::string heading_;
  AnalysisFigures figures_;
};

void put_period(const SwingAnalysis& analysis, Report& report) {
  report.heading("Period");
  report.line("of small swings", with_sigma(analysis.small_period_s) + " s");
  if (analysis.settings.length_m) {
    report.line("gravity",
                fmt::format("{} m/s2 (for a length of {:g} m)", with_sigma(analysis.gravity_m_s2),
                            *analysis.settings.length_m));
  } else {
    report.line("effective length",
                fmt::format("{} m (for gravity {:g} m/s2)", with_sigma(analysis.length_m),
                            analysis.settings.gravity_m_s2));
  }
  if (!analysis.period) {
    return;
  }
  report.line(
      "rise with a^2 + b^2",
      fmt::format("{} (theory 0.0625 = 1/16)", with_sigma(analysis.period->coefficient_per_rad2)));
  constexpr std::size_t kMostLines = 8;
  const auto& points = analysis.period->points;
  const std::size_t stride = (points.size() + kMostLines - 1) / kMostLines;
  report.note("amplitude / deg    period / s                theory / s");
  for (std::size_t i = 0; i < points.size(); i += stride) {
    report.note(fmt::format("{:>15.3f}    {:<24}  {:.5f}", points[i].amplitude_rad / kDegree,
                            with_sigma(points[i].period_s), points[i].theory_s));
  }
}

std::string probability(const FrictionTest& test) {
  return test.probability < 1e-6 ? "below 1e-6" : fmt::format("{:.2g}", test.probability);
}

void put_friction(const SwingAnalysis& analysis, Report& report) {
  const FrictionChoice& friction = analysis.friction;
  report.heading("Damping");
  report.line("supported by the data", name_of(friction.chosen.terms));
  std::string also;
  for (const FrictionCandidate& candidate : friction.candidates) {
    if (candidate.supported && candidate.terms != friction.chosen.terms) {
      also += (also.empty() ? "" : "; ") + name_of(candidate.terms);
    }
  }
  if (!also.empty()) {
    report.line("cannot be told from", also);
  }
  if (analysis.linear_per_s) {
    report.line("linear", with_sigma(*analysis.linear_per_s) + " 1/s");
  }
  if (analysis.quadratic_per_rad) {
    report.line("quadratic", with_sigma(*analysis.quadratic_per_rad) + " 1/rad");
  }
  if (analysis.dry_rad_s2) {
    report.line("dry", with_sigma(*analysis.dry_rad_s2) + " rad/s2");
  }
  if (analysis.quality_at_start) {
    report.line("Q at the start", with_sigma(*analysis.quality_at_start));
    report.line("Q at the end", analysis.quality_at_end ? with_sigma(*analysis.quality_at_end)
                                                        : "none: the pendulum came to rest");
  }
  report.note("model                       residual / deg    BIC above the best");
  for (const FrictionCandidate& candidate : friction.candidates) {
    report.note(fmt::format("{:<26}  {:>14.5f}    {:>8.1f}{}", name_of(candidate.terms),
                            candidate.residual_rad / kDegree, candidate.bic,
                            candidate.terms == friction.chosen.terms ? "  chosen" : ""));
  }
  report.note("kind         F of leaving it out    probability by chance");
  for (const auto& [name, test] : {std::pair{"linear", friction.linear},
                                   {"quadratic", friction.quadratic},
                                   {"dry", friction.dry}}) {
    report.note(fmt::format("{:<12}{:>20.4g}    {}", name, test.f, probability(test)));
  }
}

void put_decay(const SwingAnalysis& analysis, Report& report) {
  report.heading("Decay of the amplitude");
  report.note("t / s       measured / deg            model / deg    energy / (m g l)");
  constexpr std::size_t kMostLines = 10;
  const std::size_t stride = (analysis.decay.size() + kMostLines - 1) / kMostLines;
  for (std::size_t i = 0; i < analysis.decay.size(); i += stride) {
    const DecayPoint& point = analysis.decay[i];
    report.note(fmt::format("{:<10.3f}  {:<24}  {:>11.4f}    {:.3e}", point.t_s,
                            with_sigma(point.semi_major_rad, kDegree),
                            point.model_semi_major_rad / kDegree, point.energy_per_mgl));
  }
  report.line(
      "measured against model",
      fmt::format("{:.2f} % of the starting amplitude at most, {:.2f} % RMS",
                  100 * analysis.decay_max_difference, 100 * analysis.decay_rms_difference));
}

void put_ellipse(const SwingAnalysis& analysis, Report& report) {
  report.heading("Ellipse of the first swing, seen from above");
  report.line("semi-major axis", with_sigma(analysis.semi_major_rad, kDegree) + " deg");
  if (analysis.series.planar) {
    report.note("one angle only: width, sense and precession are not known");
    return;
  }
  report.line("semi-minor axis", with_sigma({.value = std::abs(analysis.semi_minor_rad.value),
                                             .sigma = analysis.semi_minor_rad.sigma},
                                            kDegree) +
                                     " deg");
  const bool sense_known =
      std::abs(analysis.semi_minor_rad.value) > 2 * analysis.semi_minor_rad.sigma;
  report.line("sense", !sense_known                        ? "not known: a line"
                       : analysis.semi_minor_rad.value > 0 ? "anticlockwise"
                                                           : "clockwise");
  report.line("major axis from X to Y", with_sigma(*analysis.orientation_rad, kDegree) + " deg");
  report.heading("Precession (anticlockwise above 0)");
  if (!analysis.precession) {
    report.note("not known: the ellipse is too nearly a circle, or too few swings");
    return;
  }
  report.line("measured", with_sigma(analysis.precession->measured_rad_s, kDegree) + " deg/s");
  report.line("of the fitted model",
              with_sigma(*analysis.model_precession_rad_s, kDegree) + " deg/s");
  report.line("Airy, 3/8 omega0 a b",
              fmt::format("{:.5g} deg/s", analysis.precession->airy_rad_s / kDegree));
  if (analysis.settings.latitude_rad) {
    const double earth = foucault_rate_rad_s(*analysis.settings.latitude_rad);
    const Measured& measured = analysis.precession->measured_rad_s;
    const Measured& model = *analysis.model_precession_rad_s;
    report.line("the Earth's rotation", fmt::format("{:.3g} deg/s", earth / kDegree));
    report.line("measured less the model's",
                with_sigma({.value = measured.value - model.value,
                            .sigma = std::hypot(measured.sigma, model.sigma)},
                           kDegree) +
                    " deg/s");
  }
}

void put_comparison(const SwingAnalysis& analysis, Report& report) {
  const Comparison& comparison = analysis.comparison;
  report.heading("Experiment less simulation");
  report.line("RMS", fmt::format("{:.4g} deg", comparison.rms_rad / kDegree));
  report.line("largest", fmt::format("{:.4g} deg at {:.3f} s", comparison.max_rad / kDegree,
                                     comparison.max_at_s));
  report.line("correlation with the next",
              fmt::format("{:.3f} (noise alone: within {:.3f})", comparison.next_correlation,
                          comparison.white_limit));
  report.line("largest within a period",
              fmt::format("{:.3f} at a lag of {:.3f} s", comparison.most_correlation,
                          comparison.most_correlation_lag_s));
  if (comparison.repetition > 2) {
    report.note(fmt::format(
        "The model does not describe everything: residuals repeat each other, as {:.0f}",
        comparison.repetition));
    report.note("equal ones would; all uncertainties here are widened for it.");
  }
  report.line("experiment is late by", with_sigma(comparison.delay_s, 1e-3) + " ms");
}

void put_all(const SwingAnalysis& analysis, const std::string& file, Report& report) {
  report.free(fmt::format("Free swing in {}\n", file));
  report.line("from, to", fmt::format("{:.3f} s, {:.3f} s", analysis.series.t_s.front(),
                                      analysis.series.t_s.back()));
  report.line("rows",
              fmt::format("{} of {} with angles; {} without or with a flag against them",
                          analysis.series.size(), analysis.all_rows, analysis.series.left_out));
  put_period(analysis, report);
  put_friction(analysis, report);
  put_decay(analysis, report);
  report.heading("Energy");
  report.line("at the start", with_sigma(analysis.energy_at_start_per_mgl) + " m g l");
  report.line("at the end", with_sigma(analysis.energy_at_end_per_mgl) + " m g l");
  if (analysis.settings.mass_kg) {
    const double unit_j =
        *analysis.settings.mass_kg * analysis.gravity_m_s2.value * analysis.length_m.value;
    report.line("m g l", fmt::format("{:.4g} J", unit_j));
  }
  put_ellipse(analysis, report);
  put_comparison(analysis, report);
  report.free("\n+- is one standard deviation.\n");
}

}  // namespace

std::string analysis_text(const SwingAnalysis& analysis, const std::string& file) {
  Report report;
  put_all(analysis, file, report);
  return report.text();
}

AnalysisFigures analysis_figures(const SwingAnalysis& analysis) {
  Report report;
  put_all(analysis, "", report);
  return report.figures();
}

}  // namespace penduline
