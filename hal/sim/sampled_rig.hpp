// SPDX-License-Identifier: Apache-2.0
// Samples of a simulated rig, as a board's ADC would take them.
#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>

#include "common/rig.hpp"
#include "common/sample.hpp"
#include "hal/sample_source.hpp"
#include "hal/sim/simulated_rig.hpp"

namespace penduline {

/// A simulated rig as a SampleSource. The pendulum stands still during a sample's window.
class SampledRig {
 public:
  SampledRig(const Rig<double>& rig, const SimulationSettings& settings);

  [[nodiscard]] const Acquisition<double>& acquisition() const { return acquisition_; }

  /// The next sample; false after the duration. Fails, naming the time, where the integrator has
  /// run away to what no pendulum does.
  tl::expected<bool, Error> read(Sample& sample);

  /// The true state of the pendulum at the last sample's time.
  [[nodiscard]] SwingState<double> truth() const { return rig_.truth(); }
  [[nodiscard]] double blown_up_at_s() const { return rig_.blown_up_at_s(); }
  /// "sim: seq N" of the sample read last; "sim" before the first.
  [[nodiscard]] std::string place() const;
  [[nodiscard]] double progress() const;

 private:
  /// A mean of conversions, with whether one of them was clipped at the top.
  struct Conversion {
    std::int32_t counts;
    bool clipped;
  };
  Conversion convert(std::size_t sensor, bool emitter_lit);

  SimulationSettings settings_;
  Acquisition<double> acquisition_;
  SimulatedRig rig_;
  std::uint64_t samples_;
  std::uint64_t next_seq_ = 0;
};

static_assert(SampleSource<SampledRig>);

}  // namespace penduline
