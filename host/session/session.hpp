// SPDX-License-Identifier: Apache-2.0
// A session: samples from a source through an estimator to the outputs, until one of them ends.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hal/replay/recording_event.hpp"
#include "host/estimator/estimator.hpp"
#include "host/output/estimate_sink.hpp"
#include "host/session/device_clock.hpp"
#include "host/session/stop_signal.hpp"
#include "host/session/summary.hpp"
#include "host/source/source.hpp"

namespace penduline {

/// What one turn of a session's loop has brought.
struct SessionTurn {
  bool sample = false;
  std::span<const RecordingEvent> events{};  ///< the source's
  const std::optional<DeviceClock>& clock;   ///< the board's, where it was asked for it
};

/// What takes part in a session.
struct SessionParts {
  Source& source;
  Estimator& estimator;
  EstimateSink& output;
  /// Told every sample before it is used; may be empty.
  std::function<tl::expected<void, Error>(const Sample&)> recorder{};
  /// Told what happened between two samples, in its place among them; may be empty.
  std::function<void(const RecordingEvent&)> note{};
  /// Told several times a second where samples come in their own time, also without any, what has
  /// been counted; may be empty.
  std::function<void(const Summary&)> turned{};
  /// Told every turn of the loop, and once more at its end; tells what has happened beside the
  /// source since the one before. May be empty.
  std::function<std::vector<RecordingEvent>(const SessionTurn&)> beside{};
  /// Told, once for each kind, what is doubtful in the data.
  std::function<void(const std::string&)> warn;
};

struct SessionOptions {
  bool paced = false;           ///< hand on each sample at its own time, not as fast as possible
  bool live = false;            ///< nothing may wait for a terminal: no progress bar
  bool rows_on_stdout = false;  ///< where they show the progress on a terminal
};

struct SessionResult {
  Summary summary;
  std::optional<DeviceClock> clock{};  ///< the board's, where it was asked for it
  bool doubtful = false;               ///< a problem was flagged or complained of
  bool incomplete = false;             ///< an output has failed on the way, which was said
  std::optional<Error> error{};        ///< why it failed; the summary counts what came before
};

/// Runs until the source ends, `stop` is requested or something fails. Ending early by request is
/// no failure.
[[nodiscard]] SessionResult run_session(const SessionParts& parts, const SessionOptions& options,
                                        const StopSignal& stop);

}  // namespace penduline
