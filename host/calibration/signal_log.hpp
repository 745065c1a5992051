// SPDX-License-Identifier: Apache-2.0
// A recording's signals in memory, and their means.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "common/sample.hpp"
#include "hal/error.hpp"

namespace penduline {

/// The signals of a recording, sample by sample.
struct SignalLog {
  std::string path;
  Acquisition<double> acquisition;
  std::vector<double> t_s;  ///< device seconds, rising
  /// Of each sensor; NaN where it is missing or saturated.
  std::vector<std::array<double, kMaxSensors>> volts;
  /// In words: what a replay with --strict would call doubtful, but for angles.
  std::vector<std::string> complaints;

  /// One sensor's signals that there are, from `from_s` up to `to_s`.
  [[nodiscard]] std::vector<double> signals(std::size_t sensor, double from_s, double to_s) const;
};

/// Reads a recording of so many sensors. Fails where it has others, is empty, cannot be read, or
/// its time goes back.
[[nodiscard]] tl::expected<SignalLog, Error> read_signals(const std::string& path,
                                                          std::size_t sensor_count);

/// Reads several.
[[nodiscard]] tl::expected<std::vector<SignalLog>, Error> read_signals(
    const std::vector<std::string>& paths, std::size_t sensor_count);

struct MeanSignal {
  double volts = 0;
  double scatter_v = 0;       ///< standard deviation of one sample
  double slow_scatter_v = 0;  ///< the part of it that is no noise from sample to sample
  std::size_t count = 0;

  /// Of the mean, where the noise is one from sample to sample.
  [[nodiscard]] double standard_error_v() const;
};

/// Mean and scatter; all 0 for no values.
[[nodiscard]] MeanSignal mean_signal(const std::vector<double>& volts);

}  // namespace penduline
