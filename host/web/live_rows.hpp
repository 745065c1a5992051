// SPDX-License-Identifier: Apache-2.0
// From samples and estimates to the rows that the live page draws.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/rig.hpp"
#include "host/web/live_feed.hpp"
#include "host/web/live_row.hpp"
#include "host/web/session_time.hpp"

namespace penduline {

/// A filter's estimate is of an earlier moment than the sample that went in last. So a row has the
/// readings of the sample that is nearest to the estimate's moment, half a period off at most.
class LiveRows {
 public:
  LiveRows(const Rig<double>& rig, const Acquisition<double>& acquisition)
      : rig_(rig), acquisition_(acquisition) {}

  /// The board samples otherwise from now on.
  void set_acquisition(const Acquisition<double>& acquisition) { acquisition_ = acquisition; }

  /// The next row; none where it would be no later than the one before.
  std::optional<LiveRow> next(const LiveSample& live);

  [[nodiscard]] const SessionTime& time() const { return time_; }

 private:
  [[nodiscard]] const Sample& nearest(std::int64_t t_us) const;
  void put_readings(const Sample& sample, LiveRow& row) const;

  const Rig<double>& rig_;
  Acquisition<double> acquisition_;
  SessionTime time_;
  std::deque<Sample> samples_;  ///< the last ones since the board's start
  std::optional<double> last_s_;
};

}  // namespace penduline
