// SPDX-License-Identifier: Apache-2.0
// Connecting, listening, and connecting again.
#include "host/source/board_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "common/wire/rig_image.hpp"
#include "common/wire/sample_message.hpp"
#include "hal/linux/host_time.hpp"
#include "host/session/clock_exchange.hpp"
#include "host/source/board_sampling.hpp"

namespace penduline {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kFrameWait{100};
constexpr milliseconds kLongestWait{400};  // a board that is plugged in is to be seen at once
constexpr seconds kPingPeriod{1};

RecordingEvent event_now(std::string_view kind, std::vector<RecordingEvent::Field> fields) {
  return {.kind = std::string(kind), .utc_us = host_time_now().utc_us, .fields = std::move(fields)};
}

}  // namespace

tl::expected<std::unique_ptr<Source>, Error> BoardSource::open(PortOpener opener,
                                                               const BoardSettings& settings,
                                                               BoardListener listener) {
  std::unique_ptr<BoardSource> source(
      new BoardSource(std::move(opener), settings, std::move(listener)));
  source->patient_until_ = Clock::now() + settings.patience;
  while (!source->connection_) {
    if (source->listener_.stop_requested()) {
      return failure("stopped before a board had said Hello");
    }
    if (auto tried = source->try_again(); !tried) {
      return tl::unexpected(tried.error());
    }
  }
  return source;
}

/// One attempt to connect; after one that failed, a wait that is longer each time. Fails where
/// nothing is to be waited for.
tl::expected<void, Error> BoardSource::try_again() {
  auto connected = connect();
  if (connected || listener_.stop_requested()) {
    wait_ = kShortestWait;
    return {};
  }
  if (settings_.once && Clock::now() >= patient_until_) {
    return connected;
  }
  if (!std::exchange(waiting_told_, true)) {
    listener_.say(connected.error().message + "; waiting for it (Ctrl-C ends)");
  }
  std::this_thread::sleep_for(wait_);
  wait_ = std::min(2 * wait_, kLongestWait);
  return {};
}

tl::expected<void, Error> BoardSource::connect() {
  auto port = opener_(hello_.has_value());
  if (!port) {
    listener_.attempted(BoardAttempt::kNoPort);
    return tl::unexpected(port.error());
  }
  // What has no way back is a file or a pipe: it will not get better by waiting.
  settings_.once = settings_.once || !(*port)->two_way();
  port_name_ = (*port)->name();
  auto connection = BoardConnection::open(std::move(*port), listener_.stop_requested);
  listener_.attempted(connection ? BoardAttempt::kAnswer : BoardAttempt::kNoAnswer);
  if (!connection) {
    return tl::unexpected(connection.error());
  }
  wire::Hello hello = connection->hello();
  if (hello_) {
    if (auto same = require_same_board(port_name_, hello, *hello_); !same) {
      if (std::exchange(refusal_, same.error().message) != refusal_) {
        listener_.say(refusal_ + "; waiting for the right one");
      }
      return same;
    }
  }
  const std::uint32_t rate_before_millihz = hello.rate_millihz;
  if (auto prepared = prepare(*connection, hello); !prepared) {
    settings_.once = settings_.once || !hello_;  // it would be refused again
    return prepared;
  }
  if (!hello_) {
    connection->forget_kept_frames();  // nobody may have read them for long
    skips_sample_ = hello.rate_millihz != rate_before_millihz;
  }
  connection_.emplace(std::move(*connection));
  waiting_told_ = false;
  heard_at_ = Clock::now();
  pinged_at_ = Clock::time_point();
  welcome(hello);
  return {};
}

/// Has the board know the rig, the first time, and sample as it is asked to.
tl::expected<void, Error> BoardSource::prepare(BoardConnection& connection, wire::Hello& hello) {
  if (settings_.rig && !hello_) {
    if (auto uploaded = upload_rig(*settings_.rig, connection); !uploaded) {
      return uploaded;
    }
    listener_.say(fmt::format("{}: the board has stored the rig; it finds angles itself by {}",
                              port_name_,
                              wire::name_of(wire::kOnboardEstimators, settings_.rig->estimator)));
  }
  auto applied = apply_sampling(wanted(hello), connection, hello);
  if (applied && settings_.rig && !hello_ &&
      settings_.rig->estimator == wire::OnboardEstimator::kKalman &&
      hello.rate_millihz > wire::kMostKalmanMillihz) {
    listener_.say(
        fmt::format("{}: at {} Hz the board has no time for ekf, above {} Hz it finds no "
                    "angles",
                    port_name_, hello.rate_millihz / 1e3, wire::kMostKalmanMillihz / 1e3));
  }
  return applied;
}

