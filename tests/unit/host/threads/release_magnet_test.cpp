// SPDX-License-Identifier: Apache-2.0
// Tests of the magnet: it holds, lets go once at its moment, and lets go at the end.
#include "host/gpio/release_magnet.hpp"

#include <catch2/catch.hpp>
#include <thread>
#include <vector>

#include "tests/unit/host/scripted_gpio.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;
using std::chrono::milliseconds;

using Levels = std::vector<bool>;

/// The release, within 10 s.
tl::expected<HostTime, Error> release_of(ReleaseMagnet& magnet) {
  for (int i = 0; i < 10'000; ++i) {
    if (auto release = magnet.take_release()) {
      return *release;
    }
    std::this_thread::sleep_for(milliseconds(1));
  }
  return failure("no release");
}

std::int64_t us_of(ReleaseMagnet::Clock::time_point moment) {
  return std::chrono::duration_cast<std::chrono::microseconds>(moment.time_since_epoch()).count();
}

TEST_CASE("The magnet holds until its time begins and is over", "[gpio]") {
  const auto wire = std::make_shared<Wire>();
  ReleaseMagnet magnet(std::make_unique<ScriptedOutput>(wire, true), milliseconds(50));
  std::this_thread::sleep_for(milliseconds(80));
  CHECK(wire->levels() == Levels{true});
  CHECK_FALSE(magnet.take_release());

  const auto begun = ReleaseMagnet::Clock::now();
  magnet.begin(begun);
  magnet.begin(begun + milliseconds(20));  // no second time
  const auto release = release_of(magnet);
  REQUIRE(release);
  const auto changes = wire->changes();
  REQUIRE(wire->levels() == Levels{true, false});
  CHECK(changes[1].at >= begun + milliseconds(50));
  CHECK(std::abs(release->monotonic_us - us_of(changes[1].at)) < 5000);
  CHECK_FALSE(magnet.take_release());
}

TEST_CASE("The magnet lets go when it goes, without waiting for its moment", "[gpio]") {
  const auto wire = std::make_shared<Wire>();
  const auto begun = ReleaseMagnet::Clock::now();
  {
    ReleaseMagnet magnet(std::make_unique<ScriptedOutput>(wire, true), std::chrono::hours(1));
    magnet.begin(begun);
  }
  CHECK(wire->levels() == Levels{true, false});
  CHECK(ReleaseMagnet::Clock::now() - begun < std::chrono::minutes(1));
}

TEST_CASE("A magnet that cannot be switched is told with its line", "[gpio]") {
  const auto wire = std::make_shared<Wire>();
  ReleaseMagnet magnet(std::make_unique<ScriptedOutput>(wire, true), milliseconds(1));
  wire->broken = true;
  magnet.begin(ReleaseMagnet::Clock::now());
  CHECK(release_of(magnet).error().message == "GPIO line 'W': No such device");
}

}  // namespace
