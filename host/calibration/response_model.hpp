// SPDX-License-Identifier: Apache-2.0
// The models of a sensor's response that points can be fitted to.
#pragma once

#include <string_view>

namespace penduline {

enum class ResponseModel { kTable, kInverseSquare, kPolynomial, kLinear };

/// What a rig file calls it.
[[nodiscard]] std::string_view model_name(ResponseModel model);

}  // namespace penduline
