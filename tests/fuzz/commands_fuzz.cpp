// SPDX-License-Identifier: Apache-2.0
// Any bytes, and any commands, on a board's link: it answers in whole frames and goes on sampling.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/wire/decoder.hpp"
#include "firmware/application.hpp"
#include "hal/sim/board.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tests/unit/firmware/memory_link.hpp"

namespace {

using namespace penduline;
using namespace penduline::fuzz;
using namespace penduline::wire;

using Input = std::span<const std::uint8_t>;
using Board = sim::Board<test::MemoryLink>;

constexpr std::uint64_t kMaxStepsBetweenSamples = 2'000;  // 1 Hz at a tick of 1 ms

/// The host's end of the link: reads what the board sends and holds it to its promises.
class Listener {
 public:
  void on_start() { next_seq_ = 0; }

  void hear(Input bytes) {
    decoder_.push(bytes, [&](const Frame& frame) { on_frame(frame); });
    require(decoder_.bad_frames() == 0, "a board sends whole frames");
  }

  [[nodiscard]] std::uint64_t samples() const { return samples_; }

 private:
  void on_frame(const Frame& frame) {
    require(frame.type < kFirstCommandType, "a board sends no commands");
    if (const auto sample = read_message<SampleMessage>(frame.payload);
        frame.type == SampleMessage::kType) {
      require(sample && sample->seq >= next_seq_, "no seq comes twice in one life");
      next_seq_ = sample->seq + 1;
      ++samples_;
    }
    if (const auto angles = read_message<AnglesMessage>(frame.payload);
        frame.type == AnglesMessage::kType) {
      require(angles && (std::isfinite(angles->theta1_rad) || angles->flags != 0),
              "a row without angles says why");
    }
    if (const auto status = read_message<Status>(frame.payload); frame.type == Status::kType) {
      require(
          status && status->load_permille <= 1000 && status->rate_millihz >= kLeastRateMillihz &&
              status->rate_millihz <= kMostRateMillihz &&
              status->emitter_mode <= EmitterMode::kDark && status->store <= StoreState::kDamaged,
          "a status is possible");
    }
  }

  Decoder decoder_;
  std::uint64_t next_seq_ = 0;
  std::uint64_t samples_ = 0;
};

class FuzzedBoard {
 public:
  FuzzedBoard()
      : surroundings_{.rig = {rig_with(kChannels), SimulationSettings{.noise_v = 0}}, .link = {}} {
    start();
  }

  void take(Input bytes) {
    auto& queue = surroundings_.link.to_read;
    queue.insert(queue.end(), bytes.begin(), bytes.end());
    while (!queue.empty()) {
      step();
    }
  }

  /// Whatever came, the next sample comes too.
  void check_life() {
    const std::uint64_t before = listener_.samples();
    for (std::uint64_t i = 0; i < kMaxStepsBetweenSamples && listener_.samples() == before; ++i) {
      step();
    }
    require(listener_.samples() > before, "a board goes on sampling");
  }

 private:
  void start() {
    board_.emplace(surroundings_);
    application_.emplace(*board_);
    listener_.on_start();
    application_->start();
    application_->step();
  }

  void step() {
    application_->sleep();
    require(board_->resets().ending() != sim::Ending::kWatchdog, "no command stops the main loop");
    application_->step();
    auto& sent = surroundings_.link.sent;
    listener_.hear(sent);
    sent.clear();
    if (board_->resets().ending()) {
      application_.reset();
      board_->leave();
      start();
    }
  }

  sim::Surroundings<test::MemoryLink> surroundings_;
  std::optional<Board> board_;
  std::optional<Application<Board>> application_;
  Listener listener_;
};

/// One frame of a type and a payload with the right CRC, which no mutation would find.
void take_frame(FuzzedBoard& board, std::uint8_t type, Input payload) {
  std::array<std::uint8_t, kMaxBodyBytes> body{};
  std::array<std::uint8_t, kMaxFrameBytes> frame{};
  body[0] = type;
  std::ranges::copy(payload, body.begin() + kTypeBytes);
  const std::size_t covered = kTypeBytes + payload.size();
  ByteWriter(std::span(body).subspan(covered)).put(crc32(Input(body).first(covered)));
  const std::size_t size = cobs_encode(Input(body).first(covered + kCrcBytes), frame);
  board.take(Input(frame).first(size + 1));
}

/// The input as commands, each a type, a size and a payload.
void take_commands(FuzzedBoard& board, Input input) {
  constexpr std::size_t kHeadBytes = 2;
  while (input.size() >= kHeadBytes) {
    const std::uint8_t type = input[0];
    const std::size_t size =
        std::min<std::size_t>({input[1], kMaxPayloadBytes, input.size() - kHeadBytes});
    take_frame(board, type, input.subspan(kHeadBytes, size));
    input = input.subspan(kHeadBytes + size);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Input input(data, size);
  if (input.empty()) {
    return 0;
  }
  constexpr std::uint8_t kAsCommands = 'c';  // any other first byte: the rest as it is
  FuzzedBoard board;
  if (input.front() == kAsCommands) {
    take_commands(board, input.subspan(1));
  } else {
    board.take(input.subspan(1));
  }
  board.check_life();
  return 0;
}
