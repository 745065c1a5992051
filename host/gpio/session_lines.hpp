// SPDX-License-Identifier: Apache-2.0
// All lines of a rig, for one session: reset, magnet, light and trigger.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hal/linux/gpio.hpp"
#include "hal/linux/host_time.hpp"
#include "hal/replay/recording_event.hpp"
#include "host/gpio/board_reset.hpp"
#include "host/gpio/release_magnet.hpp"
#include "host/gpio/status_light.hpp"
#include "host/gpio/trigger_input.hpp"
#include "host/gpio_section.hpp"
#include "host/session/session.hpp"
#include "host/source/board_source.hpp"

namespace penduline {

/// What a run wants of its rig's lines.
struct LineSettings {
  /// The magnet holds from the beginning and lets go so long after the first sample; else its line
  /// is left alone.
  std::optional<std::chrono::microseconds> release_after{};
  bool record_trigger = false;  ///< else its line is left alone
};

/// Who is told, by the thread of the session.
struct LineListener {
  std::function<void(const std::string&)> say;
  std::function<void(const std::string&)> warn;
};

class SessionLines {
 public:
  /// Opens the lines that the rig has, to be held until this goes. Fails where one cannot be had.
  static tl::expected<std::unique_ptr<SessionLines>, Error> open(Gpio& gpio, const RigLines& rig,
                                                                 const LineSettings& settings,
                                                                 LineListener listener);

  /// Resets the board, where there is a line for it; takes a tenth of a second.
  tl::expected<void, Error> reset_board();

  /// Resets a board that does not talk, see BoardReset.
  void attempted(BoardAttempt attempt);

  /// One turn of the session's loop: the light, the start of the magnet's time; the events
  /// `release` and `trigger` since the last turn.
  std::vector<RecordingEvent> turn(const SessionTurn& turn);

  /// Whether it holds a line, which is to be given back in the end.
  [[nodiscard]] bool holds_any() const { return reset_ || magnet_ || light_ || trigger_; }
  /// Whether trigger edges may be lost, which was said.
  [[nodiscard]] bool edges_lost() const { return edges_lost_; }

 private:
  explicit SessionLines(LineListener listener) : listener_(std::move(listener)) {}
  void take_release(const SessionTurn& turn, std::vector<RecordingEvent>& events);
  void take_edges(const SessionTurn& turn, std::vector<RecordingEvent>& events);
  [[nodiscard]] RecordingEvent event_at(std::string_view kind, const HostTime& moment,
                                        const SessionTurn& turn) const;

  LineListener listener_;
  std::optional<BoardReset> reset_;
  std::optional<ReleaseMagnet> magnet_;
  std::optional<StatusLight> light_;
  std::optional<TriggerInput> trigger_;
  std::string edge_;        ///< what the trigger's edges are on its wire
  bool connected_ = false;  ///< the board
  bool edges_lost_ = false;
};

}  // namespace penduline
