// SPDX-License-Identifier: Apache-2.0
// Recording that begins and ends while samples come, as another thread asks for it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "common/sample.hpp"
#include "hal/error.hpp"
#include "hal/replay/recording_event.hpp"
#include "hal/replay/recording_format.hpp"
#include "host/recorder/recorder.hpp"

namespace penduline {

/// Why there is nothing to record or to mark.
inline constexpr const char* kNoSamplesYet = "There are no samples yet: the board is not there.";

/// The disk is waited for by who starts and stops, never by who hands on samples, but for recorders
/// that wait themselves (RecordingQueue::WhenFull::kWait).
class RecordingSwitch {
 public:
  /// Told, in words, what goes wrong and stops nothing (SeriesSettings::warn): of any thread.
  using Warn = std::function<void(const std::string&)>;
  /// Begins a recording of a source of which the header tells, with that to be told its warnings.
  using Begin = std::function<tl::expected<std::unique_ptr<Recorder>, Error>(const RecordingHeader&,
                                                                             const Warn&)>;

  explicit RecordingSwitch(Begin begin) : begin_(std::move(begin)) {}

  /// The source is there, of which `header` tells: from now on recordings may begin.
  void join(const RecordingHeader& header);
  /// Fails where there is a recording, or none can begin.
  tl::expected<void, Error> start();
  /// Ends the present recording and says what became of it. Fails where there is none.
  tl::expected<RecorderReport, Error> stop();

  struct State {
    std::optional<std::string> name{};  ///< of the present file, while there is a recording
    std::optional<std::string> last{};  ///< of the file that was recorded last, or is
    std::int64_t since_utc_us = 0;      ///< when the present recording began
    std::uint64_t samples = 0;          ///< handed to it
  };
  [[nodiscard]] State state() const;
  /// Samples that recordings which have ended did not get.
  [[nodiscard]] std::uint64_t lost() const;

  /// From now on recordings' warnings go to `warn`, and when this returns no more to who was told
  /// them before. None: to nobody.
  void tell_warnings_to(Warn warn);

  /// For the session's thread: what a Recorder takes, as long as there is one.
  tl::expected<void, Error> record(const Sample& sample);
  /// `now` is the source's header behind the event.
  void note(const RecordingEvent& event, const RecordingHeader& now);

 private:
  void warn(const std::string& text);

  Begin begin_;
  std::mutex warning_;   ///< held while one is told
  Warn told_;            ///< none: nobody is
  std::mutex changing_;  ///< one change at a time, which may take long
  mutable std::mutex mutex_;
  std::optional<RecordingHeader> header_;  ///< none: there is no source yet
  std::unique_ptr<Recorder> recorder_;
  State state_;
  std::uint64_t lost_ = 0;
};

}  // namespace penduline
