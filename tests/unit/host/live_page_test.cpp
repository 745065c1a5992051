// SPDX-License-Identifier: Apache-2.0
// Tests of the events that come of a session's news.
#include "host/web/live_page.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/host/headers.hpp"
#include "tests/unit/host/rig_text.hpp"
#include "tests/unit/host/scripted_source.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;
using namespace std::chrono_literals;
using Json = nlohmann::json;
using Events = std::vector<std::pair<std::string, Json>>;

const RigFile kRig = parse_rig(std::string(kRigText), "rig.toml").value();

/// Names and data of a stream; a comment has neither.
Events events_in(const std::string& stream) {
  Events events;
  for (std::size_t at = 0; (at = stream.find("event: ", at)) != std::string::npos;) {
    const std::size_t name_end = stream.find('\n', at);
    const std::size_t end = stream.find("\n\n", at);
    const std::string name = stream.substr(at + 7, name_end - at - 7);
    events.emplace_back(name, Json::parse(stream.substr(name_end + 7, end - name_end - 7)));
    at = end;
  }
  return events;
}

std::vector<std::string> names_of(const Events& events) {
  std::vector<std::string> names;
  for (const auto& [name, data] : events) {
    names.push_back(name);
  }
  return names;
}

/// A page of a session, turned by hand.
struct Session {
  explicit Session(double rate_hz = 20)
      : page(feed, {.rig = kRig, .header = header_of("sim", rate_hz)},
             [this] { return recording; }) {
    seen = page.events().end();
  }

  void sample(std::uint64_t seq, std::int64_t t_us, Flags flags = 0) {
    Sample one = rest_sample(seq);
    one.t_us = t_us;
    feed.take(one);
    feed.take(Estimate<double>{.t_us = t_us, .seq = seq, .flags = flags});
  }
  /// The events of a turn, so long after the one before.
  Events turn(std::chrono::milliseconds later = 50ms) {
    page.turn(now += later);
    std::string stream;
    for (const auto& text : page.events().from(std::exchange(seen, page.events().end()))) {
      stream += *text;
    }
    return events_in(stream);
  }

  LiveFeed feed;
  RecordingState recording{.can_record = true};
  LivePage page;
  LivePage::Clock::time_point now = LivePage::Clock::now();
  std::uint64_t seen = 0;
};

using Names = std::vector<std::string>;

TEST_CASE("A new viewer gets session, points, notes and state, in this order", "[web]") {
  Session session;
  session.sample(0, 0);
  session.feed.note({.kind = "release"});
  session.turn();
  const Events greeting = events_in(session.page.greeting());
  CHECK(names_of(greeting) == Names{"session", "points", "note", "state"});
  CHECK(greeting[1].second["t_s"].size() == 1);
  CHECK(names_of(events_in(session.page.resumption())) == Names{"session", "state"});
}

TEST_CASE("A turn without news tells nothing, and the state once a second", "[web]") {
  Session session;
  session.turn(1s);
  CHECK(session.turn().empty());
  CHECK(names_of(session.turn(1s)) == Names{"state"});
}

