// SPDX-License-Identifier: Apache-2.0
// Tests of the reset line: a pulse's length, and when a board that does not talk gets one.
#include "host/gpio/board_reset.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/unit/host/scripted_gpio.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;
using std::chrono::seconds;

/// A reset line and what came of it.
struct Bench {
  std::shared_ptr<Wire> wire = std::make_shared<Wire>();
  std::vector<std::string> said;
  BoardReset reset{std::make_unique<ScriptedOutput>(wire, false),
                   [this](const std::string& text) { said.push_back(text); }};

  [[nodiscard]] long pulses() const {
    const auto levels = wire->levels();
    return std::count(levels.begin(), levels.end(), true);
  }
};

BoardReset::Clock::time_point at(int s) {
  return BoardReset::Clock::time_point(seconds(s));
}

TEST_CASE("A pulse is a tenth of a second", "[gpio]") {
  Bench bench;
  REQUIRE(bench.reset.pulse());
  const auto changes = bench.wire->changes();
  REQUIRE(bench.wire->levels() == std::vector<bool>{false, true, false});
  CHECK(changes[2].at - changes[1].at >= BoardReset::kPulse);
}

TEST_CASE("A board that does not talk is reset after 10 s, then after 20 s more, and so on",
          "[gpio]") {
  Bench bench;
  std::vector<int> pulsed_at;
  for (int s = 100; s < 1100; ++s) {
    const long before = bench.pulses();
    bench.reset.not_answered(at(s));
    if (bench.pulses() > before) {
      pulsed_at.push_back(s);
    }
  }
  CHECK(pulsed_at == std::vector<int>{110, 130, 170, 250, 410, 730, 1050});
  CHECK(bench.said == std::vector<std::string>{
                          "reset the board, which has not talked for 10 s; while it stays so again "
                          "after 20 s, 40 s and so on"});
}

TEST_CASE("A board that has answered has its 10 s again, and is told of again", "[gpio]") {
  Bench bench;
  bench.reset.not_answered(at(0));
  bench.reset.not_answered(at(10));
  CHECK(bench.pulses() == 1);
  bench.reset.answered();
  bench.reset.not_answered(at(40));
  bench.reset.not_answered(at(49));
  CHECK(bench.pulses() == 1);
  bench.reset.not_answered(at(50));
  CHECK(bench.pulses() == 2);
  CHECK(bench.said.size() == 2);
}

TEST_CASE("A board that is plugged in anew has its 10 s, but no shorter back-off", "[gpio]") {
  Bench bench;
  bench.reset.not_there(at(0));
  bench.reset.not_answered(at(0));
  bench.reset.not_answered(at(10));
  CHECK(bench.pulses() == 1);
  bench.reset.not_there(at(29));  // it would be due at 30
  bench.reset.not_answered(at(38));
  CHECK(bench.pulses() == 1);
  bench.reset.not_answered(at(39));
  CHECK(bench.pulses() == 2);
  bench.reset.not_there(at(40));  // due at 79
  bench.reset.not_answered(at(78));
  CHECK(bench.pulses() == 2);
}

TEST_CASE("A reset line that fails is told once", "[gpio]") {
  Bench bench;
  bench.wire->broken = true;
  CHECK(bench.reset.pulse().error().message == "GPIO line 'W': No such device");
  for (int s = 0; s < 100; ++s) {
    bench.reset.not_answered(at(s));
  }
  CHECK(bench.said ==
        std::vector<std::string>{"the board could not be reset: GPIO line 'W': No such device"});
}

}  // namespace
