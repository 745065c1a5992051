// SPDX-License-Identifier: Apache-2.0
// Counting, and naming.
#include "host/doctor/saturation_check.hpp"

#include <fmt/format.h>

#include <string>

#include "host/doctor/sensor_name.hpp"

namespace penduline {
namespace {

/// Of the samples.
constexpr double kMostSaturated = 0.01;

/// ": sensor Sx in 12, sensor Sy in 1"; "" where it is known of none.
std::string saturated_sensors(const Survey& survey, const std::optional<RigFile>& rig) {
  std::string names;
  for (std::size_t i = 0; i < survey.acquisition.sensor_count; ++i) {
    if (const std::uint64_t count = survey.sensors[i].saturated; count > 0) {
      names +=
          fmt::format("{} sensor {} in {}", names.empty() ? ":" : ",", sensor_name(rig, i), count);
    }
  }
  return names;
}

}  // namespace

Finding check_saturation(const Survey& survey, const std::optional<RigFile>& rig) {
  if (survey.saturated == 0) {
    return {.subject = "saturation", .found = "none"};
  }
  const double share = static_cast<double>(survey.saturated) / static_cast<double>(survey.samples);
  return {.health = share < kMostSaturated ? Health::kDoubtful : Health::kBad,
          .subject = "saturation",
          .found = fmt::format("{} of {} samples reach the end of the ADC's range{}",
                               survey.saturated, survey.samples, saturated_sensors(survey, rig)),
          .advice =
              "take a smaller load resistor or less emitter current (docs/hardware.md), a "
              "larger gap, or shade the sensor"};
}

}  // namespace penduline
