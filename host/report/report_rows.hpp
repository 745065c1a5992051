// SPDX-License-Identifier: Apache-2.0
// A recording's rows as a report draws them: every moment, or of very many those with the peaks.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/estimate.hpp"
#include "hal/replay/recording_event.hpp"
#include "host/flag_times.hpp"
#include "host/web/live_row.hpp"
#include "host/web/live_rows.hpp"
#include "host/web/peak_keeper.hpp"

namespace penduline {

/// Joins each estimate with the sample of its moment, however much later it comes.
class ReportRows {
 public:
  /// What a browser opens and draws at once.
  static constexpr std::uint64_t kMostRows = 150'000;

  /// `bin_s`: see PeakKeeper.
  ReportRows(const Rig<double>& rig, const Acquisition<double>& acquisition, double bin_s)
      : rows_(rig, acquisition), keeper_(bin_s, rig.layout.count) {}

  void take(const Sample& sample);
  void take(const Estimate<double>& estimate);
  /// Its host's time says how long a restart took.
  void take(const RecordingEvent& event);
  /// All rows that are kept, once.
  [[nodiscard]] std::vector<LiveRow> finish();

  /// The report's time of the sample that was taken last, in seconds.
  [[nodiscard]] double latest_s() const;
  /// When each flag of kFlagDescriptions was seen last, where it was, in the report's time.
  [[nodiscard]] const FlagTimes& flag_latest_s() const { return flag_latest_s_; }

 private:
  struct Waiting {
    Sample sample;
    std::int64_t host_us = 0;
  };

  LiveRows rows_;
  PeakKeeper keeper_;
  SessionTime time_;  ///< of the newest sample, which is ahead of the rows
  std::deque<Waiting> waiting_;
  std::int64_t event_host_us_ = 0;          ///< host's time of the latest event
  std::optional<std::int64_t> event_t_us_;  ///< board's time then; none: the board starts anew
  std::vector<LiveRow> kept_;
  FlagTimes flag_latest_s_{};
};

/// How long bins must be for a recording of so many samples in so many seconds to leave about
/// ReportRows::kMostRows, flagged ones beside; 0 where every row may stay.
[[nodiscard]] double report_bin_s(std::uint64_t samples, double seconds, std::size_t sensors);

}  // namespace penduline
