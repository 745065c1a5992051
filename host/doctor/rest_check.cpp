// SPDX-License-Identifier: Apache-2.0
// The sensor that moves most decides; where none moves, the one whose noise hides most.
#include "host/doctor/rest_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/disc_plane.hpp"
#include "common/dynamics.hpp"
#include "host/calibration/signal_log.hpp"
#include "host/calibration/signal_motion.hpp"
#include "host/doctor/sensor_name.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

/// Motion, RMS of a swing or the whole of a drift, up to which the pendulum hangs still.
constexpr double kMostMotionDeg = 0.1;
/// The same without a rig, as a share of the signal: some 0.1 deg at gaps of millimetres.
constexpr double kMostMotionShare = 0.005;
/// Faster than pendulums swing whose rig is not known: 1 cm of length.
constexpr double kFastestSwingHz = 5;

/// Motion that samples hide, in standard errors of their mean: the drift that `motion_of` takes
/// for noise, 3.3 of the difference of two thirds. Swings show sooner.
constexpr double kHiddenErrors = 8;

/// One sensor's motion, in the unit that its bound has.
struct SeenMotion {
  double swing = 0;
  double swing_hz = 0;
  double drift = 0;
  double noise = 0;
  double hidden = 0;  ///< motion that the noise may hide
  double most = 0;
  std::string_view unit;

  [[nodiscard]] double share_of_most() const { return std::max(swing, drift) / most; }
};

SeenMotion seen(const Survey& survey, std::size_t sensor, double fastest_hz, double unit_v,
                double most, std::string_view unit) {
  const std::vector<double>& volts = survey.sensors[sensor].signal_v;
  const SignalMotion motion = motion_of(volts, survey.acquisition.rate_hz, fastest_hz);
  const double noise = std::min(noise_of(volts), mean_signal(volts).scatter_v) / unit_v;
  const double count =
      std::min(static_cast<double>(volts.size()), kLongestMotionSpanS * survey.acquisition.rate_hz);
  return {.swing = motion.swing_v / unit_v,
          .swing_hz = motion.swing_hz,
          .drift = std::abs(motion.drift_v) / unit_v,
          .noise = noise,
          .hidden = kHiddenErrors * noise / std::sqrt(count),
          .most = most,
          .unit = unit};
}

SeenMotion motion_of_sensor(const Survey& survey, std::size_t sensor,
                            const std::optional<RigFile>& rig) {
  const std::vector<double>& volts = survey.sensors[sensor].signal_v;
  const double fastest_hz = rig ? 2 * small_swing_hz(rig->rig.pendulum) : kFastestSwingHz;
  const double mean_v = mean_signal(volts).volts;
  if (rig) {
    const double slope_m_per_v = std::abs(rig->rig.responses[sensor].slope_m_per_v(mean_v));
    const double v_per_deg = kDegree * tilt_arm_m(rig->rig.layout, sensor) / slope_m_per_v;
    if (std::isfinite(v_per_deg) && v_per_deg > 0) {
      return seen(survey, sensor, fastest_hz, v_per_deg, kMostMotionDeg, "deg");
    }
  }
  return seen(survey, sensor, fastest_hz, std::abs(mean_v) / 100, 100 * kMostMotionShare,
              "% of its signal");
}

Finding too_few(const Survey& survey, const std::string& name, std::size_t count,
                const TypedNames& names) {
  const double usable_hz =
      survey.acquisition.rate_hz * static_cast<double>(count) / static_cast<double>(survey.samples);
  const double seconds = std::clamp(std::ceil(2 * kFewestForMotion / usable_hz), 10.0, 3600.0);
  const std::string_view first = survey.saturated > 0 ? "see to the saturation first; then " : "";
  return {.health = Health::kDoubtful,
          .subject = "pendulum",
          .found = fmt::format("found {} unsaturated samples of sensor {}, expected {} or more: "
                               "whether it hangs still, its zero and its noise cannot be told",
                               count, name, kFewestForMotion),
          .advice = fmt::format("{}look for longer while it hangs still: {}", first,
                                names.again_for(seconds))};
}

