// SPDX-License-Identifier: Apache-2.0
// Reading a recording as a whole.
#include "host/calibration/signal_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/continuity.hpp"
#include "common/flags.hpp"
#include "hal/replay/recording_reader.hpp"
#include "host/flag_counts.hpp"
#include "host/session/summary.hpp"

namespace penduline {
namespace {

/// What is to be said against a sample, as a replay says it.
Flags doubts(const Sample& sample, std::size_t sensor_count, Continuity& continuity) {
  Flags flags = sample.flags | continuity.follow(sample).flags;
  for (std::size_t i = 0; i < sensor_count; ++i) {
    flags |= sample.has_reading(i) ? 0 : flag::kMissing;
  }
  return flags & ~flag::kOrdinary;
}

}  // namespace

std::vector<double> SignalLog::signals(std::size_t sensor, double from_s, double to_s) const {
  std::vector<double> found;
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    if (t_s[i] >= from_s && t_s[i] <= to_s && std::isfinite(volts[i][sensor])) {
      found.push_back(volts[i][sensor]);
    }
  }
  return found;
}

tl::expected<SignalLog, Error> read_signals(const std::string& path, std::size_t sensor_count) {
  constexpr double kMicro = 1e-6;
  auto reader = RecordingReader::open(path);
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  SignalLog log{
      .path = path, .acquisition = reader->acquisition(), .t_s = {}, .volts = {}, .complaints = {}};
  if (log.acquisition.sensor_count != sensor_count) {
    return failure(fmt::format("{}: found {} sensors, expected the rig's {}", path,
                               log.acquisition.sensor_count, sensor_count));
  }
  Summary summary(log.acquisition);
  Continuity continuity(log.acquisition.longest_step_us());
  FlagCounts flagged;
  Sample sample;
  while (true) {
    const auto more = reader->read(sample);
    if (!more) {
      return tl::unexpected(more.error());
    }
    if (!*more) {
      break;
    }
    const double t_s = static_cast<double>(sample.t_us) * kMicro;
    if (!log.t_s.empty() && t_s <= log.t_s.back()) {
      return failure(fmt::format("{}: the time goes back, expected one run without a restart",
                                 reader->place()));
    }
    summary.count(sample);
    flagged.count(doubts(sample, sensor_count, continuity));
    std::array<double, kMaxSensors> volts{};
    for (std::size_t i = 0; i < sensor_count; ++i) {
      const bool usable = sample.has_reading(i) && (sample.flags & flag::kSaturated) == 0;
      volts[i] = usable ? signal_v(sample.readings[i], log.acquisition)
                        : std::numeric_limits<double>::quiet_NaN();
    }
    log.t_s.push_back(t_s);
    log.volts.push_back(volts);
  }
  if (log.t_s.empty()) {
    return failure(fmt::format("{}: found no samples", path));
  }
  log.complaints = reader->complaints();
  if (const std::string doubtful = flagged.text(); !doubtful.empty()) {
    log.complaints.push_back(
        fmt::format("{}: {} samples; flagged: {}", path, summary.samples(), doubtful));
  }
  if (const auto complaint = summary.rate_complaint()) {
    log.complaints.push_back(fmt::format("{}: {}", path, *complaint));
  }
  return log;
}

tl::expected<std::vector<SignalLog>, Error> read_signals(const std::vector<std::string>& paths,
                                                         std::size_t sensor_count) {
  std::vector<SignalLog> logs;
  for (const std::string& path : paths) {
    auto log = read_signals(path, sensor_count);
    if (!log) {
      return tl::unexpected(log.error());
    }
    logs.push_back(std::move(*log));
  }
  return logs;
}

double MeanSignal::standard_error_v() const {
  return count > 0 ? scatter_v / std::sqrt(static_cast<double>(count)) : 0;
}

MeanSignal mean_signal(const std::vector<double>& volts) {
  MeanSignal mean{.count = volts.size()};
  if (volts.empty()) {
    return mean;
  }
  const auto count = static_cast<double>(volts.size());
  mean.volts = std::accumulate(volts.begin(), volts.end(), 0.0) / count;
  double squares = 0;
  double step_squares = 0;
  for (std::size_t i = 0; i < volts.size(); ++i) {
    squares += (volts[i] - mean.volts) * (volts[i] - mean.volts);
    step_squares += i > 0 ? (volts[i] - volts[i - 1]) * (volts[i] - volts[i - 1]) : 0;
  }
  if (volts.size() > 1) {
    const double variance = squares / (count - 1);
    // Half the mean squared step is the variance of what is new in each sample (von Neumann).
    const double new_variance = step_squares / (2 * (count - 1));
    mean.scatter_v = std::sqrt(variance);
    mean.slow_scatter_v = std::sqrt(std::max(0.0, variance - new_variance));
  }
  return mean;
}

}  // namespace penduline
