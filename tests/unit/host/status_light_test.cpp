// SPDX-License-Identifier: Apache-2.0
// Tests of the status light: lit while samples come, dark otherwise.
#include "host/gpio/status_light.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/unit/host/scripted_gpio.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;
using std::chrono::milliseconds;

using Levels = std::vector<bool>;

struct Bench {
  std::shared_ptr<Wire> wire = std::make_shared<Wire>();
  std::vector<std::string> warnings;
  StatusLight light{std::make_unique<ScriptedOutput>(wire, false),
                    [this](const std::string& text) { warnings.push_back(text); }};

  void sample(int ms) { light.turn(true, true, at(ms)); }
  void nothing(int ms) { light.turn(false, true, at(ms)); }
  void gone(int ms) { light.turn(false, false, at(ms)); }

 private:
  static StatusLight::Clock::time_point at(int ms) {
    return StatusLight::Clock::time_point(milliseconds(ms));
  }
};

TEST_CASE("The light is dark until a sample comes, and then switched once", "[gpio]") {
  Bench bench;
  bench.nothing(0);
  CHECK(bench.wire->levels() == Levels{false});
  bench.sample(100);
  bench.nothing(120);
  bench.sample(150);
  CHECK(bench.wire->levels() == Levels{false, true});
}

TEST_CASE("The light goes out a second and two intervals after the last sample", "[gpio]") {
  Bench bench;
  bench.sample(0);
  bench.sample(50);
  bench.nothing(1149);
  CHECK(bench.wire->levels() == Levels{false, true});
  bench.nothing(1150);
  CHECK(bench.wire->levels() == Levels{false, true, false});
}

TEST_CASE("Slow sampling does not make it blink", "[gpio]") {
  Bench bench;
  for (int ms = 0; ms < 100'000; ms += 100) {
    if (ms % 10'000 == 0) {
      bench.sample(ms);
    } else {
      bench.nothing(ms);
    }
  }
  // Only before the second sample nobody knew how slow it is.
  CHECK(bench.wire->levels() == Levels{false, true, false, true});
}

TEST_CASE("The light goes out at once when the board has gone", "[gpio]") {
  Bench bench;
  bench.sample(0);
  bench.sample(50);
  bench.gone(60);
  CHECK(bench.wire->levels() == Levels{false, true, false});
  bench.nothing(70);  // back, and no sample yet
  CHECK(bench.wire->levels() == Levels{false, true, false});
  bench.sample(5000);
  CHECK(bench.wire->levels() == Levels{false, true, false, true});
  bench.nothing(6000);  // the time without the board is no interval
  CHECK(bench.wire->levels() == Levels{false, true, false, true, false});
}

TEST_CASE("A light that cannot be switched is told once and ends nothing", "[gpio]") {
  Bench bench;
  bench.wire->broken = true;
  bench.sample(0);
  bench.nothing(5000);
  bench.sample(5001);
  CHECK(bench.warnings == std::vector<std::string>{"GPIO line 'W': No such device"});
}

}  // namespace
