// SPDX-License-Identifier: Apache-2.0
// A swing's sine is known from its physics; what the sensors make of it is their response.
#include "host/calibration/swing_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/calibration/static_calibration.hpp"
#include "host/calibration/swing_checks.hpp"
#include "host/calibration/swing_data.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

constexpr std::size_t kCurveDegree = 4;

/// Sensors whose responses are unknown; they stand where the rig says.
class ResponsesUnknown final : public SensorModel {
 public:
  ResponsesUnknown(const RigFile& rig, CurveKind kind, const std::vector<GapRange>& ranges,
                   const std::array<double, kMaxSensors>& gain)
      : rig_(rig) {
    for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
      curves_.emplace_back(kind, ranges[i], kCurveDegree);
      first_.push_back(unknowns_.size());
      add_unknowns(i, ranges[i], gain[i]);
    }
  }

  [[nodiscard]] std::size_t sensor_count() const override { return rig_.rig.layout.count; }
  [[nodiscard]] std::vector<Unknown> unknowns() const override { return unknowns_; }
  [[nodiscard]] double gap_m(std::span<const double> /*numbers*/, std::size_t sensor,
                             const DiscPlane<double>& plane) const override {
    return plane.gap_m(rig_.rig.layout, sensor);
  }
  [[nodiscard]] double volts(std::span<const double> numbers, std::size_t sensor,
                             double gap_m) const override {
    return curves_[sensor].volts(of_sensor(numbers, sensor), gap_m);
  }
  [[nodiscard]] bool readable(std::span<const double> /*numbers*/, std::size_t sensor,
                              double gap_m) const override {
    return gap_m >= nearest_readable_m(rig_.rig.responses[sensor]) &&
           beam_meets_disc(rig_.rig.layout, sensor, gap_m, rig_.rig.disc_diameter_m);
  }

  [[nodiscard]] std::span<const double> of_sensor(std::span<const double> numbers,
                                                  std::size_t sensor) const {
    return numbers.subspan(first_[sensor], curves_[sensor].size());
  }
  [[nodiscard]] const ResponseCurve& curve(std::size_t sensor) const { return curves_[sensor]; }

 private:
  /// The search starts from the rig's response with the gain that the rest signal says.
  void add_unknowns(std::size_t sensor, const GapRange& range, double gain) {
    constexpr std::size_t kPlaces = 30;
    std::vector<double> gaps;
    std::vector<double> signals;
    for (std::size_t k = 0; k < kPlaces; ++k) {
      const double share = static_cast<double>(k) / (kPlaces - 1);
      const double gap_m = range.nearest_m + share * (range.farthest_m - range.nearest_m);
      const double signal = gain * rig_.rig.responses[sensor].volts(gap_m);
      if (signal > 0) {
        gaps.push_back(gap_m);
        signals.push_back(signal);
      }
    }
    const std::vector<double> start = curves_[sensor].nearest_to(gaps, signals);
    const std::vector<std::string> names = curves_[sensor].names();
    const std::vector<double> spreads = curves_[sensor].spreads();
    for (std::size_t k = 0; k < start.size(); ++k) {
      unknowns_.push_back({{.name = rig_.sensor_names[sensor] + " " + names[k],
                            .start = start[k],
                            .scale = spreads[k] / 50},
                           spreads[k]});
    }
  }

  const RigFile& rig_;
  std::vector<ResponseCurve> curves_;
  std::vector<std::size_t> first_;
  std::vector<Unknown> unknowns_;
};

/// The gains that the rest signals tell; fails where a sensor sees nothing.
tl::expected<std::array<double, kMaxSensors>, Error> gains(const RigFile& rig,
                                                           const std::vector<SignalLog>& logs) {
  const auto rest_v = rest_signals(logs, rig.rig.layout.count);
  std::array<double, kMaxSensors> gain{};
  for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
    const double gap_m = DiscPlane<double>(Slopes<double>{}).gap_m(rig.rig.layout, i);
    gain[i] = rest_v[i] / rig.rig.responses[i].volts(gap_m);
    if (!(gain[i] > 0.05 && gain[i] < 20)) {
      return failure(fmt::format(
          "{}: sensor {}: found a middle signal of {:.4f} V, where the rig's response has {:.4f} V "
          "at rest: start from a rig with a typical response, such as docs/rigs/tcrt5000.toml",
          logs.front().path, rig.sensor_names[i], rest_v[i], rig.rig.responses[i].volts(gap_m)));
    }
  }
  return gain;
}

/// The gaps over which the sensors see the disc swing, by the first guess.
std::vector<GapRange> ranges_of(const RigFile& rig, const std::vector<SwingData>& swings) {
  std::vector<GapRange> ranges;
  for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
    const double rest_m = DiscPlane<double>(Slopes<double>{}).gap_m(rig.rig.layout, i);
    double reach_m = 0;
    for (const SwingData& swing : swings) {
      const SwingState<double>& start = swing.start;
      const double omega = std::sqrt(rig.rig.pendulum.gravity_m_s2 / rig.rig.pendulum.length_m);
      const double tilt = std::hypot(std::hypot(start.theta1_rad, start.omega1_rad_s / omega),
                                     std::hypot(start.theta2_rad, start.omega2_rad_s / omega));
      reach_m = std::max(reach_m, rig.rig.layout.position_m[i].head<2>().norm() * std::tan(tilt));
    }
    const double nearest_m =
        std::max({nearest_readable_m(rig.rig.responses[i]), rest_m - reach_m, rest_m / 10});
    ranges.push_back({std::min(nearest_m, rest_m - kMillimetre), rest_m + reach_m});
  }
  return ranges;
}

