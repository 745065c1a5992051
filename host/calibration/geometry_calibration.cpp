// SPDX-License-Identifier: Apache-2.0
// Fit, hold what was not determined, fit again.
#include "host/calibration/geometry_calibration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/closed_form.hpp"
#include "host/calibration/geometry_numbers.hpp"
#include "host/calibration/static_calibration.hpp"
#include "host/calibration/swing_checks.hpp"
#include "host/calibration/swing_data.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

constexpr double kWorstGeometryM = 0.2e-3;

/// What a geometry was found from, in gaps of one sensor each.
struct Seen {
  std::size_t sensor = 0;
  double gap_m = 0;  ///< by the rig's response
  double sigma_m = 0;
  DiscPlane<double> plane;
};

/// Every point that the rig's responses can read.
tl::expected<std::vector<Seen>, Error> readable_points(const RigFile& rig,
                                                       const SensorPoints& points,
                                                       Calibration& result) {
  constexpr double kGapSigmaM = 20e-6;
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
    std::size_t left_out = 0;
    for (const SensorPoint& point : points[i]) {
      if (!point.angles) {
        return failure(
            fmt::format("{}: found gaps, expected theta1_deg and theta2_deg: gaps tell "
                        "nothing of where a sensor stands",
                        point.place));
      }
      const Response<double>& response = rig.rig.responses[i];
      const GapReading<double> reading = response.read(point.volts);
      if (!reading.gap_m || reading.flags != 0) {
        ++left_out;
        continue;
      }
      const double noise_m = point.standard_error_v * std::abs(response.slope_m_per_v(point.volts));
      seen.push_back({.sensor = i,
                      .gap_m = *reading.gap_m,
                      .sigma_m = std::hypot(noise_m, kGapSigmaM),
                      .plane = DiscPlane<double>(slopes_of(*point.angles))});
    }
    if (left_out > 0) {
      result.warnings.push_back(fmt::format(
          "sensor {}: {} of {} points are left out: their signals are outside its response's range "
          "or at its fold",
          rig.sensor_names[i], left_out, points[i].size()));
    }
  }
  return seen;
}

Panel residual_panel(const std::string& sensor, const std::vector<UsedSignal>& used) {
  Curve curve{.name = "", .style = CurveStyle::kPoints, .x = {}, .y = {}};
  for (const UsedSignal& signal : used) {
    curve.x.push_back(signal.gap_m / kMillimetre);
    curve.y.push_back(signal.misfit_m / kMicrometre);
  }
  return {.title = sensor + ": residuals",
          .x_label = "gap / mm",
          .y_label = "gap by response less gap by geometry / um",
          .curves = {curve}};
}

/// The part of the record that is the geometry's own.
tl::expected<Calibration, Error> concluded(const RigFile& rig, const GeometryNumbers& numbers,
                                           std::span<const double> found, double residual_m,
                                           Calibration result) {
  if (residual_m > kWorstGeometryM) {
    return failure(
        fmt::format("the best geometry misses the gaps by {:.2f} mm RMS, expected {:.1f} "
                    "mm or less: calibrate the responses by known gaps first",
                    residual_m / kMillimetre, kWorstGeometryM / kMillimetre));
  }
  if (numbers.free_count() == 0) {
    return failure(
        fmt::format("the data tell nothing of the geometry: not determined are {}; "
                    "expected tilts on all sides",
                    fmt::join(numbers.held(), ", ")));
  }
  result.changes = numbers.changes(found, rig.rig.layout.count);
  if (!determines_tilt(changed(rig.rig, result.changes).layout)) {
    return failure("the sensors come to lie on one line through the pivot, expected two sides");
  }
  result.record.method = "geometry";
  result.record.residual_m = residual_m;
  result.record.not_determined = numbers.held();
  if (!numbers.held().empty()) {
    result.notes.push_back(fmt::format("not determined by these data, left as in the rig: {}",
                                       fmt::join(numbers.held(), ", ")));
  }
  return result;
}

std::vector<double> sigmas_of(const Fit& fit, std::size_t first, std::size_t count) {
  std::vector<double> sigmas;
  for (std::size_t i = 0; i < count; ++i) {
    sigmas.push_back(fit.sigma(first + i));
  }
  return sigmas;
}

/// The gaps that a response tells from all others.
GapRange readable_gaps(const Response<double>& response) {
  return {std::max(nearest_readable_m(response), response.nearest_m), response.farthest_m};
}

/// In words, where samples of a sensor are not used.
std::string unreadable_gaps(const RigFile& rig, std::size_t sensor) {
  const GapRange range = readable_gaps(rig.rig.responses[sensor]);
  const std::string where = "without a sound reading, off the disc, or ";
  return where + (std::isfinite(range.farthest_m)
                      ? fmt::format("not at {:.2f} to {:.2f} mm, where its response holds",
                                    range.nearest_m / kMillimetre, range.farthest_m / kMillimetre)
                      : fmt::format("nearer than {:.2f} mm", range.nearest_m / kMillimetre));
}

/// Sensors that stand nobody knows exactly where; their responses are the rig's.
class PlacesUnknown final : public SensorModel {
 public:
  PlacesUnknown(const RigFile& rig, const GeometryNumbers& numbers)
      : rig_(rig), numbers_(numbers) {}

