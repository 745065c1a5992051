// SPDX-License-Identifier: Apache-2.0
// The firmware's version, the project's.
#pragma once

#include <string_view>

namespace penduline {

inline constexpr std::string_view kFirmwareVersion = PENDULINE_VERSION;

}  // namespace penduline
