// SPDX-License-Identifier: Apache-2.0
// A recording's rows as a report draws them: every moment, or of very many those with the peaks.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "common/estimate.hpp"
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
  /// Rows that are further apart, in nominal periods, have a dropout between them: the page's rule.
  static constexpr double kLongestStep = 3.5;

  /// `bin_s`: see PeakKeeper. Where it thins, a row without answers stands in each dropout, since
  /// from row to row it may be farther than over one.
  ReportRows(const Rig<double>& rig, const Acquisition<double>& acquisition, double bin_s)
      : rows_(rig, acquisition),
        keeper_(bin_s, rig.layout.count),
        longest_step_s_(bin_s > 0 ? kLongestStep / acquisition.rate_hz
                                  : std::numeric_limits<double>::infinity()) {}

  /// `host_us`: RecordedTime's.
  void take(const Sample& sample, std::int64_t host_us);
  void take(const Estimate<double>& estimate);
  /// All rows that are kept, once.
  [[nodiscard]] std::vector<LiveRow> finish();

  /// How many rows stand for dropouts.
  [[nodiscard]] std::uint64_t breaks() const { return breaks_; }
  /// When each flag of kFlagDescriptions was seen last, where it was, in the report's time.
  [[nodiscard]] const FlagTimes& flag_latest_s() const { return flag_latest_s_; }

 private:
  struct Waiting {
    Sample sample;
    std::int64_t host_us = 0;
  };

  LiveRows rows_;
  PeakKeeper keeper_;
  double longest_step_s_;
  std::optional<double> last_s_;  ///< the row before
  std::uint64_t breaks_ = 0;
  std::deque<Waiting> waiting_;
  std::vector<LiveRow> kept_;
  FlagTimes flag_latest_s_{};
};

/// How long bins must be for a recording of so many samples in so many seconds to leave about
/// ReportRows::kMostRows, flagged ones beside; 0 where every row may stay.
[[nodiscard]] double report_bin_s(std::uint64_t samples, double seconds, std::size_t sensors);

}  // namespace penduline
