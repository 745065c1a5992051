// SPDX-License-Identifier: Apache-2.0
// Sources of samples.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "common/rig.hpp"
#include "common/sample.hpp"
#include "hal/replay/recording_event.hpp"
#include "hal/replay/recording_format.hpp"
#include "hal/replay/voltage_log_reader.hpp"
#include "hal/sim/sampled_rig.hpp"

namespace penduline {

/// What reading a source came to.
enum class ReadResult : std::uint8_t {
  kSample,      ///< the next sample
  kNothingYet,  ///< none for now, perhaps events; there may be more
  kEnded,       ///< none, and there will be none
};

class Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;

  /// What a recording of this source says before its first sample.
  [[nodiscard]] virtual RecordingHeader header() const = 0;
  /// The next sample. A source whose samples come in their own time waits for one for half a second
  /// at the most.
  virtual tl::expected<ReadResult, Error> read(Sample& sample) = 0;
  /// Where the sample read last stands, for messages.
  [[nodiscard]] virtual std::string place() const = 0;
  /// How much has been read, in 0..1; 0 where nobody knows.
  [[nodiscard]] virtual double progress() const = 0;
  /// What is wrong with the source and cost no sample, in words; grows while reading.
  [[nodiscard]] virtual std::vector<std::string> complaints() const = 0;
  /// What happened between the reading before and the last one.
  [[nodiscard]] virtual std::span<const RecordingEvent> events() const { return {}; }
};

/// A recording. The path "-" is the standard input.
[[nodiscard]] tl::expected<std::unique_ptr<Source>, Error> open_recording(const std::string& path);

/// A foreign log of voltages.
[[nodiscard]] tl::expected<std::unique_ptr<Source>, Error> open_voltage_log(
    const std::string& path, const VoltageLogLayout& layout);

/// A simulation of `rig`.
[[nodiscard]] std::unique_ptr<Source> simulate(const Rig<double>& rig,
                                               const SimulationSettings& settings);

/// What the recording of a simulation says before its first sample; without a start time, so that
/// one seed gives one file.
[[nodiscard]] RecordingHeader simulated_header(const SampledRig& rig);

/// In words, that the integrator of a simulation has blown up; empty as long as it has not.
[[nodiscard]] std::vector<std::string> simulation_complaints(const SampledRig& rig);

}  // namespace penduline