  [[nodiscard]] std::size_t sensor_count() const override { return rig_.rig.layout.count; }
  [[nodiscard]] std::vector<Unknown> unknowns() const override { return numbers_.unknowns(); }
  [[nodiscard]] double gap_m(std::span<const double> numbers, std::size_t sensor,
                             const DiscPlane<double>& plane) const override {
    return numbers_.gap_m(numbers, sensor, plane);
  }
  [[nodiscard]] double volts(std::span<const double> /*numbers*/, std::size_t sensor,
                             double gap_m) const override {
    return rig_.rig.responses[sensor].volts(gap_m);
  }
  [[nodiscard]] bool readable(std::span<const double> /*numbers*/, std::size_t sensor,
                              double gap_m) const override {
    const GapRange range = readable_gaps(rig_.rig.responses[sensor]);
    return gap_m >= range.nearest_m && gap_m <= range.farthest_m &&
           beam_meets_disc(rig_.rig.layout, sensor, gap_m, rig_.rig.disc_diameter_m);
  }

 private:
  const RigFile& rig_;
  const GeometryNumbers& numbers_;
};

}  // namespace

tl::expected<Calibration, Error> calibrate_geometry(const RigFile& rig,
                                                    const SensorPoints& points) {
  Calibration result;
  const auto seen = readable_points(rig, points, result);
  if (!seen) {
    return tl::unexpected(seen.error());
  }
  GeometryNumbers numbers(rig);
  tl::expected<Fit, Error> fit;
  do {
    const std::vector<Unknown> unknowns = numbers.unknowns();
    std::vector<FitParameter> parameters;
    std::ranges::transform(unknowns, std::back_inserter(parameters), &Unknown::parameter);
    if (parameters.empty()) {
      break;
    }
    fit = fit_least_squares(
        parameters, seen->size() + unknowns.size(),
        [&](const Eigen::VectorXd& values, Eigen::VectorXd& residuals) {
          const std::span<const double> at{values.data(), unknowns.size()};
          Eigen::Index row = 0;
          for (const Seen& one : *seen) {
            residuals[row++] = (one.gap_m - numbers.gap_m(at, one.sensor, one.plane)) / one.sigma_m;
          }
          for (std::size_t i = 0; i < unknowns.size(); ++i) {
            residuals[row++] = (at[i] - unknowns[i].parameter.start) / unknowns[i].prior_sigma;
          }
        });
    if (!fit) {
      return tl::unexpected(fit.error());
    }
    // The priors among the residuals are no measurements that could show how small the noise is.
    fit->covariance /= std::min(1.0, fit->scatter * fit->scatter);
  } while (numbers.hold_undetermined(sigmas_of(*fit, 0, numbers.free_count())));
  const std::span<const double> found{fit->values.data(), numbers.free_count()};
  std::array<std::vector<UsedSignal>, kMaxSensors> used;
  double squares = 0;
  for (const Seen& one : *seen) {
    const double misfit_m = one.gap_m - numbers.gap_m(found, one.sensor, one.plane);
    used[one.sensor].push_back({.gap_m = one.gap_m, .volts = 0, .misfit_m = misfit_m});
    squares += misfit_m * misfit_m;
  }
  for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
    result.figure.panels.push_back(residual_panel(rig.sensor_names[i], used[i]));
  }
  for (const Unknown& unknown : numbers.unknowns()) {
    result.record.parameters.push_back(unknown.parameter.name);
  }
  result.record.values = fit->values;
  result.record.covariance = fit->covariance;
  const double residual_m =
      std::sqrt(squares / static_cast<double>(std::max<std::size_t>(seen->size(), 1)));
  return concluded(rig, numbers, found, residual_m, std::move(result));
}

tl::expected<Calibration, Error> calibrate_geometry(const RigFile& rig,
                                                    const std::vector<SignalLog>& logs,
                                                    const SwingOptions& options) {
  Pendulum<double> pendulum = rig.rig.pendulum;
  pendulum.length_m = options.length_m.value_or(pendulum.length_m);
  std::array<double, kMaxSensors> gain{};
  gain.fill(1);
  const auto swings = swing_data(logs, rig.rig, gain, options.release);
  if (!swings) {
    return tl::unexpected(swings.error());
  }
  if (const auto beyond = require_beyond_fold(rig, *swings); !beyond) {
    return tl::unexpected(beyond.error());
  }
  GeometryNumbers numbers(rig);
  tl::expected<SignalFit, Error> fit;
  do {
    const PlacesUnknown model(rig, numbers);
    fit = fit_signals(pendulum, options.length_m ? kGivenLengthShare : kRigLengthShare, *swings,
                      model);
    if (!fit) {
      return failure(fmt::format("{}: {}", logs.front().path, fit.error().message));
    }
  } while (numbers.hold_undetermined(
      sigmas_of(fit->fit, fit->first_sensor_number, numbers.free_count())));
  if (const auto good = require_good_swing(*fit, logs, pendulum); !good) {
    return tl::unexpected(good.error());
  }
  Calibration result;
  for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
    if (const auto counted =
            account_for_left_out(rig, i, *fit, unreadable_gaps(rig, i), logs.front().path, result);
        !counted) {
      return tl::unexpected(counted.error());
    }
    result.figure.panels.push_back(residual_panel(rig.sensor_names[i], fit->used[i]));
  }
  put_numbers(*fit, result);
  return concluded(rig, numbers, fit->sensor_numbers(), fit->residual_m, std::move(result));
}

}  // namespace penduline
