// SPDX-License-Identifier: Apache-2.0
// Tests of a window's course: the order of its bursts, the waits for light, what is lost.
#include "hal/window_sequencer.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace penduline::test {
namespace {

/// What the sequencer told the hardware, one word each: "lit", "dark", "wait", "0", "1".
using Course = std::vector<std::string>;

struct NotingLight {
  Course& course;
  void set(bool lit) { course.emplace_back(lit ? "lit" : "dark"); }
};
struct NotingTimer {
  Course& course;
  std::vector<std::uint32_t> delays_us{};
  std::uint64_t time_us = 0;
  [[nodiscard]] std::uint64_t now_us() const { return time_us; }
  void wake_after(std::uint32_t delay_us) {
    course.emplace_back("wait");
    delays_us.push_back(delay_us);
  }
};
/// Fills each burst with its place in the course, at once or when told.
struct NotingAdc {
  static constexpr std::uint32_t kConversionNs = 2000;
  Course& course;
  bool at_once = false;
  bool convert(std::uint8_t first_channel, std::uint16_t* codes) {
    std::fill_n(codes, kConversionsPerBurst, static_cast<std::uint16_t>(course.size()));
    course.push_back(std::to_string(first_channel));
    return at_once;
  }
};

struct Hardware {
  Course course;
  NotingLight light{course};
  NotingTimer timer{course};
  NotingAdc adc{course};
  WindowSequencer<NotingLight, NotingAdc, NotingTimer> sequencer{light, adc, timer};

