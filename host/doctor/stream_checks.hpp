// SPDX-License-Identifier: Apache-2.0
// Whether all samples come, in time and within the ADC's range.
#pragma once

#include "host/doctor/finding.hpp"
#include "host/doctor/survey.hpp"
#include "host/doctor/typed_commands.hpp"

namespace penduline {

/// Rate, lost and late samples, saturation.
[[nodiscard]] Findings check_stream(const Survey& survey, const TypedNames& names);

}  // namespace penduline
