// SPDX-License-Identifier: Apache-2.0
// Is it still, where does it hang, and what must change for that to be 0.
#include "host/calibration/rest_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/gauss_newton.hpp"
#include "host/calibration/response_change.hpp"
#include "host/calibration/signal_motion.hpp"
#include "host/calibration/static_calibration.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

/// One sensor at rest.
struct RestGap {
  MeanSignal mean;
  double gap_m = 0;       ///< by the rig's response
  double expected_m = 0;  ///< by the rig's geometry
  double sigma_m = 0;     ///< of `gap_m`
  double swing_m = 0;     ///< RMS of what swings about as fast as the pendulum does
  double drift_m = 0;     ///< of what changes more slowly
};

/// One recording's motion, and how long it was looked at.
struct RestMotion {
  SignalMotion motion;
  double seconds = 0;
};

/// Most by which a swing has the means of first and last third differ: a sine's mean over n cycles
/// is at most 1 / (pi n) of its amplitude.
double drift_of_swing_v(const RestMotion& seen) {
  const double cycles = seen.motion.swing_hz * seen.seconds / 3;
  return 2 * std::numbers::sqrt2 * seen.motion.swing_v *
         std::min(1.0, 1 / (std::numbers::pi * cycles));
}

/// Takes the recording's motion into account, as gaps.
void take_motion(const RestMotion& seen, double swing_hz, double slope_m_per_v, RestGap& rest) {
  const bool swings = seen.motion.swing_hz > swing_hz / 2;
  double& swing_or_drift_m = swings ? rest.swing_m : rest.drift_m;
  swing_or_drift_m = std::max(swing_or_drift_m, seen.motion.swing_v * slope_m_per_v);
  const double drift_v = std::abs(seen.motion.drift_v) - (swings ? drift_of_swing_v(seen) : 0);
  rest.drift_m = std::max(rest.drift_m, drift_v * slope_m_per_v);
}

tl::expected<RestGap, Error> rest_gap(const RigFile& rig, const std::vector<SignalLog>& logs,
                                      std::size_t sensor) {
  const Response<double>& response = rig.rig.responses[sensor];
  const std::string& name = rig.sensor_names[sensor];
  const double swing_hz = small_swing_hz(rig.rig.pendulum);
  std::vector<double> volts;
  std::vector<RestMotion> motions;
  for (const SignalLog& log : logs) {
    const std::vector<double> signals = log.signals(sensor, log.t_s.front(), log.t_s.back());
    if (signals.size() < kFewestForMotion) {
      return failure(fmt::format("{}: found {} samples of sensor {}, expected {} or more", log.path,
                                 signals.size(), name, kFewestForMotion));
    }
    const double rate_hz = log.acquisition.rate_hz;
    motions.push_back({.motion = motion_of(signals, rate_hz, 2 * swing_hz),
                       .seconds = static_cast<double>(signals.size()) / rate_hz});
    volts.insert(volts.end(), signals.begin(), signals.end());
  }
  RestGap rest{.mean = mean_signal(volts)};
  const GapReading<double> reading = response.read(rest.mean.volts);
  if (!reading.gap_m || reading.flags != 0) {
    return failure(fmt::format(
        "{}: sensor {}: found {:.4f} V, which is outside its response's range, expected a signal "
        "of the rig's sensor: calibrate it by 'swing' or 'static' first",
        logs.front().path, name, rest.mean.volts));
  }
  const double slope_m_per_v = std::abs(response.slope_m_per_v(rest.mean.volts));
  rest.gap_m = *reading.gap_m;
  rest.expected_m = DiscPlane<double>(Slopes<double>{}).gap_m(rig.rig.layout, sensor);
  rest.sigma_m = rest.mean.standard_error_v() * slope_m_per_v;
  for (const RestMotion& seen : motions) {
    take_motion(seen, swing_hz, slope_m_per_v, rest);
  }
  return rest;
}

/// Degrees that a gap's change means under this sensor.
double degrees_of(const RigFile& rig, std::size_t sensor, double gap_m) {
  return gap_m / tilt_arm_m(rig.rig.layout, sensor) / kDegree;
}

tl::expected<void, Error> require_still(const RigFile& rig, const std::vector<SignalLog>& logs,
                                        std::size_t sensor, const RestGap& rest) {
  constexpr double kMostDeg = 0.03;
  const auto refuse = [&](double found_deg, std::string_view what, std::string_view advice) {
    return failure(fmt::format(
        "{}: the pendulum is not still: sensor {} sees {} by {:.3f} deg, "
        "expected {:.2f} or less: {}",
        logs.front().path, rig.sensor_names[sensor], what, found_deg, kMostDeg, advice));
  };
  if (const double deg = degrees_of(rig, sensor, rest.swing_m); deg > kMostDeg) {
    return refuse(deg, "it move (RMS)", "wait until it hangs still");
  }
  if (const double deg = degrees_of(rig, sensor, rest.drift_m); deg > kMostDeg) {
    return refuse(deg, "it drift", "let it hang still, and the sensors warm up");
  }
  if (const double deg = degrees_of(rig, sensor, rest.sigma_m); deg > kMostDeg) {
    return refuse(deg, "a mean uncertain", "record for longer");
  }
  return {};
}

