// SPDX-License-Identifier: Apache-2.0
// Tests of when windows are due, and which of them are missed.
#include "hal/window_schedule.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

namespace penduline::test {
namespace {

constexpr std::uint32_t kPeriodUs = 1000;

struct HandSetClock {
  std::uint64_t time_us = 0;
  [[nodiscard]] std::uint64_t now_us() const { return time_us; }
};

/// Notes what is asked of it, instead of taking windows.
struct NotedWindows {
  std::vector<std::uint64_t> due_us{};
  std::uint32_t most_late_us = 0;
  EmitterMode mode = EmitterMode::kSwitched;
  int missed = 0;
  HandSetClock* clock = nullptr;
  std::uint64_t takes_us = 0;  ///< to begin one

  void on_window_due(std::uint64_t at_us, std::uint32_t late_us, EmitterMode new_mode) {
    due_us.push_back(at_us);
    most_late_us = late_us;
    mode = new_mode;
    clock->time_us += takes_us;
  }
  void on_window_missed() { ++missed; }
};

/// A schedule that began at 500 us: its first window is due at 1500 us.
struct Sampling {
  HandSetClock clock{.time_us = 500};
  NotedWindows windows{.clock = &clock};
  WindowSchedule schedule;
  Sampling() { REQUIRE(schedule.start(kPeriodUs, EmitterMode::kSwitched, clock.now_us())); }
  void alarm_at(std::uint64_t time_us) {
    clock.time_us = time_us;
    schedule.on_alarm(windows, clock);
  }
};

TEST_CASE("Windows are due a period after one another, also after a late alarm", "[schedule]") {
  Sampling sampling;
  CHECK(sampling.schedule.due_us() == 1500);
  sampling.alarm_at(1500);
  CHECK(sampling.schedule.due_us() == 2500);
  sampling.alarm_at(2900);
  CHECK(sampling.schedule.due_us() == 3500);
  CHECK(sampling.windows.due_us == std::vector<std::uint64_t>{1500, 2500});
  CHECK(sampling.windows.most_late_us == 125);
  CHECK(sampling.windows.missed == 0);
}

TEST_CASE("Windows that are late by more than a period are missed, the newest taken",
          "[schedule]") {
  Sampling sampling;
  sampling.alarm_at(5700);  // due 1500, 2500, 3500, 4500 and 5500
  CHECK(sampling.windows.due_us == std::vector<std::uint64_t>{5500});
  CHECK(sampling.windows.missed == 4);
  CHECK(sampling.schedule.due_us() == 6500);
}

TEST_CASE("An alarm is never set into the past or to a moment that is nearly past", "[schedule]") {
  Sampling sampling;
  sampling.windows.takes_us = 981;  // the next, due at 2500, is 19 us away
  sampling.alarm_at(1500);
  CHECK(sampling.schedule.due_us() == 3500);
  CHECK(sampling.windows.missed == 1);
}

TEST_CASE("A new period and mode hold after the window that is due next", "[schedule]") {
  Sampling sampling;
  CHECK_FALSE(sampling.schedule.start(4000, EmitterMode::kDark, 600));
  CHECK(sampling.schedule.due_us() == 1500);
  sampling.alarm_at(1500);
  CHECK(sampling.windows.mode == EmitterMode::kDark);
  CHECK(sampling.windows.most_late_us == 500);
  CHECK(sampling.schedule.due_us() == 5500);
}

}  // namespace
}  // namespace penduline::test
