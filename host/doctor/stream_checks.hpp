// SPDX-License-Identifier: Apache-2.0
// Whether all samples come, and in time.
#pragma once

#include "host/doctor/finding.hpp"
#include "host/doctor/survey.hpp"
#include "host/doctor/typed_commands.hpp"

namespace penduline {

/// Rate, lost and late samples, the source's complaints.
[[nodiscard]] Findings check_stream(const Survey& survey, const TypedNames& names);

}  // namespace penduline
