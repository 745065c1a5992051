// SPDX-License-Identifier: Apache-2.0
// What a finding calls a sensor.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "host/rig_file.hpp"

namespace penduline {

/// The rig's name of it, else its number from 1.
[[nodiscard]] inline std::string sensor_name(const std::optional<RigFile>& rig,
                                             std::size_t sensor) {
  return rig ? rig->sensor_names[sensor] : std::to_string(sensor + 1);
}

}  // namespace penduline
