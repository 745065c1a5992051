// SPDX-License-Identifier: Apache-2.0
// What samples say of the sensors: the light, the noise, and with a rig the gaps.
#pragma once

#include <optional>

#include "host/doctor/finding.hpp"
#include "host/doctor/survey.hpp"
#include "host/doctor/typed_commands.hpp"
#include "host/rig_file.hpp"

namespace penduline {

/// Each sensor's ambient light, signal and noise; where a rig with as many sensors is given, its
/// gap at rest, too.
[[nodiscard]] Findings check_sensors(const Survey& survey, const std::optional<RigFile>& rig,
                                     const TypedNames& names);

}  // namespace penduline
