// SPDX-License-Identifier: Apache-2.0
// Degrees, for what a person reads or types.
#pragma once

#include <numbers>

namespace penduline {

/// In radians.
inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace penduline
