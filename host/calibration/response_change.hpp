// SPDX-License-Identifier: Apache-2.0
// A response after its sensor was moved, or its light has changed.
#pragma once

#include "common/response.hpp"

namespace penduline {

/// The response with the gap of every signal moved by so much.
[[nodiscard]] Response<double> shifted(Response<double> response, double by_m);

/// The response with every signal `gain` times as strong; above 0.
[[nodiscard]] Response<double> amplified(Response<double> response, double gain);

}  // namespace penduline