/// What a sensor has seen, a little beyond it, and not into the fold.
GapRange seen_range(const std::vector<UsedSignal>& used, double nearest_readable) {
  constexpr double kBeyond = 0.05;
  const auto [nearest, farthest] = std::ranges::minmax_element(used, {}, &UsedSignal::gap_m);
  const double beyond_m = kBeyond * (farthest->gap_m - nearest->gap_m);
  return {std::max(nearest->gap_m - beyond_m, nearest_readable), farthest->gap_m + beyond_m};
}

tl::expected<void, Error> add_sensor(const RigFile& rig, std::size_t sensor, const SignalFit& fit,
                                     const ResponsesUnknown& model, const std::string& path,
                                     Calibration& result) {
  constexpr double kNarrowestM = 2e-3;
  const std::string& name = rig.sensor_names[sensor];
  const std::vector<UsedSignal>& used = fit.used[sensor];
  const double readable_m = nearest_readable_m(rig.rig.responses[sensor]);
  const std::string unreadable = fmt::format(
      "without a sound reading, off the disc, or nearer than {:.2f} mm, where the signal folds "
      "back at its peak and two gaps give one signal",
      readable_m / kMillimetre);
  if (auto counted = account_for_left_out(rig, sensor, fit, unreadable, path, result); !counted) {
    return counted;
  }
  const GapRange range = seen_range(used, readable_m);
  if (range.farthest_m - range.nearest_m < kNarrowestM) {
    return failure(fmt::format(
        "{}: sensor {}: found gaps from {:.2f} to {:.2f} mm, expected {:.0f} mm or more: let it "
        "swing in an ellipse, or add a recording of a swing towards this sensor",
        path, name, range.nearest_m / kMillimetre, range.farthest_m / kMillimetre,
        kNarrowestM / kMillimetre));
  }
  const auto numbers = model.of_sensor(fit.sensor_numbers(), sensor);
  if (!keeps_falling(model.curve(sensor), numbers, range)) {
    return failure(
        fmt::format("{}: sensor {}: the signal does not keep falling as the gap grows "
                    "from {:.2f} to {:.2f} mm",
                    path, name, range.nearest_m / kMillimetre, range.farthest_m / kMillimetre));
  }
  const Response<double> response =
      model.curve(sensor).response(numbers, range, rig.rig.responses[sensor].peak_m);
  result.changes.responses[sensor] = response;
  double squares = 0;
  std::vector<double> gaps;
  std::vector<double> volts;
  for (const UsedSignal& signal : used) {
    squares += signal.misfit_m * signal.misfit_m;
    gaps.push_back(signal.gap_m);
    volts.push_back(signal.volts);
  }
  result.notes.push_back(
      fmt::format("{}: {} samples, gaps {:.2f} to {:.2f} mm, residual {:.1f} um RMS", name,
                  used.size(), range.nearest_m / kMillimetre, range.farthest_m / kMillimetre,
                  std::sqrt(squares / static_cast<double>(used.size())) / kMicrometre));
  for (Panel& panel : response_panels(name, response, range, points_curve(gaps, volts))) {
    result.figure.panels.push_back(std::move(panel));
  }
  return {};
}

tl::expected<void, Error> require_known_angles(const SignalFit& fit, const std::string& path) {
  constexpr double kMostDeg = 0.2;
  const double found_deg = fit.angle_sigma_rad / kDegree;
  if (found_deg <= kMostDeg) {
    return {};
  }
  return failure(fmt::format(
      "{}: the swing leaves its amplitude uncertain by {:.2f} deg on one axis, expected {:.1f} or "
      "less: record for longer, let it swing farther and in an ellipse (a push sideways), add a "
      "swing along each axis, or release it at an angle that you know (--released-at)",
      path, found_deg, kMostDeg));
}

}  // namespace

tl::expected<Calibration, Error> calibrate_swing(const RigFile& rig,
                                                 const std::vector<SignalLog>& logs,
                                                 const SwingOptions& options) {
  Pendulum<double> pendulum = rig.rig.pendulum;
  pendulum.length_m = options.length_m.value_or(pendulum.length_m);
  const std::string& path = logs.front().path;
  const auto gain = gains(rig, logs);
  if (!gain) {
    return tl::unexpected(gain.error());
  }
  const auto swings = swing_data(logs, rig.rig, *gain, options.release);
  if (!swings) {
    return tl::unexpected(swings.error());
  }
  if (const auto beyond = require_beyond_fold(rig, *swings); !beyond) {
    return tl::unexpected(beyond.error());
  }
  const ResponsesUnknown model(rig, options.curve, ranges_of(rig, *swings), *gain);
  const auto fit =
      fit_signals(pendulum, options.length_m ? kGivenLengthShare : kRigLengthShare, *swings, model);
  if (!fit) {
    return failure(fmt::format("{}: {}", path, fit.error().message));
  }
  if (const auto good = require_good_swing(*fit, logs, pendulum); !good) {
    return tl::unexpected(good.error());
  }
  Calibration result;
  for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
    if (const auto added = add_sensor(rig, i, *fit, model, path, result); !added) {
      return tl::unexpected(added.error());
    }
  }
  if (const auto known = require_known_angles(*fit, path); !known) {
    return tl::unexpected(known.error());
  }
  result.record.method = "swing";
  result.record.residual_m = fit->residual_m;
  result.notes.push_back(fmt::format(
      "the swing's amplitude is known to {:.3f} deg; effective length {:.5f} +- {:.5f} m, the rig "
      "says {} m",
      fit->angle_sigma_rad / kDegree, fit->fit.values[0], fit->fit.sigma(0),
      rig.rig.pendulum.length_m));
  put_numbers(*fit, result);
  return result;
}

}  // namespace penduline