/// A number of the record and its sigma.
struct Zero {
  std::string name;
  double value = 0;
  double sigma = 0;
};

tl::expected<Zero, Error> apply(ZeroOf zero_of, const RigFile& rig, std::size_t sensor,
                                const RestGap& rest, RigChanges& changes) {
  const std::string& name = rig.sensor_names[sensor];
  const Response<double>& response = rig.rig.responses[sensor];
  const double off_m = rest.gap_m - rest.expected_m;
  if (zero_of == ZeroOf::kHeight) {
    Vector3<double> position = rig.rig.layout.position_m[sensor];
    position.z() += off_m;
    changes.positions_m[sensor] = position;
    return Zero{name + " height_m", position.z(), rest.sigma_m};
  }
  if (zero_of == ZeroOf::kResponse) {
    const auto* inverse = std::get_if<InverseSquareResponse<double>>(&response.model);
    if (inverse != nullptr && inverse->b_m + off_m < 0) {
      return failure(
          fmt::format("sensor {}: a shift by {:.3f} mm takes the pole of its "
                      "inverse_square to a gap above 0: use --zero height",
                      name, -off_m / kMillimetre));
    }
    changes.responses[sensor] = shifted(response, -off_m);
    return Zero{name + " gap_shift_m", -off_m, rest.sigma_m};
  }
  const double expected_v = response.volts(rest.expected_m);
  const double gain = rest.mean.volts / expected_v;
  if (!(gain > 0.1 && gain < 10)) {
    return failure(
        fmt::format("sensor {}: found {:.4f} V at rest, where its response has {:.4f}: "
                    "no change of its light does that",
                    name, rest.mean.volts, expected_v));
  }
  changes.responses[sensor] = amplified(response, gain);
  return Zero{name + " gain", gain, rest.mean.standard_error_v() / std::abs(expected_v)};
}

/// What the rig's angles were at rest, before.
std::string former_zero(const RigFile& rig, const std::vector<RestGap>& rests) {
  std::vector<double> gaps;
  std::ranges::transform(rests, std::back_inserter(gaps), &RestGap::gap_m);
  const auto solved = GaussNewton<double>(rig.rig.layout).solve(gaps);
  if (!solved) {
    return "no angles fit the gaps that the rig as it was gives at rest";
  }
  const Angles<double> angles = angles_of(solved->slopes);
  return fmt::format("the rig as it was gives theta1 = {:.3f}, theta2 = {:.3f} deg at rest",
                     angles.theta1_rad / kDegree, angles.theta2_rad / kDegree);
}

}  // namespace

tl::expected<Calibration, Error> calibrate_rest(const RigFile& rig,
                                                const std::vector<SignalLog>& logs,
                                                ZeroOf zero_of) {
  Calibration result;
  std::vector<RestGap> rests;
  const auto count = static_cast<Eigen::Index>(rig.rig.layout.count);
  result.record.method = "rest";
  result.record.values.resize(count);
  result.record.covariance = Eigen::MatrixXd::Zero(count, count);
  double squares = 0;
  for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
    const auto rest = rest_gap(rig, logs, i);
    if (!rest) {
      return tl::unexpected(rest.error());
    }
    if (const auto still = require_still(rig, logs, i, *rest); !still) {
      return tl::unexpected(still.error());
    }
    const auto zero = apply(zero_of, rig, i, *rest, result.changes);
    if (!zero) {
      return tl::unexpected(zero.error());
    }
    constexpr double kLeastNoiseV = 10e-6;  // an ADC's steps may hide all of it
    result.changes.noise_v[i] = std::max(rest->mean.scatter_v, kLeastNoiseV);
    const auto at = static_cast<Eigen::Index>(i);
    result.record.parameters.push_back(zero->name);
    result.record.values[at] = zero->value;
    result.record.covariance(at, at) = zero->sigma * zero->sigma;
    const double slope = rig.rig.responses[i].slope_m_per_v(rest->mean.volts);
    squares += std::pow(rest->mean.scatter_v * slope, 2);
    result.notes.push_back(fmt::format(
        "{}: {} samples, {:.5f} V, scatter {:.2f} mV; a gap of {:.4f} mm where the rig has {:.4f}, "
        "{:+.1f} um",
        rig.sensor_names[i], rest->mean.count, rest->mean.volts, rest->mean.scatter_v / kMillimetre,
        rest->gap_m / kMillimetre, rest->expected_m / kMillimetre,
        (rest->gap_m - rest->expected_m) / kMicrometre));
    rests.push_back(*rest);
  }
  result.record.residual_m = std::sqrt(squares / static_cast<double>(count));
  result.notes.push_back(former_zero(rig, rests));
  const Rig<double> after = changed(rig.rig, result.changes);
  for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
    const double gap_m = DiscPlane<double>(Slopes<double>{}).gap_m(after.layout, i);
    const GapRange range{std::max(nearest_readable_m(after.responses[i]), gap_m / 2), gap_m * 1.5};
    for (Panel& panel : response_panels(rig.sensor_names[i], after.responses[i], range,
                                        points_curve({gap_m}, {rests[i].mean.volts}))) {
      result.figure.panels.push_back(std::move(panel));
    }
  }
  return result;
}

}  // namespace penduline
