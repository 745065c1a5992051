// SPDX-License-Identifier: Apache-2.0
// Tests of what the application streams: samples at their rate, with their light and their flags.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>

#include "tests/unit/firmware/board_under_test.hpp"

namespace penduline::test {
namespace {

using wire::EmitterMode;
using wire::Result;
using wire::SampleMessage;

/// Counts of a voltage, as an ideal ADC of 3.3 V has them.
double counts_of(double volts) {
  return volts / 3.3 * 65535;
}
/// Of one code of the ADC, of which a reading of a constant voltage may be half away.
constexpr double kHalfCode = 65535.0 / 4095 / 2 + 1;

/// The still pendulum's signal: the rest gap is 20 mm, 0.031 m - 0.006 m/V * U.
const double kLit = counts_of(0.1 + (kGapAtZero - 0.02) / 0.006);
const double kDark = counts_of(0.1);

TEST_CASE("Twenty samples come each second, one seq and one period apart", "[application]") {
  BoardUnderTest board;
  board.start();
  board.run_us(10 * kSecondUs);
  const std::vector<SampleMessage> samples = board.all<SampleMessage>();
  REQUIRE(samples.size() == 199);  // the 200th window begins at 10 s
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CAPTURE(i);
    CHECK(samples[i].seq == i);
    // The middle of a window of 556 us.
    CHECK(samples[i].t_us == (i + 1) * 50'000 + 278);
  }
}

TEST_CASE("Readings are the rig's light, lit and dark", "[application]") {
  BoardUnderTest board;
  board.start();
  board.run_us(kSecondUs);
  for (const SampleMessage& sample : board.all<SampleMessage>()) {
    CHECK(std::abs(sample.x_on - kLit) < kHalfCode);
    CHECK(std::abs(sample.y_on - kLit) < kHalfCode);
    CHECK(std::abs(sample.x_off - kDark) < kHalfCode);
    CHECK(std::abs(sample.y_off - kDark) < kHalfCode);
  }
}

TEST_CASE("Each emitter mode has its readings from the next window on", "[application]") {
  BoardUnderTest board;
  board.start();
  REQUIRE(board.result_of(wire::SetEmitter{.mode = EmitterMode::kLit}) == Result::kDone);
  board.run_us(kSecondUs);
  SampleMessage sample = board.last<SampleMessage>();
  CHECK(std::abs(sample.x_on - kLit) < kHalfCode);
  CHECK(sample.x_off == 0);
  REQUIRE(board.result_of(wire::SetEmitter{.mode = EmitterMode::kDark}) == Result::kDone);
  board.run_us(kSecondUs);
  sample = board.last<SampleMessage>();
  CHECK(std::abs(sample.x_on - kDark) < kHalfCode);
  CHECK(std::abs(sample.x_off - kDark) < kHalfCode);
  REQUIRE(board.result_of(wire::SetEmitter{.mode = EmitterMode::kSwitched}) == Result::kDone);
  board.run_us(kSecondUs);
  sample = board.last<SampleMessage>();
  CHECK(std::abs(sample.x_on - kLit) < kHalfCode);
  CHECK(std::abs(sample.x_off - kDark) < kHalfCode);
}

TEST_CASE("A new rate holds from the next window on, and no seq is lost", "[application]") {
  BoardUnderTest board;
  board.start();
  for (const std::uint32_t rate_millihz : {1'000'000U, 1'000U, 20'000U, 333'000U}) {
    CAPTURE(rate_millihz);
    const std::uint64_t before = board.last<wire::Status>().samples;
    REQUIRE(board.result_of(wire::SetRate{.rate_millihz = rate_millihz}) == Result::kDone);
    board.run_us(kSecondUs);  // the window that was due is still of the old rate
    board.forget();
    board.run_us(5 * kSecondUs);
    const std::vector<SampleMessage> samples = board.all<SampleMessage>();
    const std::uint64_t period_us = (1'000'000'000ULL + rate_millihz / 2) / rate_millihz;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      CHECK(samples[i].seq == samples[i - 1].seq + 1);
      CHECK(samples[i].t_us == samples[i - 1].t_us + period_us);
    }
    CHECK(samples.size() >= rate_millihz / 1000 * 5 - 1);
    CHECK(board.last<wire::Status>().samples > before);
    CHECK(board.last<wire::Status>().overruns == 0);
    // Told as the period that it is: 333 Hz are 3003 us.
    CHECK(board.last<wire::Status>().rate_millihz == (1'000'000'000 + period_us / 2) / period_us);
  }
}

TEST_CASE("The first sample after a start is flagged, and no other", "[application]") {
  BoardUnderTest board;
  for (int life = 0; life < 2; ++life) {
    board.start();
    board.forget();
    board.run_us(kSecondUs);
    const std::vector<SampleMessage> samples = board.all<SampleMessage>();
    REQUIRE(samples.size() > 2);
    CHECK(samples.front().flags == flag::kRestarted);
    for (std::size_t i = 1; i < samples.size(); ++i) {
      CHECK(samples[i].flags == 0);
    }
  }
}

TEST_CASE("Windows that are lost keep their numbers, are flagged and counted", "[application]") {
  BoardUnderTest board;
  board.start();
  REQUIRE(board.result_of(wire::SetRate{.rate_millihz = 100'000}) == Result::kDone);
  board.run_us(kSecondUs + 3'000);  // between two windows
  const SampleMessage before = board.last<SampleMessage>();
  board.forget();
  // The flash keeps interrupts off for 50 ms. The first window was due 6 ms after it began, the
  // fifth 46: that one is taken, 4 ms late.
  board.send_bytes(frame_of(wire::EraseRig{}));
  board.run_us(2 * kSecondUs);
  const std::vector<SampleMessage> samples = board.all<SampleMessage>();
  const SampleMessage& late = samples.front();
  CHECK(late.seq == before.seq + 5);
  CHECK(late.t_us == before.t_us + 5 * 10'000 + 4'000);
  CHECK(late.flags == (flag::kOverrun | flag::kLate));
  CHECK(board.last<wire::Status>().overruns == 4);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    CHECK(samples[i].seq == late.seq + i);
    CHECK(samples[i].t_us == before.t_us + (5 + i) * 10'000);
    CHECK(samples[i].flags == 0);
  }
}

TEST_CASE("How late a window began is told once", "[application]") {
  BoardUnderTest board;
  board.start();
  CHECK(board.last<wire::Status>().late_max_us == 0);
  board.run_us(30'000);
  board.send_bytes(frame_of(wire::EraseRig{}));
  board.run_us(2 * kSecondUs);
  std::vector<std::uint16_t> late_us;
  for (const wire::Status& status : board.all<wire::Status>()) {
    late_us.push_back(status.late_max_us);
  }
  REQUIRE(late_us.size() >= 3);
  // The window was due at 50 ms, and the flash was written from 30 to 80 ms or a tick later.
  CHECK(late_us[1] >= 30'000);
  CHECK(late_us[1] <= 31'000);
  CHECK(late_us[2] == 0);
}

TEST_CASE("A Status that is asked for takes nothing from the one that is due", "[application]") {
  BoardUnderTest board;
  board.start();
  board.run_us(30'000);
  board.send_bytes(frame_of(wire::EraseRig{}));
  board.run_us(170'000);
  board.forget();
  board.send_bytes(frame_of(wire::AskStatus{}));
  board.run_us(10'000);
  REQUIRE(board.all<wire::Status>().size() == 1);
  const std::uint16_t asked_us = board.last<wire::Status>().late_max_us;
  CHECK(asked_us >= 30'000);
  board.run_us(kSecondUs);
  REQUIRE(board.all<wire::Status>().size() == 2);
  CHECK(board.last<wire::Status>().late_max_us == asked_us);
}

}  // namespace
}  // namespace penduline::test
