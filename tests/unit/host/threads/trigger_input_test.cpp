// SPDX-License-Identifier: Apache-2.0
// Tests of the trigger input: every edge once and in order, and what happens without room.
#include "host/gpio/trigger_input.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "hal/linux/host_time.hpp"
#include "tests/unit/host/scripted_gpio.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

/// Takes until so many edges have come, or an error.
TriggerInput::Taken take(TriggerInput& trigger, std::size_t count) {
  TriggerInput::Taken all;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (all.edges.size() < count && !all.error && std::chrono::steady_clock::now() < deadline) {
    const TriggerInput::Taken taken = trigger.take();
    all.edges.insert(all.edges.end(), taken.edges.begin(), taken.edges.end());
    all.error = taken.error;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return all;
}

TEST_CASE("Edges come in order, each with both of the host's times", "[gpio]") {
  const HostTime now = host_time_now();
  const std::int64_t first_us = now.monotonic_us - 2'000'000;
  TriggerInput trigger(std::make_unique<ScriptedInput>(std::vector<GpioEdges>{
      {.host_us = {first_us, first_us + 10}}, {}, {.host_us = {first_us + 30}}}));
  const auto taken = take(trigger, 3);
  REQUIRE(taken.edges.size() == 3);
  CHECK(taken.edges[0].host_us == first_us);
  CHECK(taken.edges[1].host_us == first_us + 10);
  CHECK(taken.edges[2].host_us == first_us + 30);
  CHECK(std::abs(taken.edges[0].utc_us - (now.utc_us - 2'000'000)) < 1000);
  CHECK_FALSE(taken.edges[2].others_may_be_lost);
  CHECK(trigger.take().edges.empty());
}

TEST_CASE("The last edge of a full queue says that others may be lost", "[gpio]") {
  TriggerInput trigger(std::make_unique<ScriptedInput>(
      std::vector<GpioEdges>{{.host_us = {1, 2}, .queue_was_full = true}, {.host_us = {3}}}));
  const auto taken = take(trigger, 3);
  REQUIRE(taken.edges.size() == 3);
  CHECK_FALSE(taken.edges[0].others_may_be_lost);
  CHECK(taken.edges[1].others_may_be_lost);
  CHECK_FALSE(taken.edges[2].others_may_be_lost);
}

TEST_CASE("What nobody takes is kept up to a bound, whose last edge says so", "[gpio]") {
  // The fourth batch fails: by then the others have come.
  TriggerInput trigger(
      std::make_unique<ScriptedInput>(
          std::vector<GpioEdges>{{.host_us = {1}}, {.host_us = {2, 3, 4}}, {.host_us = {5}}}, true),
      3);
  TriggerInput::Taken taken;
  for (int i = 0; i < 10'000 && !taken.error; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const TriggerInput::Taken now = trigger.take();
    taken.edges.insert(taken.edges.end(), now.edges.begin(), now.edges.end());
    taken.error = now.error;
  }
  REQUIRE(taken.error);
  CHECK(taken.error->message == "GPIO line 'TRIGGER': No such device");
  REQUIRE(taken.edges.size() == 3);
  CHECK(taken.edges[2].host_us == 3);
  CHECK(taken.edges[2].others_may_be_lost);
}

}  // namespace
