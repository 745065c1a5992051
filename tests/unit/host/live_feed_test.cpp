// SPDX-License-Identifier: Apache-2.0
// Tests of what the session leaves for the web server.
#include "host/web/live_feed.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/unit/host/headers.hpp"

namespace {

using namespace penduline;

void put(LiveFeed& feed, std::uint64_t seq) {
  feed.take(Sample{.seq = seq});
  feed.take(Estimate<double>{.seq = seq});
}

std::vector<std::uint64_t> collected(LiveFeed& feed) {
  LiveNews news;
  feed.collect(news);
  std::vector<std::uint64_t> seqs;
  for (const LiveSample& live : news.samples) {
    CHECK(live.sample.seq == live.estimate.seq);
    seqs.push_back(live.sample.seq);
  }
  return seqs;
}

TEST_CASE("Samples come out once, in order, with their estimates", "[web]") {
  LiveFeed feed;
  put(feed, 1);
  put(feed, 2);
  CHECK(collected(feed) == std::vector<std::uint64_t>{1, 2});
  CHECK(collected(feed).empty());
}

TEST_CASE("Nobody who takes them: the newest samples are kept, and no more", "[web]") {
  LiveFeed feed(4);
  for (std::uint64_t seq = 0; seq < 10; ++seq) {
    put(feed, seq);
  }
  CHECK(collected(feed) == std::vector<std::uint64_t>{6, 7, 8, 9});
  put(feed, 10);
  CHECK(collected(feed) == std::vector<std::uint64_t>{10});
}

TEST_CASE("Once filled, the feed takes samples without asking for memory", "[web]") {
  LiveFeed feed(4);
  LiveNews news;
  const LiveSample* places[2] = {};
  for (std::uint64_t round = 0; round < 10; ++round) {
    for (std::uint64_t seq = 0; seq < 6; ++seq) {
      put(feed, seq);
    }
    feed.collect(news);
    const LiveSample*& place = places[round % 2];
    CHECK((place == nullptr || place == news.samples.data()));
    place = news.samples.data();
  }
}

TEST_CASE("Notes have a bound, too", "[web]") {
  LiveFeed feed(4, 2);
  for (const char* kind : {"a", "b", "c"}) {
    feed.note({.kind = kind});
  }
  LiveNews news;
  feed.collect(news);
  REQUIRE(news.notes.size() == 2);
  CHECK(news.notes[1].event.kind == "b");
}

TEST_CASE("The source's header is told once, when it is told", "[web]") {
  LiveFeed feed;
  feed.tell(test::header_of("pico"));
  LiveNews news;
  feed.collect(news);
  REQUIRE(news.header);
  CHECK(news.header->board == "pico");
  feed.collect(news);
  CHECK_FALSE(news.header);
}

}  // namespace
