// SPDX-License-Identifier: Apache-2.0
// libgpiod on the kernel's gpio-sim: what Penduline relies on when it holds a board's lines.
#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <gpiod.hpp>
#include <string>
#include <system_error>

#include "tests/kernel/libraries/system_file.hpp"

namespace penduline::test {
namespace {

using namespace std::chrono_literals;

constexpr unsigned kReset = 0;
constexpr unsigned kMagnet = 1;
constexpr unsigned kTrigger = 3;

std::string sim_file(unsigned offset, const std::string& name) {
  return std::string(std::getenv("GPIO_SIM")) + "/sim_gpio" + std::to_string(offset) + "/" + name;
}

/// What is on the wire.
std::string level(unsigned offset) {
  return read_system_file(sim_file(offset, "value"));
}

/// What the world at the other end of the wire does: "pull-up" or "pull-down".
void pull(unsigned offset, const std::string& direction) {
  write_system_file(sim_file(offset, "pull"), direction);
}

void request_output(gpiod::line& line, int value) {
  line.request({"penduline", gpiod::line_request::DIRECTION_OUTPUT, 0}, value);
}

TEST_CASE("A line is found by its name on whatever chip it is", "[gpio]") {
  const gpiod::line magnet = gpiod::find_line("penduline-magnet");
  REQUIRE(magnet);
  CHECK(magnet.offset() == kMagnet);
  CHECK_FALSE(gpiod::find_line("no-such-line"));
}

TEST_CASE("An output drives its wire and gives it back to its pull when released", "[gpio]") {
  pull(kReset, "pull-up");
  gpiod::line line = gpiod::find_line("penduline-reset");
  request_output(line, 1);
  CHECK(level(kReset) == "1");
  line.set_value(0);
  CHECK(level(kReset) == "0");
  line.release();
  CHECK(level(kReset) == "1");
}

TEST_CASE("A line that is held is refused to a second one with EBUSY", "[gpio]") {
  gpiod::line first = gpiod::find_line("penduline-magnet");
  gpiod::line second = gpiod::find_line("penduline-magnet");
  request_output(first, 0);
  int reason = 0;
  try {
    request_output(second, 1);
  } catch (const std::system_error& error) {
    reason = error.code().value();
  }
  CHECK(reason == EBUSY);
  CHECK(level(kMagnet) == "0");
  first.release();
  request_output(second, 1);
  CHECK(level(kMagnet) == "1");
}

TEST_CASE("A process that is killed gives its lines back", "[gpio]") {
  pull(kMagnet, "pull-down");
  const pid_t holder = ::fork();
  REQUIRE(holder >= 0);
  if (holder == 0) {
    gpiod::line line = gpiod::find_line("penduline-magnet");
    request_output(line, 1);
    while (true) {
      ::pause();
    }
  }
  for (int i = 0; i < 1000 && level(kMagnet) == "0"; ++i) {
    ::usleep(1000);
  }
  CHECK(level(kMagnet) == "1");
  REQUIRE(::kill(holder, SIGKILL) == 0);
  REQUIRE(::waitpid(holder, nullptr, 0) == holder);
  CHECK(level(kMagnet) == "0");
}

std::chrono::nanoseconds monotonic_now() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

TEST_CASE("An edge comes with its kind and its moment on the monotonic clock", "[gpio]") {
  pull(kTrigger, "pull-down");
  gpiod::line line = gpiod::find_line("penduline-trigger");
  line.request({"penduline", gpiod::line_request::EVENT_BOTH_EDGES, 0});
  CHECK_FALSE(line.event_wait(20ms));
  for (const auto& [direction, kind] : {std::pair{"pull-up", gpiod::line_event::RISING_EDGE},
                                        {"pull-down", gpiod::line_event::FALLING_EDGE}}) {
    const auto before = monotonic_now();
    pull(kTrigger, direction);
    REQUIRE(line.event_wait(1s));
    const gpiod::line_event event = line.event_read();
    CHECK(event.event_type == kind);
    CHECK(event.timestamp >= before);
    CHECK(event.timestamp <= monotonic_now());
  }
}

}  // namespace
}  // namespace penduline::test