/// As it is asked to, or as it did before it started anew.
Sampling BoardSource::wanted(const wire::Hello& hello) const {
  const wire::Hello before = hello_.value_or(hello);
  return {.rate_millihz = settings_.rate_millihz.value_or(before.rate_millihz),
          .emitter_mode = settings_.emitter_mode.value_or(before.emitter_mode)};
}

/// Has a board that started anew on an open link go on as it was.
tl::expected<void, Error> BoardSource::settle(wire::Hello hello) {
  listener_.say(port_name_ + ": the board has started anew");
  if (auto same = require_same_board(port_name_, hello, *hello_); !same) {
    return same;
  }
  return apply_sampling(wanted(hello), *connection_, hello);
}

/// Says that the board is there, the first time or again.
void BoardSource::welcome(const wire::Hello& hello) {
  const std::string serial_number = serial_number_of(hello);
  if (!hello_) {
    hello_ = hello;
    boot_id_ = hello.boot_id;
    firmware_ = wire::characters_of(hello.firmware);
    if (hello.protocol != wire::kProtocolVersion) {
      listener_.say(fmt::format(
          "{}: the board speaks protocol {}, this program {}: what is not known is skipped",
          port_name_, hello.protocol, wire::kProtocolVersion));
    }
    if (!settings_.emitter_mode && hello.emitter_mode != wire::EmitterMode::kSwitched) {
      listener_.say(
          fmt::format("{}: the board's emitters are still {}; --emitter switched has it "
                      "measure the room's light, too",
                      port_name_, wire::name_of(wire::kEmitterModes, hello.emitter_mode)));
    }
  } else {
    listener_.say(
        fmt::format("{}: the board is back after {:.1f} s{}", port_name_,
                    std::chrono::duration<double>(Clock::now() - lost_at_).count(),
                    hello.boot_id == boot_id_ ? ", it had not stopped" : ", it has started anew"));
  }
  events_.push_back(event_now(
      event::kConnected,
      {{"port", port_name_}, {"serial", serial_number}, {"boot_id", std::int64_t{hello.boot_id}}}));
  take(hello);
}

tl::expected<ReadResult, Error> BoardSource::read(Sample& sample) {
  if (std::exchange(told_, true)) {
    events_.clear();
  }
  const auto nothing_yet = [] { return ReadResult::kNothingYet; };
  if (!connection_) {
    return try_again().map(nothing_yet);
  }
  const auto pinged = ping_if_due();
  const auto frame = connection_->next_frame(kFrameWait);
  if (frame && *frame) {
    heard_at_ = Clock::now();
    const bool is_sample = take(**frame, sample);
    if (const auto hello = std::exchange(anew_, std::nullopt)) {
      if (auto settled = settle(*hello); !settled) {
        return lose(settled.error().message).map(nothing_yet);
      }
    }
    return is_sample ? ReadResult::kSample : ReadResult::kNothingYet;
  }
  if (frame && connection_->ended() && !connection_->port().two_way()) {
    return ReadResult::kEnded;
  }
  if (!frame || connection_->ended()) {
    return lose(frame ? port_name_ + ": the board has gone" : frame.error().message)
        .map(nothing_yet);
  }
  if (Clock::now() - heard_at_ > longest_silence()) {
    return lose(port_name_ + ": the board is silent").map(nothing_yet);
  }
  return pinged ? ReadResult::kNothingYet : lose(pinged.error().message).map(nothing_yet);
}

tl::expected<void, Error> BoardSource::lose(const std::string& reason) {
  damaged_frames_ += connection_->damaged_frames();
  connection_.reset();  // or the port would come back under another number
  lost_at_ = Clock::now();
  ++times_lost_;
  events_.push_back(event_now(event::kDisconnected, {{"reason", reason}}));
  if (settings_.once) {
    return failure(reason);
  }
  listener_.say(reason + "; waiting for it");
  waiting_told_ = true;
  return {};
}

