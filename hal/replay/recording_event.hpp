// SPDX-License-Identifier: Apache-2.0
// What happened beside the samples: comment lines between a recording's rows that a program can
// read.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <variant>
#include <vector>

#include "hal/error.hpp"
#include "hal/replay/recording_format.hpp"

namespace penduline {

/// An event as the host saw it, on one line of a recording:
/// # event = { kind = "boot", utc = 2026-11-21T07:00:03.250000Z, boot_id = 7 }
struct RecordingEvent {
  using Value = std::variant<std::int64_t, double, std::string>;
  struct Field {
    std::string key;
    Value value;
  };

  std::string kind;                      ///< a word, see kEventKinds
  std::optional<std::int64_t> utc_us{};  ///< host's time in microseconds since 1970
  std::vector<Field> fields{};           ///< what else is known, by kind

  /// A field's value, none where it is not there or of another type.
  template <class Type>
  [[nodiscard]] std::optional<Type> get(std::string_view key) const {
    for (const Field& field : fields) {
      if (field.key == key && std::holds_alternative<Type>(field.value)) {
        return std::get<Type>(field.value);
      }
    }
    return std::nullopt;
  }
};

namespace event {
inline constexpr std::string_view kBoot = "boot";
inline constexpr std::string_view kConnected = "connected";
inline constexpr std::string_view kDisconnected = "disconnected";
inline constexpr std::string_view kMark = "mark";
inline constexpr std::string_view kPong = "pong";
inline constexpr std::string_view kRelease = "release";
inline constexpr std::string_view kTrigger = "trigger";
inline constexpr std::string_view kUnrecorded = "unrecorded";
}  // namespace event

struct EventKindDescription {
  std::string_view kind;
  std::string_view fields;
  std::string_view meaning;
};

/// Every kind that this version writes; others are kept like them.
inline constexpr std::array kEventKinds = {
    EventKindDescription{event::kBoot, "boot_id, serial, board, firmware",
                         "the board has started anew: the next sample counts as `restarted`"},
    EventKindDescription{event::kDisconnected, "reason", "the board went away"},
    EventKindDescription{event::kConnected, "port, serial, boot_id",
                         "the board is there, or back; `boot` follows where it has started anew"},
    EventKindDescription{event::kPong, "sent_us, t_us, received_us",
                         "the host sent a Ping, the board's clock said, the host had the Pong"},
    EventKindDescription{event::kRelease, "host_us, t_us, t_uncertainty_us",
                         "the magnet has let the pendulum go"},
    EventKindDescription{event::kTrigger, "host_us, t_us, t_uncertainty_us, edge, queue",
                         "the trigger input went `rising` or `falling`"},
    EventKindDescription{event::kMark, "host_us, t_us, t_uncertainty_us, text",
                         "somebody who watched marked this moment on the live page"},
    EventKindDescription{event::kUnrecorded, "samples",
                         "so many samples were measured here and could not be recorded"},
};

/// The event `boot` of a board that has started anew, of which `header` tells.
[[nodiscard]] RecordingEvent boot_event(const RecordingHeader& header,
                                        std::optional<std::int64_t> utc_us);

/// Whether the board is connected after an event, where it was or was not before.
[[nodiscard]] bool connected_after(const RecordingEvent& event, bool before);

/// What a line that is an event begins with.
inline constexpr std::string_view kEventStart = "# event = ";

/// No line of `event_line` is longer, in bytes with its newline.
inline constexpr std::size_t kMaxEventBytes = 2048;

/// The event as a line of a recording, with its newline. Fields that find no room in it are left
/// out.
[[nodiscard]] std::string event_line(const RecordingEvent& event);

/// The event of a line that begins with kEventStart. Fields that are no number or string are left
/// out. Fails, saying what was found and expected, where the line is no event.
[[nodiscard]] tl::expected<RecordingEvent, Error> parse_event(std::string_view line);

}  // namespace penduline
