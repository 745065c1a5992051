// SPDX-License-Identifier: Apache-2.0
// The application on the microcontroller: windows to samples to frames, commands, status.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "common/wire/messages.hpp"
#include "common/wire/sample_message.hpp"
#include "firmware/busy_meter.hpp"
#include "firmware/lights.hpp"
#include "firmware/onboard_estimate.hpp"
#include "firmware/ports.hpp"
#include "firmware/version.hpp"
#include "firmware/window_sample.hpp"
#include "hal/concepts.hpp"

namespace penduline {

template <FirmwareBoard Board>
class Application {
 public:
  explicit Application(Board& board)
      : board_(board), ports_(board.links()), onboard_(board.store()) {}

  /// Begins to sample and says who we are.
  void start() {
    CrashRecord& record = board_.crash_record();
    const wire::ResetCause hardware_cause = board_.resets().cause();
    record.begin(hardware_cause == wire::ResetCause::kPowerOn);
    cause_ = std::exchange(record.told_cause, wire::ResetCause::kUnknown);
    cause_ = cause_ == wire::ResetCause::kUnknown ? hardware_cause : cause_;
    restarted_ = true;
    onboard_.use_stored_rig(rate_millihz());
    say_hello();
    say_status(board_.clock().now_us());
    board_.sampler().start(period_us_, mode_);
    last_window_us_ = board_.clock().now_us();
    board_.watchdog().start();
  }

  /// Does what is to be done now; to be called again after each interrupt.
  void step() {
    const std::uint64_t begun_us = board_.clock().now_us();
    ports_.for_each([&](auto& port) {
      port.receive(begun_us, [&](const wire::Frame& frame) { on_frame(port, frame); });
    });
    take_windows();
    const std::uint64_t now_us = board_.clock().now_us();  // commands and windows took their time
    if (now_us - last_status_us_ >= kStatusPeriodUs) {
      say_status(now_us);
    }
    board_.indicator().set(lights_.lit(now_us));
    ports_.for_each([&](auto& port) { port.pump(now_us); });
    if (makes_progress()) {
      board_.watchdog().feed();
    }
    leave_if_asked(now_us);
  }

  /// Waits for the next interrupt.
  void sleep() {
    const std::uint64_t from_us = board_.clock().now_us();
    board_.sleep();
    busy_.slept(from_us, board_.clock().now_us());
  }

 private:
  static constexpr std::uint64_t kStatusPeriodUs = 1'000'000;
  static constexpr std::uint32_t kDefaultPeriodUs = 50'000;
  static constexpr std::uint32_t kMillihzUs = 1'000'000'000;  ///< rate in mHz times period in us

  /// Not inline, so that a window is off the stack while a command is carried out.
  [[gnu::noinline]] void take_windows() {
    Window window;
    while (board_.sampler().take(window)) {
      on_window(window);
    }
  }

  void on_window(const Window& window) {
    using Sampler = std::remove_cvref_t<decltype(board_.sampler())>;
    last_window_us_ = board_.clock().now_us();
    late_max_us_ = std::max(late_max_us_, window.late_us);
    overruns_ += window.lost_before;
    next_seq_ += window.lost_before;  // each window that was due has its number
    Sample sample = sample_of(window, next_seq_++, Sampler::kTopCode, Sampler::kWindowUs);
    sample.flags |= std::exchange(restarted_, false) ? flag::kRestarted : 0;
    ++samples_;
    if (const auto message = wire::sample_message_of(sample)) {
      ports_.send(*message);
    }
    if (const auto estimate = onboard_.estimate(sample)) {
      ports_.send(wire::angles_message_of(*estimate));
    }
  }

  [[nodiscard]] std::uint32_t rate_millihz() const {
    return (kMillihzUs + period_us_ / 2) / period_us_;
  }

