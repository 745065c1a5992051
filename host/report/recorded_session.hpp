// SPDX-License-Identifier: Apache-2.0
// All of a recording, as its report shows it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"
#include "host/estimator/estimator.hpp"
#include "host/rig_file.hpp"
#include "host/session/stop_signal.hpp"
#include "host/source/source.hpp"
#include "host/web/live_json.hpp"
#include "host/web/live_row.hpp"

namespace penduline {

/// How many samples, and from the first to the last how many seconds of their clock.
struct Extent {
  std::uint64_t samples = 0;
  double seconds = 0;
  double start_s = 0;  ///< board's time of the first sample, at which the report's is 0
};

/// Reads the source to its end, or until a stop is requested. Fails as reading does.
[[nodiscard]] tl::expected<Extent, Error> extent_of(Source& source, const StopSignal& stop);

/// What a recording's session has come to.
struct RecordedSession {
  std::vector<LiveRow> rows;
  std::uint64_t breaks = 0;  ///< rows that only stand for dropouts
  std::vector<std::string> notes;
  LiveState state;
  std::string sensors;  ///< JSON, see SensorTotals
  bool doubtful = false;
};

/// What of it was analysed, in seconds of the board's clock.
struct AnalysedSpan {
  double from_s = 0;  ///< where its first swing begins, too
  double first_swing_to_s = 0;
  double to_s = 0;
};

/// One JSON object of docs/web_protocol.md's kind, in the report's time, which is 0 at the board's
/// `start_s`.
[[nodiscard]] std::string recorded_json(const RecordedSession& recorded,
                                        const std::optional<AnalysedSpan>& span, double start_s);

/// How it is read.
struct RecordedReading {
  const RigFile& rig;
  EstimatorOptions estimator;
  double bin_s = 0;  ///< see PeakKeeper
  std::function<void(const std::string&)> warn;
};

/// Fails as reading and estimating do. Ending early by request is no failure.
[[nodiscard]] tl::expected<RecordedSession, Error> read_recorded_session(
    Source& source, const RecordedReading& reading, const StopSignal& stop);

}  // namespace penduline
