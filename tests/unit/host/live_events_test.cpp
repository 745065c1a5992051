// SPDX-License-Identifier: Apache-2.0
// Tests of the events that viewers share: nobody holds up others, memory has a bound.
#include "host/web/live_events.hpp"

#include <catch2/catch.hpp>
#include <string>

namespace {

using namespace penduline;

std::string joined(const LiveEvents& events, std::uint64_t position) {
  std::string all;
  for (const auto& text : events.from(position)) {
    all += *text;
  }
  return all;
}

TEST_CASE("An event has its name and one line of data", "[web]") {
  CHECK(event_text("state", "{}") == "event: state\ndata: {}\n\n");
}

TEST_CASE("Each viewer goes on from where it stands", "[web]") {
  LiveEvents events;
  events.add("a");
  const auto early = events.end();
  events.add("b");
  const auto late = events.end();
  events.add("c");
  CHECK(joined(events, early) == "bc");
  CHECK(joined(events, late) == "c");
  CHECK(joined(events, events.end()).empty());
}

TEST_CASE("Viewers get the same text, which is there once", "[web]") {
  LiveEvents events;
  events.add("a");
  CHECK(events.from(0).front() == events.from(0).front());
}

TEST_CASE("A stalled viewer has missed what was too much to keep", "[web]") {
  LiveEvents events(3, 1000);
  const auto stalled = events.end();
  for (const char* text : {"a", "b", "c"}) {
    events.add(text);
  }
  CHECK(events.has_all_from(stalled));
  events.add("d");
  CHECK_FALSE(events.has_all_from(stalled));
  CHECK(events.has_all_from(stalled + 1));
  CHECK(joined(events, stalled + 1) == "bcd");
}

TEST_CASE("However much comes, only so many bytes are kept", "[web]") {
  LiveEvents events(64, 1000);
  for (int i = 0; i < 10000; ++i) {
    events.add(std::string(90, 'x'));
    REQUIRE(events.bytes() <= 1000);
  }
  CHECK(events.bytes() == 990);
  events.add(std::string(5000, 'y'));
  CHECK(events.bytes() == 5000);  // the newest one, alone
}

}  // namespace
