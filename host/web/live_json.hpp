// SPDX-License-Identifier: Apache-2.0
// What a session is and how it stands, as the live page is told (docs/web_protocol.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/sample.hpp"
#include "hal/replay/recording_event.hpp"
#include "hal/replay/recording_format.hpp"
#include "host/flag_times.hpp"
#include "host/rig_file.hpp"
#include "host/session/summary.hpp"
#include "host/web/swing_now.hpp"

namespace penduline {

/// A recording as the page shows it.
struct RecordingState {
  bool can_record = false;              ///< whether it may be started and stopped
  std::optional<std::string> name{};    ///< of the present file, while there is one
  std::string since_utc{};              ///< when the present recording began
  std::optional<std::string> latest{};  ///< of the file that can be had
  std::uint64_t samples = 0;            ///< handed to the present recording

  bool operator==(const RecordingState&) const = default;
};

/// What does not change with every sample.
struct LiveSubject {
  const RigFile& rig;
  std::string rig_name{};  ///< its file's
  std::string source{};    ///< as typed
  std::string estimator{};
  std::optional<RecordingHeader> header{};  ///< none: there is no source yet
  bool token_needed = false;
};

/// How the session stands.
struct LiveState {
  bool connected = true;
  std::optional<Summary> counts{};
  FlagTimes flag_latest_s{};       ///< of what was counted
  std::optional<Sample> sample{};  ///< the newest
  bool began_with_start = false;   ///< the session's first sample was the board's first, no restart
  std::string clock{};             ///< "": nothing is known
  std::optional<SwingNow> swing{};
};

/// Each is one line without its newline.
[[nodiscard]] std::string session_json(const LiveSubject& subject, const RecordingState& recording);
[[nodiscard]] std::string state_json(const LiveSubject& subject, const LiveState& state,
                                     std::uint64_t recorded_samples);
[[nodiscard]] std::string note_json(const RecordingEvent& event, double t_s);
[[nodiscard]] std::string error_json(std::string_view sentence);

/// An event in words, a sentence for a person.
[[nodiscard]] std::string note_text(const RecordingEvent& event);

}  // namespace penduline
