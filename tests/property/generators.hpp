// SPDX-License-Identifier: Apache-2.0
// What the properties are tried on: numbers, sensor layouts, tilts, samples.
#pragma once

#include <rapidcheck.h>

#include <cstddef>
#include <cstdint>
#include <limits>

#include "common/closed_form.hpp"
#include "common/disc_plane.hpp"
#include "common/sample.hpp"

namespace penduline::test {

/// A number from least to most, all as likely, in a million steps; shrinks to the least.
inline rc::Gen<double> in_steps(double least, double most) {
  return rc::gen::map(rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 1'000'001)),
                      [=](int step) { return least + (most - least) * step / 1e6; });
}

/// One sensor within 6 cm of the pivot across and 1 cm in height, but not under the rod itself.
inline rc::Gen<Vector3<double>> any_place() {
  return rc::gen::suchThat(
      rc::gen::map(
          rc::gen::tuple(in_steps(-0.06, 0.06), in_steps(-0.06, 0.06), in_steps(-0.01, 0.01)),
          [](const auto& place) {
            return Vector3<double>(std::get<0>(place), std::get<1>(place), std::get<2>(place));
          }),
      [](const Vector3<double>& place) { return place.head<2>().norm() >= 0.02; });
}

/// Two to eight sensors that see the tilt from directions well apart, a disc 0.5 to 3 cm down.
inline rc::Gen<SensorLayout<double>> any_layout() {
  const auto layout = rc::gen::exec([] {
    SensorLayout<double> drawn{.count = *rc::gen::inRange<std::size_t>(2, kMaxSensors + 1),
                               .disc_offset_m = *in_steps(0.005, 0.03)};
    for (std::size_t i = 0; i < drawn.count; ++i) {
      drawn.position_m[i] = *any_place();
    }
    return drawn;
  });
  return rc::gen::suchThat(layout, [](const SensorLayout<double>& drawn) {
    const Matrix2<double> spread = normal_matrix(drawn);
    return spread.determinant() > 0.02 * spread.trace() * spread.trace();
  });
}

inline SensorLayout<float> rounded_layout(const SensorLayout<double>& layout) {
  SensorLayout<float> rounded{.count = layout.count,
                              .disc_offset_m = static_cast<float>(layout.disc_offset_m)};
  for (std::size_t i = 0; i < layout.count; ++i) {
    rounded.position_m[i] = layout.position_m[i].cast<float>();
  }
  return rounded;
}

/// Counts of any size, of the ADC's size, and at the ends of 32 bits.
inline rc::Gen<std::int32_t> any_counts() {
  using Limits = std::numeric_limits<std::int32_t>;
  return rc::gen::weightedOneOf<std::int32_t>(
      {{2, rc::gen::arbitrary<std::int32_t>()},
       {6, rc::gen::inRange(0, 65536)},
       {1, rc::gen::element(Limits::min(), Limits::max(), -1, 0, 65535)}});
}

/// The next samples of a stream: mostly good ones, with every fault that a link can bring.
inline Sample sample_after(const Sample& last) {
  Sample sample;
  const int fault = *rc::gen::inRange(0, 40);
  sample.seq = fault == 1   ? *rc::gen::arbitrary<std::uint64_t>()
               : fault == 2 ? last.seq
                            : last.seq + (fault == 3 ? 2 : 1);
  // Half of 64 bits, so that no difference of two times overflows.
  constexpr std::int64_t kFarthest = std::int64_t{1} << 61;
  sample.t_us = fault == 4 || last.t_us >= kFarthest ? *rc::gen::inRange(-kFarthest, kFarthest)
                                                     : last.t_us + 50'000;
  sample.flags = fault == 5 ? *rc::gen::inRange<Flags>(0, 256) : 0;
  sample.missing = fault == 6 ? *rc::gen::arbitrary<std::uint32_t>() : 0;
  for (Reading& reading : sample.readings) {
    reading = {*any_counts(), fault == 7 ? *any_counts() : 0};
  }
  return sample;
}

}  // namespace penduline::test
