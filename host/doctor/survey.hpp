// SPDX-License-Identifier: Apache-2.0
// A few seconds of samples, as a set-up is judged by.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "common/sample.hpp"
#include "hal/error.hpp"
#include "host/session/stop_signal.hpp"
#include "host/source/source.hpp"

namespace penduline {

/// What one sensor has read, sample by sample, in volts.
struct SensorSurvey {
  std::vector<double> signal_v;   ///< lit less dark, where it is not saturated
  std::vector<double> ambient_v;  ///< dark
  std::uint64_t saturated = 0;    ///< samples of which it is known
};

struct Survey {
  Acquisition<double> acquisition;
  std::uint64_t samples = 0;
  std::uint64_t lost = 0;
  std::uint64_t late = 0;
  std::uint64_t saturated = 0;  ///< samples, whichever sensor it was
  std::array<SensorSurvey, kMaxSensors> sensors{};
  std::string rate_complaint{};           ///< in words; empty where the rate is the nominal one
  std::vector<std::string> complaints{};  ///< of the source, in words
};

/// Reads a source for so many of its seconds, or until it ends or a stop is requested. Fails where
/// reading does.
[[nodiscard]] tl::expected<Survey, Error> survey(Source& source, double seconds,
                                                 const StopSignal& stop);

}  // namespace penduline
