// SPDX-License-Identifier: Apache-2.0
// What samples say of the sensors: saturation, light, whether the pendulum rests, noise, gaps.
#pragma once

#include <optional>

#include "host/doctor/finding.hpp"
#include "host/doctor/survey.hpp"
#include "host/doctor/typed_commands.hpp"
#include "host/rig_file.hpp"

namespace penduline {

/// Saturation, each sensor's ambient light and signal, and whether the pendulum hangs still. Where
/// it does, or noise hides whether it does, each sensor's noise; where a rig with as many sensors
/// is given, its gap, and if still its zero, too.
[[nodiscard]] Findings check_sensors(const Survey& survey, const std::optional<RigFile>& rig,
                                     const TypedNames& names);

}  // namespace penduline
