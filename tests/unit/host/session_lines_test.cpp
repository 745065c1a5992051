// SPDX-License-Identifier: Apache-2.0
// Tests of a session's lines together: which are opened and how, and the events of their turns.
#include "host/gpio/session_lines.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "host/session/clock_exchange.hpp"
#include "tests/unit/host/scripted_gpio.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;
using std::chrono::microseconds;

using Levels = std::vector<bool>;
using Texts = std::vector<std::string>;

const RigLines kAll{.reset = GpioLine{.name = "RESET"},
                    .release = GpioLine{.name = "MAGNET"},
                    .status_led = GpioLine{.name = "LED"},
                    .trigger = GpioLine{.name = "TRIGGER"}};

/// A rig with one line.
RigLines only(std::optional<GpioLine> RigLines::*which, const GpioLine& line) {
  RigLines lines;
  lines.*which = line;
  return lines;
}

struct Bench {
  ScriptedGpio gpio;
  Texts said;
  Texts warned;
  std::optional<DeviceClock> clock;

  tl::expected<std::unique_ptr<SessionLines>, Error> open(const RigLines& rig,
                                                          const LineSettings& settings) {
    return SessionLines::open(
        gpio, rig, settings,
        {.say = [this](const std::string& text) { said.push_back(text); },
         .warn = [this](const std::string& text) { warned.push_back(text); }});
  }

  /// The lines' events of turns until there are so many, after one turn with these of the source.
  std::vector<RecordingEvent> turns(SessionLines& lines, std::size_t count,
                                    const std::vector<RecordingEvent>& events = {}) {
    std::vector<RecordingEvent> told =
        lines.turn({.sample = true, .events = events, .clock = clock});
    for (int i = 0; i < 10'000 && told.size() < count; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      for (RecordingEvent& event : lines.turn({.sample = true, .clock = clock})) {
        told.push_back(std::move(event));
      }
    }
    return told;
  }
};

const RecordingEvent kConnected{.kind = std::string(event::kConnected)};
const RecordingEvent kDisconnected{.kind = std::string(event::kDisconnected)};

/// The clock of a board that started at the host's 5 s.
DeviceClock clock_of_board() {
  DeviceClock clock;
  clock.take({.sent_us = 9'999'900, .t_us = 5'000'000, .received_us = 10'000'100});
  return clock;
}

TEST_CASE("All lines are opened, the magnet last and holding", "[gpio]") {
  Bench bench;
  const auto lines = bench.open(kAll, {.release_after = microseconds(0), .record_trigger = true});
  REQUIRE(lines);
  CHECK(bench.gpio.opened == Texts{"RESET", "LED", "TRIGGER", "MAGNET"});
  CHECK(bench.gpio.wire("RESET")->levels() == Levels{false});
  CHECK(bench.gpio.wire("LED")->levels() == Levels{false});
  CHECK(bench.gpio.wire("MAGNET")->levels() == Levels{true});
}

TEST_CASE("Lines that the run does not use are left alone", "[gpio]") {
  Bench bench;
  REQUIRE(bench.open(kAll, {}));
  CHECK(bench.gpio.opened == Texts{"RESET", "LED"});
  Bench none;
  REQUIRE(none.open({}, {.release_after = microseconds(0), .record_trigger = true}));
  CHECK(none.gpio.opened.empty());
}

TEST_CASE("A reset that is active low is never driven high", "[gpio]") {
  Bench bench;
  REQUIRE(bench.open(only(&RigLines::reset, {.name = "RESET", .active_low = true}), {}));
  CHECK(bench.gpio.wire("RESET")->drive == GpioDrive::kOpenDrain);
  REQUIRE(bench.open(only(&RigLines::reset, {.name = "OTHER"}), {}));
  CHECK(bench.gpio.wire("OTHER")->drive == GpioDrive::kPushPull);
}

TEST_CASE("A line that cannot be had fails the opening, and the others let go", "[gpio]") {
  for (const std::string missing : {"RESET", "LED", "TRIGGER", "MAGNET"}) {
    Bench bench;
    bench.gpio.missing = missing;
    const auto lines = bench.open(kAll, {.release_after = microseconds(0), .record_trigger = true});
    REQUIRE_FALSE(lines);
    CHECK(lines.error().message == "no " + missing);
    CHECK(bench.gpio.opened.back() == missing);
  }
}

TEST_CASE("At the end every output is inactive", "[gpio]") {
  Bench bench;
  {
    const auto lines = bench.open(kAll, {.release_after = std::chrono::hours(1)});
    bench.turns(**lines, 0, {kConnected});
    CHECK(bench.gpio.wire("LED")->levels() == Levels{false, true});
  }
  CHECK(bench.gpio.wire("RESET")->levels() == Levels{false, false});
  CHECK(bench.gpio.wire("LED")->levels() == Levels{false, true, false});
  CHECK(bench.gpio.wire("MAGNET")->levels() == Levels{true, false});
}

