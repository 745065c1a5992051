// SPDX-License-Identifier: Apache-2.0
// A calibration in words and columns, for the person who made it.
#pragma once

#include <string>

#include "host/calibration/calibration.hpp"

namespace penduline {

/// Notes, residual, and a table of what was fitted with sigma and strongest correlation.
[[nodiscard]] std::string report_of(const Calibration& calibration);

}  // namespace penduline
