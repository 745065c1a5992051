// SPDX-License-Identifier: Apache-2.0
// Marks that viewers set, on their way into the session's events.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"
#include "hal/linux/host_time.hpp"
#include "hal/replay/recording_event.hpp"
#include "host/session/device_clock.hpp"

namespace penduline {

class Marks {
 public:
  /// Notes a mark of this moment. Fails where too many wait to be taken. Of any thread.
  tl::expected<void, Error> set(std::string_view text);

  /// The events `mark` since they were taken the last time, with the board's time where its clock
  /// is known.
  [[nodiscard]] std::vector<RecordingEvent> take(const std::optional<DeviceClock>& clock);

 private:
  struct Mark {
    HostTime moment;
    std::string text;
  };

  static constexpr std::size_t kMostWaiting = 64;

  std::mutex mutex_;
  std::vector<Mark> waiting_;
};

/// What somebody typed as one line of 200 bytes at most, cut between two characters of UTF-8.
[[nodiscard]] std::string mark_text(std::string_view typed);

}  // namespace penduline