TEST_CASE("The release is an event with the host's times and the board's", "[gpio]") {
  Bench bench;
  bench.clock = clock_of_board();
  const auto lines = bench.open(kAll, {.release_after = microseconds(1000)});
  CHECK((*lines)->turn({.clock = bench.clock}).empty());  // no sample yet
  const auto events = bench.turns(**lines, 1, {kConnected});
  REQUIRE(events.size() == 1);
  CHECK(events[0].kind == "release");
  CHECK(events[0].utc_us);
  const auto host_us = events[0].get<std::int64_t>("host_us").value();
  const auto moment = bench.clock->board_moment(host_us).value();
  CHECK(events[0].get<std::int64_t>("t_us") == moment.t_us);
  CHECK(events[0].get<std::int64_t>("t_uncertainty_us") == std::ceil(moment.uncertainty_us));
  CHECK(bench.said == Texts{"the magnet has let go"});
  CHECK(bench.gpio.wire("MAGNET")->levels() == Levels{true, false});
}

TEST_CASE("A magnet that does not let go is a warning and no event", "[gpio]") {
  Bench bench;
  const auto lines = bench.open(kAll, {.release_after = microseconds(0)});
  bench.gpio.wire("MAGNET")->broken = true;
  for (int i = 0; i < 10'000 && bench.warned.empty(); ++i) {
    CHECK(bench.turns(**lines, 0).empty());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  CHECK(bench.warned == Texts{"the magnet did not let go: GPIO line 'W': No such device"});
}

TEST_CASE("Trigger edges are events in their order, with the board's time", "[gpio]") {
  Bench bench;
  bench.clock = clock_of_board();
  bench.gpio.edges = {{.host_us = {20'000'000, 20'000'300}}, {.host_us = {21'000'000}}};
  const auto lines = bench.open(kAll, {.record_trigger = true});
  const auto events = bench.turns(**lines, 3, {kConnected});
  REQUIRE(events.size() == 3);
  const std::vector<std::int64_t> host_us{20'000'000, 20'000'300, 21'000'000};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(events[i].kind == "trigger");
    CHECK(events[i].get<std::int64_t>("host_us") == host_us[i]);
    CHECK(events[i].get<std::int64_t>("t_us") == host_us[i] - 5'000'000);
    CHECK(events[i].get<std::string>("edge") == "rising");
    CHECK_FALSE(events[i].get<std::string>("queue"));
  }
  CHECK_FALSE((*lines)->edges_lost());
}

TEST_CASE("The board's time is left out while the board is away or its clock unknown", "[gpio]") {
  Bench unknown;
  unknown.gpio.edges = {{.host_us = {20'000'000}}};
  const auto waiting = unknown.open(kAll, {.record_trigger = true});
  CHECK_FALSE(unknown.turns(**waiting, 1, {kConnected}).at(0).get<std::int64_t>("t_us"));

  Bench away;
  away.clock = clock_of_board();
  away.gpio.edges = unknown.gpio.edges;
  const auto lines = away.open(kAll, {.record_trigger = true});
  const auto events = away.turns(**lines, 1, {kConnected, kDisconnected});
  CHECK_FALSE(events.at(0).get<std::int64_t>("t_us"));
  CHECK(events.at(0).get<std::int64_t>("host_us") == 20'000'000);
}

TEST_CASE("Of a trigger that is active low the edges are falling ones", "[gpio]") {
  Bench bench;
  bench.gpio.edges = {{.host_us = {1}}};
  const auto lines = bench.open(only(&RigLines::trigger, {.name = "TRIGGER", .active_low = true}),
                                {.record_trigger = true});
  CHECK(bench.turns(**lines, 1).at(0).get<std::string>("edge") == "falling");
}

TEST_CASE("Edges that may be lost are told once and marked each time", "[gpio]") {
  Bench bench;
  bench.gpio.edges = {{.host_us = {1, 2}, .queue_was_full = true},
                      {.host_us = {3}, .queue_was_full = true}};
  const auto lines = bench.open(kAll, {.record_trigger = true});
  const auto events = bench.turns(**lines, 3);
  CHECK_FALSE(events.at(0).get<std::string>("queue"));
  CHECK(events.at(1).get<std::string>("queue") == "full");
  CHECK(events.at(2).get<std::string>("queue") == "full");
  CHECK(bench.warned == Texts{"trigger edges came faster than they were taken, some may be lost; "
                              "the recording says where (queue = \"full\")"});
  CHECK((*lines)->edges_lost());
}

}  // namespace
