// SPDX-License-Identifier: Apache-2.0
// The bounds, and the words for what is beyond them.
#include "host/doctor/signal_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/disc_plane.hpp"
#include "host/calibration/signal_log.hpp"
#include "host/calibration/signal_motion.hpp"
#include "host/doctor/rest_check.hpp"
#include "host/doctor/saturation_check.hpp"
#include "host/doctor/sensor_name.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

/// Shares of the ADC's range.
constexpr double kBrightAmbient = 0.2;  // leaves the signal less room than is good
constexpr double kGlaringAmbient = 0.6;
constexpr double kUnsteadyAmbient = 0.02;
constexpr double kWeakSignal = 0.03;  // less than 100 mV of 3.3 V
/// A disc at rest that far from where the rig has it, seen as an angle.
constexpr double kMostZeroDeg = 0.3;
/// Noise beside what the rig says.
constexpr double kMostNoiseRatio = 2;
constexpr double kPercent = 100;
constexpr double kMilli = 1e-3;

std::string percent(double share) {
  return fmt::format("{:.{}f} %", kPercent * share, share < 0.1 ? 1 : 0);
}

/// One sensor's light, in shares of the ADC's range and volts.
class SensorChecks {
 public:
  SensorChecks(const Survey& survey, std::size_t sensor, const std::optional<RigFile>& rig,
               const TypedNames& names, Rest rest, bool may_zero)
      : survey_(survey),
        reference_v_(survey.acquisition.reference_v),
        sensor_(sensor),
        rig_(rig),
        names_(names),
        rest_(rest),
        may_zero_(may_zero),
        name_(sensor_name(rig, sensor)),
        signal_(mean_signal(survey.sensors[sensor].signal_v)),
        noise_v_(std::min(signal_.scatter_v, noise_of(survey.sensors[sensor].signal_v))),
        ambient_(mean_signal(survey.sensors[sensor].ambient_v)) {}

  Findings findings() {
    check_ambient();
    if (check_signal()) {
      if (rest_ == Rest::kStill || rest_ == Rest::kHidden) {
        check_noise();
      }
      if (rig_) {
        check_gap();
      }
    }
    return std::move(findings_);
  }

 private:
  void add(Health health, std::string_view subject, std::string found, std::string advice = "") {
    findings_.push_back({.health = health,
                         .subject = fmt::format("sensor {} {}", name_, subject),
                         .found = std::move(found),
                         .advice = std::move(advice)});
  }

  void check_ambient() {
    const double share = ambient_.volts / reference_v_;
    const std::string found =
        fmt::format("{:.3f} V in the dark phase, {} of the range", ambient_.volts, percent(share));
    const std::string shade =
        "shade the sensor from lamps and the sun; a black tube around it helps most";
    if (ambient_.count == 0) {
      add(Health::kBad, "ambient light", "no reading at all", "check that the sensor is connected");
    } else if (ambient_.volts == 0 && ambient_.scatter_v == 0) {
      add(Health::kDoubtful, "ambient light", "not measured: the dark phase always reads 0",
          "switch the emitters, or the room's light counts as signal: " +
              names_.run("--emitter switched"));
    } else if (share > kGlaringAmbient) {
      add(Health::kBad, "ambient light", found, shade);
    } else if (share > kBrightAmbient) {
      add(Health::kDoubtful, "ambient light", found, shade);
    } else if (ambient_.scatter_v / reference_v_ > kUnsteadyAmbient) {
      add(Health::kDoubtful, "ambient light",
          fmt::format("{}, but unsteady by {}", found, percent(ambient_.scatter_v / reference_v_)),
          "a lamp flickers, or somebody casts a shadow: " + shade);
    } else {
      add(Health::kGood, "ambient light", found);
    }
  }

  /// Whether there is one.
  bool check_signal() {
    const double share = signal_.volts / reference_v_;
    const std::string found =
        fmt::format("{:.3f} V, {} of the range", signal_.volts, percent(share));
    if (signal_.count == 0) {
      add(Health::kBad, "signal", "no reading without saturation",
          "take a smaller load resistor or less emitter current, or a larger gap "
          "(docs/hardware.md)");
      return false;
    }
    if (share < kNoSignalShare) {
      add(Health::kBad, "signal", found + ": no light comes back",
          "look through a phone's camera whether the emitter glows; check its wire and polarity, "
          "and that the disc is in front of the sensor");
      return false;
    }
    if (share < kWeakSignal) {
      add(Health::kDoubtful, "signal", found + ": weak",
          "bring the disc nearer, take a larger load resistor, or a brighter disc");
    } else {
      add(Health::kGood, "signal", found);
    }
    return true;
  }

