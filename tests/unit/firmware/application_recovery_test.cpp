// SPDX-License-Identifier: Apache-2.0
// Tests of bad days: nobody reads, something stands still, the board restarts and says why.
#include <catch2/catch.hpp>
#include <cstdint>

#include "tests/unit/firmware/board_under_test.hpp"

namespace penduline::test {
namespace {

using namespace wire;
using sim::Ending;

TEST_CASE("While nobody reads the oldest frames give way, and it is told", "[application]") {
  BoardUnderTest board;
  board.start();
  board.run_us(kSecondUs);
  const std::uint64_t last_seq = board.last<SampleMessage>().seq;
  board.forget();
  board.link().room = 40;  // the frame that is going out is cut, and finished later
  board.run_us(60 * kSecondUs);
  CHECK(board.link().sent.size() == 40);
  board.link().room = MemoryLink::kEndless;
  board.run_us(2 * kSecondUs);

  const std::vector<SampleMessage> samples = board.all<SampleMessage>();
  CHECK(samples.front().seq == last_seq + 1);
  int gaps = 0;
  std::uint64_t lost = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    gaps += samples[i].seq != samples[i - 1].seq + 1 ? 1 : 0;
    lost += samples[i].seq - samples[i - 1].seq - 1;
  }
  CHECK(gaps == 1);
  // What was lost are samples and some of the statuses in between.
  const Status status = board.last<Status>();
  CHECK(status.dropped_frames > lost);
  CHECK(status.dropped_frames < lost + 60);
  CHECK(status.overruns == 0);
  CHECK(status.samples == samples.back().seq + 1);
}

TEST_CASE("The host's touch at 1200 baud ends in the bootloader", "[application]") {
  BoardUnderTest board;
  board.start();
  board.run_us(kSecondUs);
  board.link().is_touched = true;
  CHECK(board.ending() == Ending::kBootloader);
}

TEST_CASE("The command ends in the bootloader, after its reply", "[application]") {
  BoardUnderTest board;
  board.start();
  CHECK(board.result_of(wire::Reboot{.token = 1, .target = RebootTarget::kBootloader}) ==
        Result::kDone);
  CHECK_FALSE(board.board().resets().ending());
  CHECK(board.ending() == Ending::kBootloader);
}

TEST_CASE("A target that does not exist is refused, and the board stays", "[application]") {
  BoardUnderTest board;
  board.start();
  CHECK(board.result_of(wire::Reboot{.token = 1, .target = RebootTarget{2}}) ==
        Result::kOutOfRange);
  CHECK_FALSE(board.ending());
}

TEST_CASE("A board that was told to restart says so and counts it", "[application]") {
  BoardUnderTest board;
  board.start();
  const Hello first = board.last<Hello>();
  for (std::uint16_t resets = 1; resets <= 2; ++resets) {
    REQUIRE(board.result_of(wire::Reboot{}) == Result::kDone);
    REQUIRE(board.ending() == Ending::kRestart);
    board.start();
    CHECK(board.last<Status>().reset_cause == ResetCause::kSoftware);
    CHECK(board.last<Status>().resets == resets);
    CHECK(board.last<Hello>().boot_id != first.boot_id);
  }
}

TEST_CASE("A healthy board feeds its watchdog at any rate", "[application]") {
  for (const std::uint32_t rate_millihz : {1'000U, 20'000U, 1'000'000U}) {
    BoardUnderTest board;
    board.start();
    REQUIRE(board.result_of(SetRate{.rate_millihz = rate_millihz}) == Result::kDone);
    board.run_us(20 * kSecondUs);
    CHECK_FALSE(board.board().resets().ending());
  }
}

TEST_CASE("When windows stop the watchdog bites, and the next start says so", "[application]") {
  BoardUnderTest board;
  board.start();
  board.run_us(kSecondUs);
  board.board().adc().stand_still();
  REQUIRE(board.ending() == Ending::kWatchdog);
  board.forget();
  board.start();
  CHECK(board.last<Status>().reset_cause == ResetCause::kWatchdog);
  CHECK(board.last<Status>().resets == 1);
  board.run_us(kSecondUs);
  CHECK(board.all<SampleMessage>().size() == 19);
}

TEST_CASE("When a link sticks the watchdog bites; when it goes on in time it does not",
          "[application]") {
  BoardUnderTest board;
  board.start();
  board.run_us(kSecondUs);
  board.link().is_stuck = true;
  board.run_us(4 * kSecondUs);
  board.link().is_stuck = false;
  CHECK_FALSE(board.ending());
  board.link().is_stuck = true;
  CHECK(board.ending() == Ending::kWatchdog);
}

TEST_CASE("A failed assertion is told by file and line until power goes", "[application]") {
  BoardUnderTest board;
  board.start();
  board.run_us(kSecondUs);
  board.board().crash_record().note_assertion("firmware/application.hpp", 42);
  board.board().resets().restart();
  board.start();
  Status status = board.last<Status>();
  CHECK(status.reset_cause == ResetCause::kAssertion);
  CHECK(characters_of(status.fault_file) == "application.hpp");
  CHECK(status.fault_line == 42);

  REQUIRE(board.result_of(wire::Reboot{}) == Result::kDone);
  REQUIRE(board.ending() == Ending::kRestart);
  board.start();
  status = board.last<Status>();
  CHECK(status.reset_cause == ResetCause::kSoftware);
  CHECK(status.fault_line == 42);

  board.surroundings().last_reset = ResetCause::kPowerOn;
  BoardUnderTest::Board after_power_on(board.surroundings());
  Application application(after_power_on);
  application.start();
  application.step();
  CHECK(board.last<Status>().fault_line == 0);
}

TEST_CASE("A fault is told by its place", "[application]") {
  BoardUnderTest board;
  board.start();
  board.board().crash_record().note_fault(0x10001234);
  board.board().resets().restart();
  board.start();
  CHECK(board.last<Status>().reset_cause == ResetCause::kFault);
  CHECK(board.last<Status>().fault_pc == 0x10001234);
}

}  // namespace
}  // namespace penduline::test