TEST_CASE("Points are told once, each turn's alone", "[web]") {
  Session session;
  session.turn(1s);
  session.sample(0, 0);
  session.sample(1, 50'000);
  CHECK(session.turn().at(0).second["t_s"] == Json::parse("[0.0, 0.05]"));
  session.sample(2, 100'000);
  CHECK(session.turn().at(0).second["t_s"] == Json::parse("[0.1]"));
}

TEST_CASE("Above 100 Hz points are thinned", "[web]") {
  Session session(1000);
  for (int i = 0; i < 1000; ++i) {
    session.sample(static_cast<std::uint64_t>(i), 1000 * i);
  }
  session.turn();
  const auto points = events_in(session.page.greeting()).at(1).second;
  // 49 whole bins at rest: one row has every extreme.
  CHECK(points["t_s"].size() == 49);
}

TEST_CASE("A new viewer gets the points second by second", "[web]") {
  Session session;
  for (int i = 0; i < 50; ++i) {
    session.sample(static_cast<std::uint64_t>(i), 50'000 * i);
  }
  session.turn();
  const Events greeting = events_in(session.page.greeting());
  REQUIRE(names_of(greeting) == Names{"session", "points", "points", "points", "state"});
  CHECK(greeting[1].second["t_s"].size() == 20);
  CHECK(greeting[2].second["t_s"].front() == 1.0);
  CHECK(greeting[3].second["t_s"].back() == 2.45);
}

TEST_CASE("Above 100 Hz a row without answers stands in a dropout", "[web]") {
  Session session(1000);
  for (const int t_ms : {0, 1, 2, 3, 4, 5, 15, 16, 17, 18, 50}) {
    session.sample(static_cast<std::uint64_t>(t_ms), 1000 * t_ms);
  }
  session.turn();
  const auto points = events_in(session.page.greeting()).at(1).second;
  // At rest the first row of a bin has every extreme.
  CHECK(points["t_s"] == Json::parse("[0.0, 0.01, 0.034]"));
  CHECK(points["signal_v"][0][0].is_number());
  CHECK(points["signal_v"][0][1].is_null());
  CHECK(points["signal_v"][0][2].is_null());
}

TEST_CASE("A recording that begins is a change of the session", "[web]") {
  Session session;
  session.turn(1s);
  session.recording.name = "a.csv";
  session.recording.samples = 3;
  const Events events = session.turn();
  CHECK(names_of(events) == Names{"session", "state"});
  CHECK(events[0].second["recording"]["name"] == "a.csv");
  CHECK(events[1].second["recorded_samples"] == 3);
}

TEST_CASE("A board that goes away changes the state at once", "[web]") {
  Session session;
  session.turn(1s);
  session.feed.note({.kind = "disconnected", .fields = {{"reason", std::string("gone")}}});
  Events events = session.turn();
  CHECK(names_of(events) == Names{"note", "state"});
  CHECK(events[1].second["connected"] == false);
  session.feed.tell(header_of("nucleo"));
  session.feed.note({.kind = "connected"});
  events = session.turn();
  CHECK(names_of(events) == Names{"session", "note", "state"});
  CHECK(events[0].second["board"] == "nucleo");
  CHECK(events[2].second["connected"] == true);
}

TEST_CASE("A flag has the moment of its last sample", "[web]") {
  Session session;
  Summary counts(Acquisition<double>{});
  session.sample(0, 1'000'000);
  session.sample(1, 3'500'000, flag::kStray);
  session.sample(2, 4'000'000);
  counts.count(Estimate<double>{.flags = flag::kStray});
  session.feed.tell(counts);
  const Events events = session.turn(1s);
  CHECK(events.back().second["flags"] ==
        Json::parse(R"([{"name": "stray", "count": 1, "latest_s": 2.5}])"));
}

TEST_CASE("A board's first sample is no restart, a later start is one", "[web]") {
  Session session;
  Summary counts(Acquisition<double>{});
  const auto start = [&](std::uint64_t seq) {
    Sample first = rest_sample(seq);
    first.flags = flag::kRestarted;
    session.feed.take(first);
    session.feed.take(Estimate<double>{.t_us = first.t_us, .flags = flag::kRestarted});
    counts.count(Estimate<double>{.flags = flag::kRestarted});
    session.feed.tell(counts);
    return session.turn(1s).back().second["restarts"];
  };
  CHECK(start(0) == 0);
  CHECK(start(0) == 1);
}

TEST_CASE("An event stands at its own time by the board's clock, not at the newest sample's",
          "[web]") {
  Session session;
  session.sample(0, 1'000'000);
  session.sample(1, 1'500'000);
  const auto at = [](std::int64_t t_us) {
    return RecordingEvent{.kind = "trigger", .fields = {{"t_us", t_us}}};
  };
  session.feed.note(at(1'123'456));
  session.feed.note(at(90'000'000));  // of the start before
  std::vector<double> times;
  for (const auto& [name, data] : session.turn()) {
    if (name == "note") {
      times.push_back(data["t_s"].get<double>());
    }
  }
  REQUIRE(times.size() == 2);
  CHECK(times[0] == Approx(0.123456));
  CHECK(times[1] == Approx(0.5).margin(0.1));
}

TEST_CASE("Of many notes a new viewer gets the last 50", "[web]") {
  Session session;
  for (int i = 0; i < 60; ++i) {
    session.feed.note({.kind = "mark", .fields = {{"text", std::to_string(i)}}});
  }
  session.turn();
  const Events greeting = events_in(session.page.greeting());
  REQUIRE(greeting.size() == 53);
  CHECK(greeting[2].second["text"] == "10");
}

}  // namespace