  [[nodiscard]] wire::Hello hello() const {
    using Sampler = std::remove_cvref_t<decltype(board_.sampler())>;
    return {.board = wire::text_of(Board::kName),
            .firmware = wire::text_of(kFirmwareVersion),
            .unique_id = board_.id().unique_id(),
            .boot_id = board_.crash_record().boot_id,
            .tick_hz = 1'000'000,
            .rate_millihz = rate_millihz(),
            .full_scale_counts = kFullScaleCounts,
            .reference_uv = Board::kReferenceUv,
            .sensor_count = kChannels,
            .emitter_mode = mode_,
            .window_us = Sampler::kWindowUs,
            .conversions = kConversionsPerReading};
  }

  /// What all ports are told; the counters of frames are each port's own.
  [[nodiscard]] wire::Status status(std::uint64_t now_us) {
    const CrashRecord& record = board_.crash_record();
    return {
        .t_us = now_us,
        .samples = samples_,
        .overruns = overruns_,
        .late_max_us = static_cast<std::uint16_t>(std::min<std::uint32_t>(late_max_us_, 0xffff)),
        .load_permille = busy_.permille(now_us),
        .temperature_cdeg = board_.temperature_cdeg(),
        .stack_free_bytes = static_cast<std::uint16_t>(board_.stack_free_bytes()),
        .reset_cause = cause_,
        .resets = record.resets,
        .fault_pc = record.fault_pc,
        .fault_line = record.fault_line,
        .fault_file = record.fault_file,
        .store = onboard_.store_state(),
        .rate_millihz = rate_millihz(),
        .emitter_mode = mode_};
  }

  void say_hello() { ports_.send(hello()); }
  /// Says the Status of a period, and begins the next.
  void say_status(std::uint64_t now_us) {
    wire::Status message = status(now_us);
    ports_.for_each([&](auto& port) { send_status(port, message); });
    last_status_us_ = now_us;
    late_max_us_ = 0;
    busy_.begin(now_us);
  }
  template <class SomePort>
  void send_status(SomePort& port, wire::Status& message) {
    message.dropped_frames = port.dropped_frames();
    message.bad_frames = port.bad_frames();
    port.send(message);
  }

  /// Carries out a frame from the host; the reply goes to the port that it came from. What is no
  /// command has none: two boards on one line, or one that hears itself, would answer for ever.
  template <class SomePort>
  void on_frame(SomePort& port, const wire::Frame& frame) {
    if (frame.type < wire::kFirstCommandType || frame.type > wire::kLastCommandType) {
      return;
    }
    if (frame.type == wire::Ping::kType) {
      if (const auto ping = wire::read_message<wire::Ping>(frame.payload)) {
        port.send(wire::Pong{.token = ping->token, .t_us = board_.clock().now_us()});
        return;
      }
    }
    wire::Reply reply{.command = frame.type,
                      .token = frame.payload.empty() ? std::uint8_t{0} : frame.payload.front(),
                      .result = frame.type == wire::Ping::kType ? wire::Result::kWrongLength
                                                                : wire::Result::kUnknownCommand};
    std::apply(
        [&](const auto&... command) { (try_command(port, frame, command, reply.result), ...); },
        Commands{});
    port.send(reply);
  }

  /// All commands but Ping, which has a reply of its own.
  using Commands =
      std::tuple<wire::AskHello, wire::AskStatus, wire::SetRate, wire::SetEmitter, wire::Identify,
                 wire::Reboot, wire::BeginRig, wire::RigPart, wire::EndRig, wire::EraseRig>;

  template <class SomePort, wire::Message Command>
  void try_command(SomePort& port, const wire::Frame& frame, const Command& /*kind*/,
                   wire::Result& result) {
    if (frame.type == Command::kType) {
      const auto command = wire::read_message<Command>(frame.payload);
      result = command ? carry_out(port, *command) : wire::Result::kWrongLength;
    }
  }

  template <class SomePort>
  wire::Result carry_out(SomePort& port, const wire::AskHello& /*command*/) {
    port.send(hello());
    return wire::Result::kDone;
  }

