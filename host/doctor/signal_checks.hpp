// SPDX-License-Identifier: Apache-2.0
// What samples say of a set-up: the stream, the light, the noise, and with a rig the gaps.
#pragma once

#include <optional>

#include "host/doctor/finding.hpp"
#include "host/doctor/survey.hpp"
#include "host/rig_file.hpp"

namespace penduline {

/// Rate, lost and late samples, saturation.
[[nodiscard]] Findings check_stream(const Survey& survey);

/// Each sensor's ambient light, signal and noise; where a rig with as many sensors is given, its
/// gap at rest, too.
[[nodiscard]] Findings check_sensors(const Survey& survey, const std::optional<RigFile>& rig);

}  // namespace penduline
