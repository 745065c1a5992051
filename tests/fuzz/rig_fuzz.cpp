// SPDX-License-Identifier: Apache-2.0
// Any bytes as a rig file: a rig that the pipeline can work with, or one clear message.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "common/closed_form.hpp"
#include "common/pipeline.hpp"
#include "host/rig_file.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace {

using namespace penduline;
using namespace penduline::fuzz;

void check_rig(const Rig<double>& rig) {
  require(rig.pendulum.length_m > 0 && rig.pendulum.mass_kg > 0 && rig.pendulum.gravity_m_s2 > 0 &&
              rig.pendulum.damping_per_s >= 0,
          "a pendulum's numbers are possible");
  require(rig.layout.disc_offset_m > 0 && rig.disc_diameter_m > 0, "a disc's numbers are possible");
  require(rig.layout.count >= 2 && rig.layout.count <= kMaxSensors, "two to eight sensors");
  require(determines_tilt(rig.layout), "the sensors tell the tilt");
  require(!rig.filter || (rig.filter->order < kMaxTaps && rig.filter->cutoff_of_nyquist > 0 &&
                          rig.filter->cutoff_of_nyquist <= 1),
          "a filter fits its taps");
  for (std::size_t i = 0; i < rig.layout.count; ++i) {
    require(rig.layout.position_m[i].allFinite(), "places are finite");
    require(rig.responses[i].nearest_m < rig.responses[i].farthest_m, "a range is not empty");
    require(rig.responses[i].peak_m >= 0, "a peak is not behind the sensor");
  }
}

/// The pipeline keeps its promises over the whole range of the ADC.
void check_pipeline(const Rig<double>& rig) {
  constexpr int kSamples = 100;
  Pipeline<double> pipeline(rig, {.sensor_count = rig.layout.count});
  for (int k = 0; k < kSamples; ++k) {
    Sample sample{.seq = static_cast<std::uint64_t>(k), .t_us = k * 50'000};
    for (std::size_t i = 0; i < rig.layout.count; ++i) {
      sample.readings[i].on = (k + static_cast<int>(i)) * 65535 / (kSamples + 8);
    }
    check_estimate(pipeline.update(sample), sample, rig.pendulum.length_m);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto file = parse_rig(text, "rig.toml");
  if (!file) {
    check_message(file.error().message, "rig.toml:");
    return 0;
  }
  for (const std::string& complaint : file->complaints) {
    check_message(complaint, "rig.toml:");
  }
  require(file->sensor_names.size() == file->rig.layout.count, "each sensor has a name");
  check_rig(file->rig);
  check_pipeline(file->rig);
  return 0;
}
