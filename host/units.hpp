// SPDX-License-Identifier: Apache-2.0
// What people read and type angles and gaps in.
#pragma once

#include <numbers>

namespace penduline {

inline constexpr double kMillimetre = 1e-3;                // m
inline constexpr double kMicrometre = 1e-6;                // m
inline constexpr double kDegree = std::numbers::pi / 180;  // rad

}  // namespace penduline