  void check_noise() {
    if (noise_v_ == 0) {
      add(Health::kDoubtful, "noise",
          fmt::format("it reads {:.4f} V in each of {} samples", signal_.volts, signal_.count),
          "tilt the pendulum by hand and look again: where the signal changes, its noise is less "
          "than the ADC's steps, and all is well; else check the sensor's wires");
      return;
    }
    std::string found = fmt::format("{:.2f} mV RMS from sample to sample", noise_v_ / kMilli);
    if (!rig_) {
      add(Health::kGood, "noise", std::move(found));
      return;
    }
    const Response<double>& response = rig_->rig.responses[sensor_];
    const double slope_m_per_v = std::abs(response.slope_m_per_v(signal_.volts));
    const double gap_m = noise_v_ * slope_m_per_v;
    const double told_m =
        std::hypot(rig_->rig.noise[sensor_].gap_m, rig_->rig.noise[sensor_].volts * slope_m_per_v);
    if (!std::isfinite(gap_m)) {
      add(Health::kDoubtful, "noise",
          fmt::format("{}; the rig's response does not say which gap {:.3f} V is", found,
                      signal_.volts),
          "do first what stands below of this sensor's gap");
      return;
    }
    found += fmt::format(", {:.1f} um of gap", gap_m / kMicrometre);
    if (gap_m > kMostNoiseRatio * told_m) {
      add(Health::kDoubtful, "noise",
          fmt::format("{}, where the rig says {:.1f}", found, told_m / kMicrometre),
          std::string(kQuietenAdvice) + calibration_of_noise());
    } else {
      add(Health::kGood, "noise", std::move(found));
    }
  }

  /// Calibrating zeroes, too.
  [[nodiscard]] std::string calibration_of_noise() const {
    return may_zero_ ? "; if it stays, tell the rig its noise: let it hang still, " +
                           names_.calibrate("rest", "20 s")
                     : "";
  }

  void check_gap() {
    const Response<double>& response = rig_->rig.responses[sensor_];
    const GapReading<double> reading = response.read(signal_.volts);
    if (!reading.gap_m || reading.flags != 0) {
      const bool folded = reading.gap_m && (reading.flags & flag::kFolded) != 0;
      add(Health::kBad, "gap",
          fmt::format("{:.3f} V is {} of the rig's response", signal_.volts,
                      folded ? "at or beyond the peak" : "outside the range"),
          folded ? "move the sensor away from the disc: nearer than the peak two gaps give one "
                   "signal"
                 : "is this the rig file of this pendulum? If so, move the sensor to the gap it "
                   "says, or calibrate anew: let it swing, " +
                       names_.calibrate("swing", "60 s"));
      return;
    }
    const double arm_m = rig_->rig.layout.position_m[sensor_].head<2>().norm();
    const double rest_m = DiscPlane<double>(Slopes<double>{}).gap_m(rig_->rig.layout, sensor_);
    const std::string found = fmt::format("{:.3f} mm on average, {:.3f} at rest by the rig",
                                          *reading.gap_m / kMillimetre, rest_m / kMillimetre);
    if (arm_m < kOnAxisM) {
      add(Health::kDoubtful, "gap",
          fmt::format("{}; by the rig it is {:.1f} mm from the axis, where a tilt does not change "
                      "the gap",
                      found, arm_m / kMillimetre),
          fmt::format("if it is there, move it off the axis (docs/hardware.md); else correct its "
                      "position_m in {}",
                      names_.needed_rig()));
      return;
    }
    const double off_deg = zero_deg(survey_, sensor_, *rig_).value_or(0);
    if (rest_ != Rest::kStill) {
      add(Health::kGood, "gap", found);
    } else if (std::abs(off_deg) > kMostZeroDeg) {
      add(Health::kDoubtful, "gap",
          fmt::format("{}: its zero is off by {:.2f} deg", found, off_deg), zero_advice(off_deg));
    } else {
      add(Health::kGood, "gap",
          fmt::format("{}: zero within {:.2f} deg", found, std::abs(off_deg)));
    }
  }

  [[nodiscard]] std::string zero_advice(double off_deg) const {
    if (std::abs(off_deg) > kGrossZeroDeg) {
      return "that is more than a zero drifts: is this the rig file of this pendulum? If so, see "
             "whether something holds the pendulum, or a sensor has moved";
    }
    return may_zero_
               ? "if nothing touches the pendulum, zero it: " + names_.calibrate("rest", "20 s")
               : "see first to the sensor whose zero is off by much more";
  }

  const Survey& survey_;
  double reference_v_;
  std::size_t sensor_;
  const std::optional<RigFile>& rig_;
  const TypedNames& names_;
  Rest rest_;
  bool may_zero_;
  std::string name_;
  MeanSignal signal_;
  double noise_v_;
  MeanSignal ambient_;
  Findings findings_;
};

}  // namespace

Findings check_sensors(const Survey& survey, const std::optional<RigFile>& rig,
                       const TypedNames& names) {
  Findings findings;
  if (survey.samples == 0) {
    return findings;
  }
  const std::size_t count = survey.acquisition.sensor_count;
  const bool fits = rig && rig->rig.layout.count == count;
  const std::optional<RigFile> fitting = fits ? rig : std::nullopt;
  findings.push_back(check_saturation(survey, fitting));
  if (rig && !fits) {
    findings.push_back({.health = Health::kBad,
                        .subject = "rig",
                        .found = fmt::format("the rig has {} sensors, the samples have {}",
                                             rig->rig.layout.count, count),
                        .advice = "give the rig file of this pendulum"});
  }
  const auto verdict = check_rest(survey, fitting, names);
  if (verdict) {
    findings.push_back(verdict->finding);
  }
  const Rest rest = verdict ? verdict->rest : Rest::kUnknown;
  const bool zeroing = fitting && rest == Rest::kStill && can_be_zeroed(survey, *fitting);
  for (std::size_t i = 0; i < count; ++i) {
    for (Finding& finding : SensorChecks(survey, i, fitting, names, rest, zeroing).findings()) {
      findings.push_back(std::move(finding));
    }
  }
  return findings;
}

}  // namespace penduline
