// SPDX-License-Identifier: Apache-2.0
// A board as a source: it stays one while the board goes, comes back or starts anew.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

#include "common/wire/choices.hpp"
#include "common/wire/device_messages.hpp"
#include "hal/linux/board_connection.hpp"
#include "hal/replay/recording_event.hpp"
#include "host/source/board_sampling.hpp"
#include "host/source/rig_upload.hpp"
#include "host/source/source.hpp"

namespace penduline {

/// Opens the port of a board, wherever it is now: with `same_device` that of the device which it
/// opened last, else of any that suits.
using PortOpener = std::function<tl::expected<std::unique_ptr<BytePort>, Error>(bool same_device)>;

struct BoardSettings {
  bool once = false;  ///< fail instead of waiting for a board, at the start and later
  std::chrono::milliseconds patience{0};        ///< at the start, even so: it is just being reset
  std::optional<std::uint32_t> rate_millihz{};  ///< none: as the board says first
  std::optional<wire::EmitterMode> emitter_mode{};  ///< the same
  std::optional<RigForBoard> rig{};  ///< to be stored on the board when it is first there
};

/// What came of one attempt to talk to a board.
enum class BoardAttempt { kNoPort, kNoAnswer, kAnswer };

/// Who is told and asked, during `open` and `read`.
struct BoardListener {
  /// Takes news for a person: the board is waited for, has gone, is back.
  std::function<void(const std::string&)> say;
  std::function<bool()> stop_requested;
  /// Told of every attempt; without an answer the port is closed by then.
  std::function<void(BoardAttempt)> attempted = [](BoardAttempt /*attempt*/) {};
};

class BoardSource final : public Source {
 public:
  /// Waits for the board and its Hello. Fails where `settings.once` and there is none, where the
  /// board refuses a setting or the rig, and where a stop is requested meanwhile.
  static tl::expected<std::unique_ptr<Source>, Error> open(PortOpener opener,
                                                           const BoardSettings& settings,
                                                           BoardListener listener);

  [[nodiscard]] RecordingHeader header() const override;
  /// The next sample; nothing yet where none is there in time, or no board. Ends with the bytes of
  /// a file or a pipe.
  tl::expected<ReadResult, Error> read(Sample& sample) override;
  [[nodiscard]] std::string place() const override;
  /// Nobody knows how much is still to come.
  [[nodiscard]] double progress() const override { return 0; }
  [[nodiscard]] std::vector<std::string> complaints() const override;
  [[nodiscard]] std::span<const RecordingEvent> events() const override { return events_; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kShortestWait{50};

  BoardSource(PortOpener opener, const BoardSettings& settings, BoardListener listener)
      : opener_(std::move(opener)), settings_(settings), listener_(std::move(listener)) {}

  tl::expected<void, Error> try_again();
  tl::expected<void, Error> connect();
  tl::expected<void, Error> prepare(BoardConnection& connection, wire::Hello& hello);
  [[nodiscard]] Sampling wanted(const wire::Hello& hello) const;
  void welcome(const wire::Hello& hello);
  tl::expected<void, Error> settle(wire::Hello hello);
  tl::expected<void, Error> lose(const std::string& reason);
  bool take(const wire::Frame& frame, Sample& sample);
  void take(const wire::Hello& hello);
  void take(const wire::Status& status);
  void take(const wire::Pong& pong);
  tl::expected<void, Error> ping_if_due();
  [[nodiscard]] Clock::duration longest_silence() const;

  PortOpener opener_;
  BoardSettings settings_;
  BoardListener listener_;
  std::optional<BoardConnection> connection_;
  std::optional<wire::Hello> hello_;  ///< what the board said first, with the settings applied
  std::uint32_t boot_id_ = 0;         ///< of the start that it is in
  std::string firmware_;              ///< the same
  bool restarted_ = false;            ///< the next sample is the first after a start
  /// The next sample's window was on its way when the rate was set: the one after it is due by the
  /// old rate still.
  bool skips_sample_ = false;
  std::optional<wire::Hello> anew_;  ///< of a start while it was connected
  Clock::time_point patient_until_;  ///< where `settings_.once`
  std::string port_name_;            ///< of the last connection
  std::string refusal_;              ///< why a board that is there was not taken, said last
  bool waiting_told_ = false;        ///< that the board is waited for
  std::chrono::milliseconds wait_ = kShortestWait;  ///< before the next attempt to connect
  Clock::time_point heard_at_;
  Clock::time_point lost_at_;
  Clock::time_point pinged_at_;
  std::uint32_t ping_token_ = 0;
  std::int64_t ping_sent_us_ = 0;
  std::vector<RecordingEvent> events_;  ///< since the reading before
  bool told_ = false;                   ///< the events, by a reading
  std::uint64_t times_lost_ = 0;
  std::uint64_t damaged_frames_ = 0;             ///< of connections that are over
  std::optional<std::uint32_t> dropped_before_;  ///< as the board counts since its start
  std::uint64_t dropped_frames_ = 0;
};

}  // namespace penduline