  template <class SomePort>
  wire::Result carry_out(SomePort& port, const wire::AskStatus& /*command*/) {
    wire::Status message = status(board_.clock().now_us());
    send_status(port, message);
    return wire::Result::kDone;
  }

  template <class SomePort>
  wire::Result carry_out(SomePort& /*port*/, const wire::SetRate& command) {
    if (command.rate_millihz < wire::kLeastRateMillihz ||
        command.rate_millihz > wire::kMostRateMillihz) {
      return wire::Result::kOutOfRange;
    }
    period_us_ = (kMillihzUs + command.rate_millihz / 2) / command.rate_millihz;
    board_.sampler().start(period_us_, mode_);
    onboard_.use_stored_rig(rate_millihz());
    return wire::Result::kDone;
  }

  template <class SomePort>
  wire::Result carry_out(SomePort& /*port*/, const wire::SetEmitter& command) {
    if (command.mode > wire::EmitterMode::kDark) {
      return wire::Result::kOutOfRange;
    }
    mode_ = command.mode;
    board_.sampler().start(period_us_, mode_);
    return wire::Result::kDone;
  }

  template <class SomePort>
  wire::Result carry_out(SomePort& /*port*/, const wire::Identify& command) {
    lights_.identify(board_.clock().now_us(), command.seconds);
    return wire::Result::kDone;
  }

  template <class SomePort>
  wire::Result carry_out(SomePort& /*port*/, const wire::Reboot& command) {
    if (command.target > wire::RebootTarget::kBootloader) {
      return wire::Result::kOutOfRange;
    }
    ask_to_leave(command.target);
    return wire::Result::kDone;
  }

  /// The commands for a rig.
  template <class SomePort, class Command>
  wire::Result carry_out(SomePort& /*port*/, const Command& command) {
    return onboard_.carry_out(command);
  }

  /// Whether windows come as they should and no link has stopped.
  [[nodiscard]] bool makes_progress() {
    const std::uint64_t now_us = board_.clock().now_us();
    bool progress = now_us - last_window_us_ < kStatusPeriodUs + 2 * std::uint64_t{period_us_};
    ports_.for_each([&](auto& port) { progress = progress && !port.link().stuck(); });
    return progress;
  }

  /// A reply still has to go out first.
  void ask_to_leave(wire::RebootTarget target) {
    constexpr std::uint64_t kTimeForTheReplyUs = 50'000;
    leaving_to_ = target;
    leaving_at_us_ = board_.clock().now_us() + kTimeForTheReplyUs;
  }

  void leave_if_asked(std::uint64_t now_us) {
    ports_.for_each([&](auto& port) {
      if (!leaving_to_ && port.link().asks_for_bootloader()) {
        ask_to_leave(wire::RebootTarget::kBootloader);
      }
    });
    if (!leaving_to_ || now_us < leaving_at_us_) {
      return;
    }
    if (*leaving_to_ == wire::RebootTarget::kBootloader) {
      board_.resets().enter_bootloader();
    } else {
      board_.crash_record().told_cause = wire::ResetCause::kSoftware;
      board_.resets().restart();
    }
  }

  Board& board_;
  Ports<decltype(std::declval<Board&>().links())> ports_;
  std::uint32_t period_us_ = kDefaultPeriodUs;
  wire::EmitterMode mode_ = wire::EmitterMode::kSwitched;
  std::uint64_t next_seq_ = 0;
  std::uint64_t samples_ = 0;
  std::uint32_t overruns_ = 0;
  std::uint32_t late_max_us_ = 0;
  std::uint64_t last_window_us_ = 0;
  std::uint64_t last_status_us_ = 0;
  wire::ResetCause cause_ = wire::ResetCause::kUnknown;
  bool restarted_ = false;
  OnboardEstimate<Board> onboard_;
  BusyMeter busy_;
  Lights lights_;
  std::optional<wire::RebootTarget> leaving_to_;
  std::uint64_t leaving_at_us_ = 0;
};

}  // namespace penduline
