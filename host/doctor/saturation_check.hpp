// SPDX-License-Identifier: Apache-2.0
// Whether the light stays within the ADC's range.
#pragma once

#include <optional>

#include "host/doctor/finding.hpp"
#include "host/doctor/survey.hpp"
#include "host/rig_file.hpp"

namespace penduline {

/// Of all sensors; names those that are known to be saturated. There must be a sample.
[[nodiscard]] Finding check_saturation(const Survey& survey, const std::optional<RigFile>& rig);

}  // namespace penduline
