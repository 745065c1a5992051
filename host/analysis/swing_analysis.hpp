// SPDX-License-Identifier: Apache-2.0
// All that a free swing tells of its pendulum, every figure with its uncertainty.
#pragma once

#include <functional>
#include <optional>
#include <tl/expected.hpp>
#include <vector>

#include "host/analysis/comparison.hpp"
#include "host/analysis/friction_choice.hpp"
#include "host/analysis/swing_trends.hpp"

namespace penduline {

struct AnalysisSettings {
  double gravity_m_s2 = 9.8;
  std::optional<double> length_m{};      ///< given: gravity follows from it
  std::optional<double> mass_kg{};       ///< given: energy in joules
  std::optional<double> latitude_rad{};  ///< given: the Earth's rotation
  /// The part to look at; where neither is given the free swing is looked for.
  std::optional<double> from_s{};
  std::optional<double> to_s{};
  /// Asked now and then whether the analysis is to end, as failed; may be empty.
  std::function<bool()> stopped{};
};

/// Amplitude and energy of one swing, measured and as the fitted model has it.
struct DecayPoint {
  double t_s = 0;
  Measured semi_major_rad;
  double model_semi_major_rad = 0;
  double energy_per_mgl = 0;  ///< of the ellipse (analysis.md eq. 6)
  double model_energy_per_mgl = 0;
};

struct SwingAnalysis {
  AngleSeries series;        ///< the part that was analysed
  std::size_t all_rows = 0;  ///< in the file, those left out not counted
  AnalysisSettings settings;
  FrictionChoice friction;
  AngleSeries simulated;  ///< the chosen model's, at the series' times
  std::vector<SwingEllipse> ellipses;
  std::vector<DecayPoint> decay;
  double decay_max_difference = 0;  ///< measured against model, of the starting amplitude
  double decay_rms_difference = 0;

  Measured small_period_s;
  Measured length_m;      ///< for the given gravity
  Measured gravity_m_s2;  ///< for the given length, or as it was given
  std::optional<PeriodTrend> period;

  std::optional<Measured> linear_per_s;  ///< frictions of the chosen model
  std::optional<Measured> quadratic_per_rad;
  std::optional<Measured> dry_rad_s2;
  std::optional<Measured> quality_at_start;  ///< none without friction
  std::optional<Measured> quality_at_end;    ///< nor where it came to rest
  bool came_to_rest = false;  ///< the chosen model's mass, held by dry friction before the end

  Measured semi_major_rad;  ///< of the first swing, by the model
  Measured semi_minor_rad;
  std::optional<Measured> orientation_rad;  ///< -pi/2 to pi/2; none for a planar series
  std::optional<Precession> precession;     ///< none for a planar series
  std::optional<Measured> model_precession_rad_s;
  Measured energy_at_start_per_mgl;  ///< of the model
  Measured energy_at_end_per_mgl;
  Comparison comparison;

  /// The first swing by the model, about where the pendulum rests.
  [[nodiscard]] SwingEllipse first_swing() const;
};

/// Fails, in words, where there is no free swing or no model fits it, and where it is stopped.
[[nodiscard]] tl::expected<SwingAnalysis, Error> analyze_swing(const AngleSeries& series,
                                                               const AnalysisSettings& settings);

}  // namespace penduline
