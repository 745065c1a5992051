// SPDX-License-Identifier: Apache-2.0
// An analysis as JSON.
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/analysis/analysis_report.hpp"

namespace penduline {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_of(const Measured& figure) {
  return {{"value", number(figure.value)}, {"sigma", number(figure.sigma)}};
}

Json no_figure() {
  return {{"value", nullptr}, {"sigma", nullptr}};
}

Json json_of(const std::optional<Measured>& figure) {
  return figure ? json_of(*figure) : Json(nullptr);
}

Json json_of(const FrictionTest& test) {
  return {{"f", number(test.f)}, {"probability", number(test.probability)}};
}

Json json_of(const FrictionTerms& terms) {
  Json names = Json::array();
  for (const auto& [name, there] :
       {std::pair{"linear", terms.linear}, {"quadratic", terms.quadratic}, {"dry", terms.dry}}) {
    if (there) {
      names.push_back(name);
    }
  }
  return names;
}

Json period_of(const SwingAnalysis& analysis) {
  Json points = Json::array();
  if (analysis.period) {
    for (const PeriodPoint& point : analysis.period->points) {
      points.push_back({{"amplitude_rad", number(point.amplitude_rad)},
                        {"period_s", json_of(point.period_s)},
                        {"theory_s", number(point.theory_s)}});
    }
  }
  return {{"small_swing_s", json_of(analysis.small_period_s)},
          {"length_m", json_of(analysis.length_m)},
          {"gravity_m_s2", json_of(analysis.gravity_m_s2)},
          {"amplitude_coefficient_per_rad2",
           analysis.period ? json_of(analysis.period->coefficient_per_rad2) : Json(nullptr)},
          {"theory_coefficient_per_rad2", 1.0 / 16},
          {"against_amplitude", points}};
}

Json damping_of(const SwingAnalysis& analysis) {
  const FrictionChoice& friction = analysis.friction;
  Json models = Json::array();
  for (const FrictionCandidate& candidate : friction.candidates) {
    models.push_back({{"terms", json_of(candidate.terms)},
                      {"residual_rad", number(candidate.residual_rad)},
                      {"bic_above_best", number(candidate.bic)},
                      {"supported", candidate.supported}});
  }
  return {{"chosen", json_of(friction.chosen.terms)},
          {"linear_per_s", json_of(analysis.linear_per_s)},
          {"quadratic_per_rad", json_of(analysis.quadratic_per_rad)},
          {"dry_rad_s2", json_of(analysis.dry_rad_s2)},
          {"q_at_start", json_of(analysis.quality_at_start)},
          {"q_at_end", analysis.came_to_rest ? no_figure() : json_of(analysis.quality_at_end)},
          {"came_to_rest", analysis.came_to_rest},
          {"models", models},
          {"leaving_out",
           {{"linear", json_of(friction.linear)},
            {"quadratic", json_of(friction.quadratic)},
            {"dry", json_of(friction.dry)}}}};
}

Json decay_of(const SwingAnalysis& analysis) {
  Json points = Json::array();
  for (const DecayPoint& point : analysis.decay) {
    points.push_back({{"t_s", point.t_s},
                      {"semi_major_rad", json_of(point.semi_major_rad)},
                      {"model_semi_major_rad", number(point.model_semi_major_rad)},
                      {"energy_per_mgl", number(point.energy_per_mgl)},
                      {"model_energy_per_mgl", number(point.model_energy_per_mgl)}});
  }
  return {{"max_difference_of_start", number(analysis.decay_max_difference)},
          {"rms_difference_of_start", number(analysis.decay_rms_difference)},
          {"swings", points}};
}

Json energy_of(const SwingAnalysis& analysis) {
  const auto unit_j = analysis.settings.mass_kg
                          ? number(*analysis.settings.mass_kg * analysis.gravity_m_s2.value *
                                   analysis.length_m.value)
                          : Json(nullptr);
  return {{"at_start_per_mgl", json_of(analysis.energy_at_start_per_mgl)},
          {"at_end_per_mgl", json_of(analysis.energy_at_end_per_mgl)},
          {"mgl_j", unit_j}};
}

Json ellipse_of(const SwingAnalysis& analysis) {
  const bool planar = analysis.series.planar;
  return {{"semi_major_rad", json_of(analysis.semi_major_rad)},
          {"semi_minor_rad", planar ? Json(nullptr) : json_of(analysis.semi_minor_rad)},
          {"orientation_rad", json_of(analysis.orientation_rad)}};
}

Json precession_of(const SwingAnalysis& analysis) {
  if (!analysis.precession) {
    return nullptr;
  }
  const auto& latitude = analysis.settings.latitude_rad;
  return {{"measured_rad_s", json_of(analysis.precession->measured_rad_s)},
          {"model_rad_s", json_of(analysis.model_precession_rad_s)},
          {"airy_rad_s", number(analysis.precession->airy_rad_s)},
          {"earth_rad_s", latitude ? number(foucault_rate_rad_s(*latitude)) : Json(nullptr)}};
}

Json comparison_of(const SwingAnalysis& analysis) {
  const Comparison& comparison = analysis.comparison;
  return {{"rms_rad", number(comparison.rms_rad)},
          {"max_rad", number(comparison.max_rad)},
          {"max_at_s", comparison.max_at_s},
          {"next_correlation", number(comparison.next_correlation)},
          {"most_correlation", number(comparison.most_correlation)},
          {"most_correlation_lag_s", number(comparison.most_correlation_lag_s)},
          {"white_limit", number(comparison.white_limit)},
          {"repetition", number(comparison.repetition)},
          {"delay_s", json_of(comparison.delay_s)}};
}

Json simulation_of(const SwingAnalysis& analysis) {
  const SwingModel& model = analysis.friction.chosen.model;
  return {{"t_s", analysis.series.t_s.front()},
          {"theta1_rad", model.start.theta1_rad},
          {"theta2_rad", model.start.theta2_rad},
          {"omega1_rad_s", model.start.omega1_rad_s},
          {"omega2_rad_s", model.start.omega2_rad_s},
          {"zero1_rad", model.zero.x_rad},
          {"zero2_rad", model.zero.y_rad}};
}

}  // namespace

std::string analysis_json(const SwingAnalysis& analysis, const std::string& file) {
  const Json json{{"penduline_analysis", 1},
                  {"file", file},
                  {"from_s", analysis.series.t_s.front()},
                  {"to_s", analysis.series.t_s.back()},
                  {"rows", analysis.series.size()},
                  {"rows_left_out", analysis.series.left_out},
                  {"planar", analysis.series.planar},
                  {"period", period_of(analysis)},
                  {"damping", damping_of(analysis)},
                  {"decay", decay_of(analysis)},
                  {"energy", energy_of(analysis)},
                  {"ellipse", ellipse_of(analysis)},
                  {"precession", precession_of(analysis)},
                  {"start", simulation_of(analysis)},
                  {"residuals", comparison_of(analysis)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace penduline
