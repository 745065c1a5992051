// SPDX-License-Identifier: Apache-2.0
// Tests of marks: any text in, one line of a recording out.
#include "host/web/marks.hpp"

#include <catch2/catch.hpp>
#include <string>

namespace {

using namespace penduline;

TEST_CASE("A mark has the moment at which it was set, and its text", "[web]") {
  Marks marks;
  const HostTime before = host_time_now();
  REQUIRE(marks.set("touched the table"));
  const auto events = marks.take(std::nullopt);
  REQUIRE(events.size() == 1);
  CHECK(events[0].kind == "mark");
  CHECK(events[0].get<std::string>("text") == "touched the table");
  CHECK(*events[0].utc_us >= before.utc_us);
  CHECK(*events[0].get<std::int64_t>("host_us") >= before.monotonic_us);
  CHECK_FALSE(events[0].get<std::int64_t>("t_us"));
  CHECK(marks.take(std::nullopt).empty());
}

TEST_CASE("A mark has the board's time where its clock is known", "[web]") {
  Marks marks;
  DeviceClock clock;
  const HostTime now = host_time_now();
  static_cast<void>(clock.take({.sent_us = now.monotonic_us,
                                .t_us = 5'000'000,
                                .received_us = now.monotonic_us + 100,
                                .utc_us = now.utc_us}));
  REQUIRE(marks.set(""));
  const auto events = marks.take(clock);
  const auto t_us = events.at(0).get<std::int64_t>("t_us");
  REQUIRE(t_us);
  CHECK(*t_us == Approx(5e6 + static_cast<double>(*events[0].get<std::int64_t>("host_us") -
                                                  now.monotonic_us))
                     .margin(200));
}

TEST_CASE("More marks than anybody can set wait for nobody", "[web]") {
  Marks marks;
  for (int i = 0; i < 64; ++i) {
    REQUIRE(marks.set("x"));
  }
  CHECK_FALSE(marks.set("x"));
  CHECK(marks.take(std::nullopt).size() == 64);
  CHECK(marks.set("x"));
}

TEST_CASE("A mark's text is one line, cut between characters", "[web]") {
  CHECK(mark_text("a\nb\r\tc\x7f") == "a b  c ");
  CHECK(mark_text(std::string(300, 'a')) == std::string(200, 'a'));
  // 199 bytes and then one character of two.
  CHECK(mark_text(std::string(199, 'a') + "\xc3\xa4") == std::string(199, 'a'));
  CHECK(mark_text(std::string(198, 'a') + "\xc3\xa4z") == std::string(198, 'a') + "\xc3\xa4");
}

TEST_CASE("No text breaks out of its line of the recording", "[web]") {
  Marks marks;
  REQUIRE(marks.set("\" }\n1,2,3\n# event = { kind = \"boot\" }"));
  const std::string line = event_line(marks.take(std::nullopt).at(0));
  CHECK(line.find('\n') == line.size() - 1);
  const auto event = parse_event(line.substr(0, line.size() - 1));
  REQUIRE(event);
  CHECK(event->kind == "mark");
  CHECK(event->get<std::string>("text") == "\" } 1,2,3 # event = { kind = \"boot\" }");
}

}  // namespace
