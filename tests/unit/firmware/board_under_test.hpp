// SPDX-License-Identifier: Apache-2.0
// The application on a simulated board, seen from the host's end of its link.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/wire/sample_message.hpp"
#include "firmware/application.hpp"
#include "hal/sim/board.hpp"
#include "tests/unit/common/test_rig.hpp"
#include "tests/unit/common/wire_examples.hpp"
#include "tests/unit/firmware/memory_link.hpp"
#include "tests/unit/firmware/stored_rigs.hpp"

namespace penduline::test {

inline constexpr std::uint64_t kSecondUs = 1'000'000;

/// The rig of `two_sensor_rig` in double, which hangs still; 0.1 V of ambient light, no noise.
[[nodiscard]] inline SimulatedRig still_rig() {
  Rig<double> rig = linear_rig(paper_layout<double>());
  rig.pendulum = {.length_m = 0.3, .mass_kg = 0.1, .gravity_m_s2 = 9.8, .damping_per_s = 0.01};
  return {rig, SimulationSettings{.start = {}, .ambient_v = 0.1, .noise_v = 0}};
}

/// The same, released from 5 degrees on the diagonal, with noise.
[[nodiscard]] inline SimulatedRig swinging_rig() {
  Rig<double> rig = linear_rig(paper_layout<double>());
  rig.pendulum = {.length_m = 0.3, .mass_kg = 0.1, .gravity_m_s2 = 9.8, .damping_per_s = 0.01};
  const SwingStart start{.theta_rad = from_degrees(5), .phi_rad = from_degrees(45)};
  return {rig, SimulationSettings{.start = start, .ambient_v = 0.1, .noise_v = 0.002}};
}

class BoardUnderTest {
 public:
  using Board = sim::Board<MemoryLink>;

  explicit BoardUnderTest(SimulatedRig rig = still_rig())
      : surroundings_{.rig = std::move(rig), .link = {}, .serial_number = 0x0102030405060708} {}

  /// Power comes on, or the board starts again after its end.
  void start() {
    if (board_) {
      application_.reset();
      board_->leave();
    }
    board_.emplace(surroundings_);
    application_.emplace(*board_);
    application_->start();
    application_->step();
  }

  /// Lets the board run, until it ends at most.
  void run_us(std::uint64_t us) {
    const std::uint64_t until_us = board_->clock().now_us() + us;
    while (board_->clock().now_us() < until_us && !board_->resets().ending()) {
      application_->sleep();
      if (!board_->resets().ending()) {
        application_->step();
      }
    }
  }
  /// Runs until the board has ended, ten seconds at most.
  [[nodiscard]] std::optional<sim::Ending> ending() {
    run_us(10 * kSecondUs);
    return board_->resets().ending();
  }

  void send_bytes(const Bytes& bytes) {
    link().to_read.insert(link().to_read.end(), bytes.begin(), bytes.end());
  }
  /// What the board says to a command within 10 ms.
  template <wire::Message Command>
  std::vector<KeptFrame> answers_to(const Command& command) {
    return answers_to(frame_of(command));
  }
  std::vector<KeptFrame> answers_to(const Bytes& bytes) {
    forget();
    send_bytes(bytes);
    run_us(10'000);
    return frames();
  }
  /// The reply to a command; the test fails where none comes.
  template <wire::Message Command>
  wire::Result result_of(const Command& command) {
    static_cast<void>(answers_to(command));
    const wire::Reply reply = last<wire::Reply>();
    REQUIRE(reply.command == Command::kType);
    REQUIRE(reply.token == command.token);
    return reply.result;
  }

  /// Uploads an image in whole pieces; the result of the last command.
  wire::Result upload(const Bytes& image) {
    wire::Result result = result_of(wire::BeginRig{
        .size_bytes = static_cast<std::uint16_t>(image.size()), .crc = wire::crc32(image)});
    for (std::size_t at = 0; at < image.size() && result == wire::Result::kDone;) {
      const std::size_t count = std::min(image.size() - at, wire::kRigPartBytes);
      wire::RigPart part{.offset = static_cast<std::uint16_t>(at),
                         .count = static_cast<std::uint8_t>(count)};
      std::copy_n(image.begin() + static_cast<std::ptrdiff_t>(at), count, part.bytes.begin());
      result = result_of(part);
      at += count;
    }
    return result == wire::Result::kDone ? result_of(wire::EndRig{}) : result;
  }

  /// All frames since the last `forget`.
  [[nodiscard]] std::vector<KeptFrame> frames() const { return frames_in(surroundings_.link.sent); }
  void forget() { link().sent.clear(); }

  /// All messages of one kind since the last `forget`.
  template <wire::Message Kind>
  [[nodiscard]] std::vector<Kind> all() const {
    std::vector<Kind> messages;
    for (const KeptFrame& frame : frames()) {
      if (frame.type == Kind::kType) {
        messages.push_back(wire::read_message<Kind>(frame.payload).value());
      }
    }
    return messages;
  }
  template <wire::Message Kind>
  [[nodiscard]] Kind last() const {
    const std::vector<Kind> messages = all<Kind>();
    REQUIRE_FALSE(messages.empty());
    return messages.back();
  }

  [[nodiscard]] MemoryLink& link() { return surroundings_.link; }
  [[nodiscard]] Board& board() { return *board_; }
  [[nodiscard]] sim::Surroundings<MemoryLink>& surroundings() { return surroundings_; }

 private:
  sim::Surroundings<MemoryLink> surroundings_;
  std::optional<Board> board_;
  std::optional<Application<Board>> application_;
};

}  // namespace penduline::test
