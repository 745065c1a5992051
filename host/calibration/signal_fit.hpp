// SPDX-License-Identifier: Apache-2.0
// Fits what sensors make of a free swing and the swing itself together.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "common/dynamics.hpp"
#include "common/sample.hpp"
#include "hal/error.hpp"
#include "host/fit/least_squares.hpp"
#include "host/units.hpp"

namespace penduline {

/// A number that is looked for, with what is known of it beforehand.
struct Unknown {
  FitParameter parameter;
  double prior_sigma = std::numeric_limits<double>::infinity();  ///< about the start
};

/// How the pendulum was let go: both angles, or the tilt alone.
struct Release {
  std::optional<Angles<double>> angles{};
  double tilt_rad = 0;  ///< where there are no `angles`
  /// How well anybody knows such an angle.
  static constexpr double kSigmaRad = 0.1 * kDegree;
};

/// The signals of one swing.
struct SwingData {
  std::string name;  ///< for messages
  std::vector<double> t_s;
  std::vector<std::array<double, kMaxSensors>> volts;  ///< NaN: none
  std::vector<std::array<bool, kMaxSensors>>
      doubtful;              ///< not to be used before the swing is known
  SwingState<double> start;  ///< about where it was at the first sample
  std::optional<Release> release{};
  double released_s = 0;  ///< about when, where `release` is set
};

/// What sensors make of a tilt, as a function of numbers that a fit looks for.
class SensorModel {
 public:
  SensorModel() = default;
  SensorModel(const SensorModel&) = delete;
  SensorModel& operator=(const SensorModel&) = delete;
  virtual ~SensorModel() = default;

  [[nodiscard]] virtual std::size_t sensor_count() const = 0;
  [[nodiscard]] virtual std::vector<Unknown> unknowns() const = 0;
  [[nodiscard]] virtual double gap_m(std::span<const double> numbers, std::size_t sensor,
                                     const DiscPlane<double>& plane) const = 0;
  [[nodiscard]] virtual double volts(std::span<const double> numbers, std::size_t sensor,
                                     double gap_m) const = 0;
  /// Whether a signal from there tells the gap: beyond the peak, on the disc.
  [[nodiscard]] virtual bool readable(std::span<const double> numbers, std::size_t sensor,
                                      double gap_m) const = 0;
};

/// One sensor's signal as the fit used it.
struct UsedSignal {
  double gap_m = 0;  ///< by the fit
  double volts = 0;
  double misfit_m = 0;
};

/// A swing that has been fitted.
struct SignalFit {
  Fit fit;
  std::vector<std::string> names;       ///< of the fit's numbers
  std::size_t first_sensor_number = 0;  ///< behind the pendulum's and the swings' own
  std::array<std::vector<UsedSignal>, kMaxSensors> used;
  std::array<std::size_t, kMaxSensors> left_out{};
  double residual_m = 0;       ///< RMS misfit of the gaps
  double angle_sigma_rad = 0;  ///< of either axis' amplitude, the worst of all swings
  double release_s = 0;        ///< last release after its recording's begin; below 0: before it

  [[nodiscard]] std::span<const double> sensor_numbers() const {
    return {fit.values.data() + first_sensor_number,
            static_cast<std::size_t>(fit.values.size()) - first_sensor_number};
  }
};

/// How many of a fit's numbers are the pendulum's: its effective length and three of friction.
inline constexpr std::size_t kPendulumNumbers = 4;

/// Fits all swings together, from their beginnings on in windows that grow, since a period that is
/// a little wrong is a phase that is quite wrong later. The length is known to `length_share`.
[[nodiscard]] tl::expected<SignalFit, Error> fit_signals(const Pendulum<double>& pendulum,
                                                         double length_share,
                                                         const std::vector<SwingData>& swings,
                                                         const SensorModel& sensors);

}  // namespace penduline