Finding moving(const SeenMotion& motion, const std::string& name, const TypedNames& names) {
  const bool swings = motion.swing >= motion.drift;
  const std::string how =
      swings ? fmt::format("swing by {:.2f} {} RMS at {:.2f} Hz", motion.swing, motion.unit,
                           motion.swing_hz)
             : fmt::format("turn or drift by {:.2f} {}", motion.drift, motion.unit);
  return {.health = Health::kDoubtful,
          .subject = "pendulum",
          .found = fmt::format("it is not at rest: sensor {} sees it {}, so neither its zero nor "
                               "its noise can be judged",
                               name, how),
          .advice = fmt::format(
              "{}; then {}",
              swings ? "stop it by hand, keep draughts away and wait until it hangs still"
                     : "let it hang still, untouched, and the sensors warm up for some minutes",
              names.again())};
}

Finding hidden(const Survey& survey, const SeenMotion& motion, const std::string& name,
               const TypedNames& names) {
  const double enough = std::pow(kHiddenErrors * motion.noise / motion.most, 2);
  const double seconds = std::ceil(1.2 * enough / survey.acquisition.rate_hz);
  const std::string longer = seconds < kLongestMotionSpanS && !names.recorded
                                 ? fmt::format("; or look for longer: {}", names.again_for(seconds))
                                 : "";
  return {.health = Health::kDoubtful,
          .subject = "pendulum",
          .found = fmt::format("whether it hangs still is hidden by noise: sensor {} has {:.2f} {} "
                               "RMS from sample to sample, behind which it may move by {:.2f}; so "
                               "its zero cannot be judged",
                               name, motion.noise, motion.unit, motion.hidden),
          .advice = fmt::format("{}{}", kQuietenAdvice, longer)};
}

/// What the mean signal says; none outside the response's range.
std::optional<double> rest_gap_m(const Survey& survey, std::size_t sensor, const RigFile& rig) {
  const GapReading<double> reading =
      rig.rig.responses[sensor].read(mean_signal(survey.sensors[sensor].signal_v).volts);
  return reading.flags == 0 ? reading.gap_m : std::nullopt;
}

}  // namespace

std::optional<double> zero_deg(const Survey& survey, std::size_t sensor, const RigFile& rig) {
  const std::optional<double> gap_m = rest_gap_m(survey, sensor, rig);
  const double arm_m = rig.rig.layout.position_m[sensor].head<2>().norm();
  if (!gap_m || arm_m < kOnAxisM) {
    return std::nullopt;
  }
  const double rest_m = DiscPlane<double>(Slopes<double>{}).gap_m(rig.rig.layout, sensor);
  return (*gap_m - rest_m) / arm_m / kDegree;
}

bool can_be_zeroed(const Survey& survey, const RigFile& rig) {
  for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
    const bool has_gap = rest_gap_m(survey, i, rig).has_value();
    if (!has_gap || std::abs(zero_deg(survey, i, rig).value_or(0)) > kGrossZeroDeg) {
      return false;
    }
  }
  return true;
}

std::optional<RestVerdict> check_rest(const Survey& survey, const std::optional<RigFile>& rig,
                                      const TypedNames& names) {
  std::optional<SeenMotion> most;
  std::optional<SeenMotion> noisiest;
  std::size_t moves_most = 0;
  std::size_t hides_most = 0;
  for (std::size_t i = 0; i < survey.acquisition.sensor_count; ++i) {
    const std::vector<double>& volts = survey.sensors[i].signal_v;
    if (volts.empty() ||
        mean_signal(volts).volts < kNoSignalShare * survey.acquisition.reference_v) {
      continue;
    }
    if (volts.size() < kFewestForMotion) {
      return RestVerdict{.rest = Rest::kUnknown,
                         .finding = too_few(survey, sensor_name(rig, i), volts.size(), names)};
    }
    const SeenMotion motion = motion_of_sensor(survey, i, rig);
    if (!most || motion.share_of_most() > most->share_of_most()) {
      most = motion;
      moves_most = i;
    }
    if (!noisiest || motion.hidden / motion.most > noisiest->hidden / noisiest->most) {
      noisiest = motion;
      hides_most = i;
    }
  }
  if (!most) {
    return std::nullopt;
  }
  if (most->share_of_most() > 1) {
    return RestVerdict{.rest = Rest::kMoving,
                       .finding = moving(*most, sensor_name(rig, moves_most), names)};
  }
  if (noisiest->hidden > noisiest->most) {
    return RestVerdict{.rest = Rest::kHidden,
                       .finding = hidden(survey, *noisiest, sensor_name(rig, hides_most), names)};
  }
  return RestVerdict{
      .rest = Rest::kStill,
      .finding = {.subject = "pendulum",
                  .found = fmt::format("hangs still: no sensor sees it move by {:.1f} {}",
                                       most->most, most->unit)}};
}

}  // namespace penduline
