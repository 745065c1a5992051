// SPDX-License-Identifier: Apache-2.0
// Opening the lines, and what each of them does in a turn.
#include "host/gpio/session_lines.hpp"

#include <utility>

#include "host/session/moment_event.hpp"

namespace penduline {
namespace {

/// A reset pin is pulled up by its board, and buttons and programmers pull it low as well: high is
/// not to be driven.
GpioDrive reset_drive(const GpioLine& line) {
  return line.active_low ? GpioDrive::kOpenDrain : GpioDrive::kPushPull;
}

}  // namespace

tl::expected<std::unique_ptr<SessionLines>, Error> SessionLines::open(Gpio& gpio,
                                                                      const RigLines& rig,
                                                                      const LineSettings& settings,
                                                                      LineListener listener) {
  std::unique_ptr<SessionLines> lines(new SessionLines(std::move(listener)));
  const LineListener& told = lines->listener_;
  if (rig.reset) {
    auto output = gpio.open_output(*rig.reset, reset_drive(*rig.reset), false);
    if (!output) {
      return tl::unexpected(output.error());
    }
    lines->reset_.emplace(std::move(*output), told.warn);
  }
  if (rig.status_led) {
    auto output = gpio.open_output(*rig.status_led, GpioDrive::kPushPull, false);
    if (!output) {
      return tl::unexpected(output.error());
    }
    lines->light_.emplace(std::move(*output), told.warn);
  }
  if (rig.trigger && settings.record_trigger) {
    auto input = gpio.open_input(*rig.trigger);
    if (!input) {
      return tl::unexpected(input.error());
    }
    lines->edge_ = rig.trigger->active_low ? "falling" : "rising";
    lines->trigger_.emplace(std::move(*input));
  }
  // The last one: it is not to hold for a moment only, because another line cannot be had.
  if (rig.release && settings.release_after) {
    auto output = gpio.open_output(*rig.release, GpioDrive::kPushPull, true);
    if (!output) {
      return tl::unexpected(output.error());
    }
    lines->magnet_.emplace(std::move(*output), *settings.release_after);
  }
  return lines;
}

tl::expected<void, Error> SessionLines::reset_board() {
  return reset_ ? reset_->pulse() : tl::expected<void, Error>();
}

void SessionLines::attempted(BoardAttempt attempt) {
  if (!reset_) {
    return;
  }
  const auto now = BoardReset::Clock::now();
  switch (attempt) {
    case BoardAttempt::kNoPort:
      reset_->not_there(now);
      break;
    case BoardAttempt::kNoAnswer:
      reset_->not_answered(now);
      break;
    case BoardAttempt::kAnswer:
      reset_->answered();
      break;
  }
}

std::vector<RecordingEvent> SessionLines::turn(const SessionTurn& turn) {
  for (const RecordingEvent& event : turn.events) {
    connected_ = connected_after(event, connected_);
  }
  const auto now = std::chrono::steady_clock::now();
  if (light_) {
    light_->turn(turn.sample, connected_, now);
  }
  if (magnet_ && turn.sample) {
    magnet_->begin(now);
  }
  std::vector<RecordingEvent> events;
  take_release(turn, events);
  take_edges(turn, events);
  return events;
}

RecordingEvent SessionLines::event_at(std::string_view kind, const HostTime& moment,
                                      const SessionTurn& turn) const {
  // Without the board nobody knows whether its clock still runs.
  return moment_event(kind, moment, connected_ ? turn.clock : std::nullopt);
}

void SessionLines::take_release(const SessionTurn& turn, std::vector<RecordingEvent>& events) {
  const auto release = magnet_ ? magnet_->take_release() : std::nullopt;
  if (!release) {
    return;
  }
  if (!*release) {
    listener_.warn("the magnet did not let go: " + release->error().message);
    return;
  }
  events.push_back(event_at(event::kRelease, **release, turn));
  listener_.say("the magnet has let go");
}

void SessionLines::take_edges(const SessionTurn& turn, std::vector<RecordingEvent>& events) {
  if (!trigger_) {
    return;
  }
  const TriggerInput::Taken taken = trigger_->take();
  for (const TriggerEdge& edge : taken.edges) {
    RecordingEvent event =
        event_at(event::kTrigger, {.monotonic_us = edge.host_us, .utc_us = edge.utc_us}, turn);
    event.fields.push_back({"edge", edge_});
    if (edge.others_may_be_lost) {
      event.fields.push_back({"queue", std::string("full")});
      if (!std::exchange(edges_lost_, true)) {
        listener_.warn(
            "trigger edges came faster than they were taken, some may be lost; the recording says "
            "where (queue = \"full\")");
      }
    }
    events.push_back(std::move(event));
  }
  if (taken.error) {
    listener_.warn("no more trigger edges: " + taken.error->message);
    edges_lost_ = true;
  }
}

}  // namespace penduline
