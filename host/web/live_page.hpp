// SPDX-License-Identifier: Apache-2.0
// The live page's data: from what the session left to the events that viewers get.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "host/web/live_events.hpp"
#include "host/web/live_feed.hpp"
#include "host/web/live_json.hpp"
#include "host/web/live_points.hpp"
#include "host/web/live_rows.hpp"
#include "host/web/peak_keeper.hpp"

namespace penduline {

/// Of one thread, the web server's. Every event is made once, whoever watches.
class LivePage {
 public:
  using Clock = std::chrono::steady_clock;

  /// Up to this rate every sample is shown; above it those of PeakKeeper, in bins of `kBinS`.
  static constexpr double kMostHz = 100;
  static constexpr double kBinS = 0.02;
  /// Of samples' periods; more is a dropout.
  static constexpr double kLongestStep = 3.5;
  static constexpr double kNoEnd = std::numeric_limits<double>::infinity();

  /// `recording` is asked at each turn.
  LivePage(LiveFeed& feed, LiveSubject subject, std::function<RecordingState()> recording);

  /// Takes what has come and makes events of it; to be called some 20 times a second.
  void turn(Clock::time_point now);

  /// What a new viewer gets first: session, the last minute's points in slices that even a slow
  /// network brings one by one, the last notes, state.
  [[nodiscard]] std::string greeting() const;
  /// What a viewer gets that has missed events: session and state.
  [[nodiscard]] std::string resumption() const;
  [[nodiscard]] const LiveEvents& events() const { return events_; }

 private:
  void take_header(const RecordingHeader& header);
  void take_samples();
  void take_row(const LiveRow& row);
  void take_notes();
  /// The session's time of what a note tells.
  [[nodiscard]] double moment_s(const LiveNote& note) const;
  void keep_rows();
  void tell_session();
  void tell_points(std::uint64_t from);
  void tell_state(Clock::time_point now);

  LiveFeed& feed_;
  LiveSubject subject_;
  std::function<RecordingState()> recording_;
  LiveNews news_;
  LiveRows rows_;
  PeakKeeper keeper_;
  double longest_step_s_ = kNoEnd;  ///< from row to row, where they are thinned
  std::optional<double> last_s_;    ///< the row before
  std::vector<LiveRow> kept_;
  LivePoints points_;
  std::deque<std::string> notes_;
  LiveState state_;
  bool state_changed_ = true;
  std::uint64_t recorded_samples_ = 0;
  std::string session_text_;  ///< the newest event of its kind, as are the others
  std::string state_text_;
  Clock::time_point state_told_at_;
  Clock::time_point commented_at_;
  LiveEvents events_;
};

}  // namespace penduline
