// SPDX-License-Identifier: Apache-2.0
// From the host's rig to the board's.
#include "host/rig_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <variant>

#include "common/wire/rig_image.hpp"

namespace penduline {
namespace {

std::vector<float> narrowed(std::span<const double> values) {
  return {values.begin(), values.end()};
}

LinearResponse<float> narrowed(const LinearResponse<double>& curve) {
  return {.gap_at_zero_m = static_cast<float>(curve.gap_at_zero_m),
          .slope_m_per_v = static_cast<float>(curve.slope_m_per_v)};
}

TableResponse<float> narrowed(const TableResponse<double>& curve) {
  const std::vector<float> volts = narrowed(curve.gap_over_volts.x());
  const std::vector<float> gaps = narrowed(curve.gap_over_volts.y());
  return {.gap_over_volts = MonotoneCubic<float>(volts, gaps)};
}

InverseSquareResponse<float> narrowed(const InverseSquareResponse<double>& curve) {
  return {.a_v_m2 = static_cast<float>(curve.a_v_m2),
          .b_m = static_cast<float>(curve.b_m),
          .c_v = static_cast<float>(curve.c_v)};
}

PolynomialResponse<float> narrowed(const PolynomialResponse<double>& curve) {
  PolynomialResponse<float> narrow;
  std::ranges::transform(curve.coefficient, narrow.coefficient.begin(),
                         [](double value) { return static_cast<float>(value); });
  narrow.count = curve.count;
  narrow.volts_min = static_cast<float>(curve.volts_min);
  narrow.volts_max = static_cast<float>(curve.volts_max);
  return narrow;
}

Response<float> narrowed(const Response<double>& response) {
  return {
      .model = std::visit([](const auto& curve) { return Response<float>::Model(narrowed(curve)); },
                          response.model),
      .nearest_m = static_cast<float>(response.nearest_m),
      .farthest_m = static_cast<float>(response.farthest_m),
      .peak_m = static_cast<float>(response.peak_m)};
}

SensorNoise<float> narrowed(const SensorNoise<double>& noise) {
  return {.volts = static_cast<float>(noise.volts), .gap_m = static_cast<float>(noise.gap_m)};
}

FilterTrust<float> narrowed(const FilterTrust<double>& trust) {
  return {.length_share = static_cast<float>(trust.length_share),
          .damping_per_s = static_cast<float>(trust.damping_per_s),
          .offset_m = static_cast<float>(trust.offset_m),
          .acceleration_rad_s15 = static_cast<float>(trust.acceleration_rad_s15),
          .damping_walk_per_s15 = static_cast<float>(trust.damping_walk_per_s15),
          .offset_walk_m_s05 = static_cast<float>(trust.offset_walk_m_s05)};
}

}  // namespace

Rig<float> narrowed(const Rig<double>& rig) {
  Rig<float> narrow{.pendulum = {.length_m = static_cast<float>(rig.pendulum.length_m),
                                 .mass_kg = static_cast<float>(rig.pendulum.mass_kg),
                                 .gravity_m_s2 = static_cast<float>(rig.pendulum.gravity_m_s2),
                                 .damping_per_s = static_cast<float>(rig.pendulum.damping_per_s)},
                    .disc_diameter_m = static_cast<float>(rig.disc_diameter_m),
                    .layout = {},
                    .filter = {},
                    .trust = narrowed(rig.trust)};
  narrow.layout.count = rig.layout.count;
  narrow.layout.disc_offset_m = static_cast<float>(rig.layout.disc_offset_m);
  for (std::size_t i = 0; i < rig.layout.count; ++i) {
    narrow.layout.position_m[i] = rig.layout.position_m[i].cast<float>();
    narrow.responses[i] = narrowed(rig.responses[i]);
    narrow.noise[i] = narrowed(rig.noise[i]);
  }
  if (rig.filter) {
    narrow.filter = {.order = rig.filter->order,
                     .cutoff_of_nyquist = static_cast<float>(rig.filter->cutoff_of_nyquist)};
  }
  return narrow;
}

tl::expected<std::vector<std::uint8_t>, Error> rig_image(const Rig<double>& rig,
                                                         wire::OnboardEstimator estimator,
                                                         const std::string& name) {
  std::vector<std::uint8_t> image(wire::kMaxRigImageBytes);
  image.resize(wire::encode_rig({.rig = narrowed(rig), .estimator = estimator}, image));
  if (image.empty()) {
    return failure(fmt::format("{}: the rig takes more than the {} bytes that a board has for it",
                               name, wire::kMaxRigImageBytes));
  }
  if (!wire::decode_rig(image)) {
    return failure(fmt::format("{}: the rig does not work in the board's single precision", name));
  }
  return image;
}

}  // namespace penduline