  /// Ends what the sequencer waits for until the window is finished.
  void finish() {
    for (int i = 0; i < 100 && !sequencer.idle(); ++i) {
      if (course.back() == "wait") {
        sequencer.on_wake_up();
      } else {
        sequencer.on_burst_done();
      }
    }
    REQUIRE(sequencer.idle());
  }
  /// A whole window's course.
  Course window(EmitterMode mode) {
    course.clear();
    sequencer.on_window_due(0, 0, mode);
    finish();
    return course;
  }
};

TEST_CASE("A switched window is dark, lit, lit, dark, and waits after each switch", "[window]") {
  Hardware hardware;
  CHECK(hardware.window(EmitterMode::kSwitched) ==
        Course{"0", "lit", "wait", "0", "1", "dark", "wait", "1"});
  CHECK(hardware.timer.delays_us == std::vector<std::uint32_t>{kSettlingUs, kSettlingUs});
}

TEST_CASE("A window reads the same backwards", "[window]") {
  // Burst by burst the light, and conversion by conversion the other channel.
  for (std::size_t i = 0; i < kBursts.size(); ++i) {
    const Burst& there = kBursts[i];
    const Burst& back = kBursts[kBursts.size() - 1 - i];
    CHECK(there.lit == back.lit);
    CHECK((there.first_channel + kConversionsPerBurst - 1) % kChannels == back.first_channel);
  }
}

TEST_CASE("A lit or dark mode switches once and then never waits", "[window]") {
  Hardware hardware;
  CHECK(hardware.window(EmitterMode::kDark) == Course{"0", "wait", "0", "1", "wait", "1"});
  CHECK(hardware.window(EmitterMode::kLit) ==
        Course{"lit", "wait", "0", "wait", "0", "1", "wait", "1"});
  CHECK(hardware.window(EmitterMode::kLit) == Course{"0", "wait", "0", "1", "wait", "1"});
  CHECK(hardware.window(EmitterMode::kSwitched) ==
        Course{"dark", "wait", "0", "lit", "wait", "0", "1", "dark", "wait", "1"});
}

TEST_CASE("A converter that is done at once takes the same course", "[window]") {
  Hardware hardware;
  hardware.adc.at_once = true;
  CHECK(hardware.window(EmitterMode::kSwitched) ==
        Course{"0", "lit", "wait", "0", "1", "dark", "wait", "1"});
  Window window;
  CHECK(hardware.sequencer.take(window));
}

TEST_CASE("A finished window has its start, its mode and its codes in order", "[window]") {
  Hardware hardware;
  hardware.timer.time_us = 123'463;
  hardware.sequencer.on_window_due(123'456, 100, EmitterMode::kSwitched);
  Window window;
  CHECK_FALSE(hardware.sequencer.take(window));
  hardware.finish();
  REQUIRE(hardware.sequencer.take(window));
  CHECK(window.due_us == 123'456);
  CHECK(window.late_us == 7);
  CHECK(window.mode == EmitterMode::kSwitched);
  CHECK(window.lost_before == 0);
  // The bursts' places in the course that the first test shows.
  CHECK(window.codes.front() == 0);
  CHECK(window.codes[kConversionsPerBurst] == 3);
  CHECK(window.codes[2 * kConversionsPerBurst] == 4);
  CHECK(window.codes.back() == 7);
  CHECK_FALSE(hardware.sequencer.take(window));
}

TEST_CASE("A window that begins too late or is held up is out of step", "[window]") {
  constexpr std::uint64_t kDueUs = 1000;
  constexpr std::uint32_t kMostLateUs = 125;
  constexpr std::uint64_t kLengthUs = 556;  // 2 * 150 + 128 * 2
  constexpr std::uint64_t kMostHeldUpUs = kLengthUs / 8;
  const auto out_of_step = [](std::uint64_t late_us, std::uint64_t took_us) {
    Hardware hardware;
    hardware.timer.time_us = kDueUs + late_us;
    hardware.sequencer.on_window_due(kDueUs, kMostLateUs, EmitterMode::kSwitched);
    hardware.timer.time_us += took_us;
    hardware.finish();
    Window window;
    REQUIRE(hardware.sequencer.take(window));
    CHECK(window.late_us == late_us);
    return window.out_of_step;
  };
  CHECK_FALSE(out_of_step(0, kLengthUs));
  CHECK_FALSE(out_of_step(kMostLateUs, kLengthUs + kMostHeldUpUs));
  CHECK(out_of_step(kMostLateUs + 1, kLengthUs));
  CHECK(out_of_step(0, kLengthUs + kMostHeldUpUs + 1));
}

TEST_CASE("The wait after a change of mode is part of the lateness", "[window]") {
  Hardware hardware;
  hardware.sequencer.on_window_due(0, kSettlingUs, EmitterMode::kLit);
  hardware.timer.time_us = kSettlingUs + 2;
  hardware.finish();
  Window window;
  REQUIRE(hardware.sequencer.take(window));
  CHECK(window.late_us == kSettlingUs + 2);
}

TEST_CASE("A window that is due while one runs is lost and counted before the next", "[window]") {
  Hardware hardware;
  hardware.sequencer.on_window_due(0, 0, EmitterMode::kSwitched);
  hardware.sequencer.on_window_due(1000, 0, EmitterMode::kSwitched);
  hardware.sequencer.on_window_missed();
  hardware.finish();
  hardware.sequencer.on_window_due(3000, 0, EmitterMode::kSwitched);
  hardware.finish();
  hardware.sequencer.on_window_due(4000, 0, EmitterMode::kSwitched);
  hardware.finish();
  std::vector<std::uint32_t> lost_before;
  for (Window window; hardware.sequencer.take(window);) {
    lost_before.push_back(window.lost_before);
  }
  CHECK(lost_before == std::vector<std::uint32_t>{0, 2, 0});
}

TEST_CASE("Windows that nobody takes are lost and counted, the waiting ones kept", "[window]") {
  Hardware hardware;
  constexpr std::uint64_t kDue = kWaitingWindows + 3;
  for (std::uint64_t i = 0; i < kDue; ++i) {
    hardware.sequencer.on_window_due(i, 0, EmitterMode::kDark);
    hardware.finish();
  }
  Window window;
  for (std::uint64_t i = 0; i < kWaitingWindows; ++i) {
    REQUIRE(hardware.sequencer.take(window));
    CHECK(window.due_us == i);
  }
  REQUIRE_FALSE(hardware.sequencer.take(window));
  hardware.sequencer.on_window_due(kDue, 0, EmitterMode::kDark);
  hardware.finish();
  REQUIRE(hardware.sequencer.take(window));
  CHECK(window.lost_before == 3);
}

TEST_CASE("Interrupts without a window change nothing", "[window]") {
  Hardware hardware;
  hardware.sequencer.on_wake_up();
  hardware.sequencer.on_burst_done();
  CHECK(hardware.course.empty());
  CHECK(hardware.window(EmitterMode::kDark) == Course{"0", "wait", "0", "1", "wait", "1"});
}

}  // namespace
}  // namespace penduline::test
