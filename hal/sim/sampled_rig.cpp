// SPDX-License-Identifier: Apache-2.0
// The simulated ADC: quantization, saturation, lit and dark readings.
#include "hal/sim/sampled_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace penduline {
namespace {

constexpr double kFullScaleCounts = 65535;
constexpr std::uint64_t kEndless = std::numeric_limits<std::uint64_t>::max();

/// Whether a state can be a pendulum's at all.
bool is_physical(const SwingState<double>& state) {
  constexpr double kFastest = 1e6;  // rad/s; false for NaN, too
  return std::isfinite(state.theta1_rad) && std::isfinite(state.theta2_rad) &&
         std::abs(state.omega1_rad_s) < kFastest && std::abs(state.omega2_rad_s) < kFastest;
}

}  // namespace

SampledRig::SampledRig(const Rig<double>& rig, const SimulationSettings& settings)
    : settings_(settings),
      acquisition_{.rate_hz = settings.rate_hz,
                   .full_scale_counts = kFullScaleCounts,
                   .reference_v = settings.reference_v,
                   .sensor_count = rig.layout.count},
      rig_(rig, settings),
      samples_(settings.duration_s ? static_cast<std::uint64_t>(
                                         std::llround(*settings.duration_s * settings.rate_hz))
                                   : kEndless) {}

SampledRig::Conversion SampledRig::convert(std::size_t sensor, bool emitter_lit) {
  const double top_code = std::exp2(settings_.adc_bits) - 1;
  double sum = 0;
  bool clipped = false;
  for (int i = 0; i < settings_.conversions; ++i) {
    const double code =
        std::round(rig_.pin_v(sensor, emitter_lit) / settings_.reference_v * top_code);
    clipped = clipped || code >= top_code;
    sum += std::clamp(code, 0.0, top_code);
  }
  const double mean = sum / settings_.conversions;
  return {.counts = static_cast<std::int32_t>(std::lround(mean / top_code * kFullScaleCounts)),
          .clipped = clipped};
}

tl::expected<bool, Error> SampledRig::read(Sample& sample) {
  if (next_seq_ == samples_) {
    return false;
  }
  sample = Sample{.seq = next_seq_};
  const double t_s = static_cast<double>(next_seq_) / settings_.rate_hz;
  sample.t_us = std::llround(t_s * 1e6);
  rig_.advance_to(t_s);
  if (!is_physical(rig_.truth())) {
    return failure(
        fmt::format("sim: no angles any more at t = {:.3f} s: {}", t_s,
                    settings_.integrator == Integrator::kDopri5
                        ? "the rod has come to lie along the X axis, where theta1 has no value"
                        : "the integrator has run away"));
  }
  for (std::size_t i = 0; i < acquisition_.sensor_count; ++i) {
    const Conversion lit = convert(i, true);
    const Conversion dark = settings_.emitter_switched ? convert(i, false) : Conversion{0, false};
    sample.readings[i] = {.on = lit.counts, .off = dark.counts};
    if (lit.clipped || dark.clipped) {
      sample.flags |= flag::kSaturated;
    }
  }
  ++next_seq_;
  return true;
}

std::string SampledRig::place() const {
  return next_seq_ == 0 ? "sim" : fmt::format("sim: seq {}", next_seq_ - 1);
}

double SampledRig::progress() const {
  return static_cast<double>(next_seq_) / static_cast<double>(samples_);
}

}  // namespace penduline
