// SPDX-License-Identifier: Apache-2.0
// Which sensor of a sample is saturated.
#pragma once

#include <cstddef>
#include <optional>

#include "common/sample.hpp"

namespace penduline {

/// Whether sensor number `sensor`, from 0, is saturated: the flag is the sample's, and means near
/// the range's end say whose conversions it were. None where one sensor is, and the means do not
/// tell which.
[[nodiscard]] std::optional<bool> is_saturated(const Sample& sample, double full_scale_counts,
                                               std::size_t sensor);

}  // namespace penduline