bool BoardSource::take(const wire::Frame& frame, Sample& sample) {
  const auto pass_on = [&]<wire::Message Kind>(const Kind& /*kind*/) {
    if (const auto message = wire::read_message<Kind>(frame.payload)) {
      take(*message);
    }
  };
  switch (frame.type) {
    case wire::SampleMessage::kType:
      if (const auto message = wire::read_message<wire::SampleMessage>(frame.payload)) {
        if (std::exchange(skips_sample_, false)) {
          break;
        }
        sample = wire::sample_of(*message);
        sample.flags |= std::exchange(restarted_, false) ? flag::kRestarted : 0;
        return true;
      }
      break;
    case wire::Hello::kType:
      pass_on(wire::Hello{});
      break;
    case wire::Status::kType:
      pass_on(wire::Status{});
      break;
    case wire::Pong::kType:
      pass_on(wire::Pong{});
      break;
    default:
      break;  // a newer board says more
  }
  return false;
}

/// A board says Hello when it is asked to, and after each start.
void BoardSource::take(const wire::Hello& hello) {
  if (hello.boot_id == boot_id_) {
    return;
  }
  boot_id_ = hello.boot_id;
  firmware_ = wire::characters_of(hello.firmware);
  restarted_ = true;
  if (connection_ && connection_->hello().boot_id != hello.boot_id) {
    anew_ = hello;
  }
  pinged_at_ = Clock::time_point();  // its clock has started anew
  dropped_before_ = 0;
  events_.push_back(boot_event(header(), host_time_now().utc_us));
}

void BoardSource::take(const wire::Status& status) {
  dropped_frames_ += status.dropped_frames - dropped_before_.value_or(status.dropped_frames);
  dropped_before_ = status.dropped_frames;
}

void BoardSource::take(const wire::Pong& pong) {
  if (pong.token == ping_token_) {
    const HostTime now = host_time_now();
    events_.push_back(event_of(ClockExchange{.sent_us = ping_sent_us_,
                                             .t_us = static_cast<std::int64_t>(pong.t_us),
                                             .received_us = now.monotonic_us,
                                             .utc_us = now.utc_us}));
  }
}

/// Asks for the board's clock, which keeps the connection alive as well.
tl::expected<void, Error> BoardSource::ping_if_due() {
  if (Clock::now() - pinged_at_ < kPingPeriod) {
    return {};
  }
  pinged_at_ = Clock::now();
  ping_sent_us_ = host_time_now().monotonic_us;
  return connection_->send(wire::Ping{.token = ++ping_token_});
}

/// A Pong comes each second, or two samples.
BoardSource::Clock::duration BoardSource::longest_silence() const {
  return seconds(2) + milliseconds(2'000'000 / std::max(hello_->rate_millihz, 1U));
}

RecordingHeader BoardSource::header() const {
  return {.acquisition = {.rate_hz = hello_->rate_millihz / 1e3,
                          .full_scale_counts = static_cast<double>(hello_->full_scale_counts),
                          .reference_v = hello_->reference_uv / 1e6,
                          .sensor_count = hello_->sensor_count},
          .board = std::string(wire::characters_of(hello_->board)),
          .firmware = firmware_,
          .started = "",
          .serial = serial_number_of(*hello_),
          .boot_id = boot_id_};
}

std::string BoardSource::place() const {
  return port_name_;
}

std::vector<std::string> BoardSource::complaints() const {
  std::vector<std::string> complaints;
  const std::uint64_t damaged =
      damaged_frames_ + (connection_ ? connection_->damaged_frames() : 0U);
  if (damaged > 0) {
    complaints.push_back(fmt::format("{}: {} damaged frames", port_name_, damaged));
  }
  if (dropped_frames_ > 0) {
    complaints.push_back(fmt::format("{}: the board dropped {} frames that nobody read in time",
                                     port_name_, dropped_frames_));
  }
  if (times_lost_ > 0) {
    complaints.push_back(
        times_lost_ == 1 ? port_name_ + ": the board was lost once"
                         : fmt::format("{}: the board was lost {} times", port_name_, times_lost_));
  }
  return complaints;
}

}  // namespace penduline
