// SPDX-License-Identifier: Apache-2.0
// The same change for each model of a response.
#include "host/calibration/response_change.hpp"

#include <algorithm>
#include <variant>
#include <vector>

namespace penduline {
namespace {

/// The model with the gap of every signal moved by so much.
LinearResponse<double> shifted(LinearResponse<double> model, double by_m) {
  model.gap_at_zero_m += by_m;
  return model;
}
TableResponse<double> shifted(const TableResponse<double>& model, double by_m) {
  const auto volts = model.gap_over_volts.x();
  std::vector<double> gaps(model.gap_over_volts.y().begin(), model.gap_over_volts.y().end());
  std::ranges::for_each(gaps, [&](double& gap) { gap += by_m; });
  return {MonotoneCubic<double>(volts, gaps)};
}
InverseSquareResponse<double> shifted(InverseSquareResponse<double> model, double by_m) {
  model.b_m -= by_m;
  return model;
}
PolynomialResponse<double> shifted(PolynomialResponse<double> model, double by_m) {
  model.coefficient[0] += by_m;
  return model;
}

/// The model with every signal so many times as strong.
LinearResponse<double> amplified(LinearResponse<double> model, double gain) {
  model.slope_m_per_v /= gain;
  return model;
}
TableResponse<double> amplified(const TableResponse<double>& model, double gain) {
  std::vector<double> volts(model.gap_over_volts.x().begin(), model.gap_over_volts.x().end());
  std::ranges::for_each(volts, [&](double& signal) { signal *= gain; });
  return {MonotoneCubic<double>(volts, model.gap_over_volts.y())};
}
InverseSquareResponse<double> amplified(InverseSquareResponse<double> model, double gain) {
  model.a_v_m2 *= gain;
  model.c_v *= gain;
  return model;
}
PolynomialResponse<double> amplified(PolynomialResponse<double> model, double gain) {
  double factor = 1;
  for (double& coefficient : model.coefficient) {
    coefficient *= factor;
    factor /= gain;
  }
  model.volts_min *= gain;
  model.volts_max *= gain;
  return model;
}

}  // namespace

Response<double> shifted(Response<double> response, double by_m) {
  std::visit([&](const auto& model) { response.model = shifted(model, by_m); },
             Response<double>(response).model);
  response.nearest_m = std::max(0.0, response.nearest_m + by_m);
  response.farthest_m += by_m;
  response.peak_m = response.peak_m > 0 ? std::max(0.0, response.peak_m + by_m) : 0;
  return response;
}

Response<double> amplified(Response<double> response, double gain) {
  std::visit([&](const auto& model) { response.model = amplified(model, gain); },
             Response<double>(response).model);
  return response;
}

}  // namespace penduline
