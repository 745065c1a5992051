// SPDX-License-Identifier: Apache-2.0
// The words of a rig file.
#include "host/calibration/response_model.hpp"

namespace penduline {

std::string_view model_name(ResponseModel model) {
  switch (model) {
    case ResponseModel::kTable:
      return "table";
    case ResponseModel::kInverseSquare:
      return "inverse_square";
    case ResponseModel::kPolynomial:
      return "polynomial";
    case ResponseModel::kLinear:
      break;
  }
  return "linear";
}

}  // namespace penduline
