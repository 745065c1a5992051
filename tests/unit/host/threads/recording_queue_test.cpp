// SPDX-License-Identifier: Apache-2.0
// Tests of the queue between sampling and disk: order, losses that are counted, waiting.
#include "host/recorder/recording_queue.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/unit/host/scripted_source.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;
using namespace std::chrono_literals;

using Clock = std::chrono::steady_clock;
using Lines = std::vector<std::string>;
using WhenFull = RecordingQueue::WhenFull;

/// An entry as text: a sample's number or an event's line.
std::string shown(const RecordingEntry& entry) {
  if (const auto* sample = std::get_if<Sample>(&entry)) {
    return fmt::format("{}", sample->seq);
  }
  if (const auto* event = std::get_if<RecordingEvent>(&entry)) {
    return event_line(*event);
  }
  return "board " + std::get<std::unique_ptr<const BoardReturn>>(entry)->header.board;
}

/// What `take` gives at once.
Lines taken(RecordingQueue& queue) {
  std::vector<RecordingEntry> entries;
  queue.take(entries, Clock::now());
  Lines lines;
  for (const RecordingEntry& entry : entries) {
    lines.push_back(shown(entry));
  }
  return lines;
}

void put_samples(RecordingQueue& queue, std::uint64_t begin, std::uint64_t end) {
  for (std::uint64_t seq = begin; seq < end; ++seq) {
    REQUIRE(queue.put(rest_sample(seq)));
  }
}

const std::string kEvent = "# event = { kind = \"trigger\" }\n";

TEST_CASE("Entries come out in the order in which they went in", "[recorder]") {
  RecordingQueue queue(10, WhenFull::kLose);
  put_samples(queue, 0, 2);
  REQUIRE(queue.put(RecordingEvent{.kind = "trigger"}));
  REQUIRE(queue.put(std::make_unique<BoardReturn>(
      BoardReturn{.header = {.acquisition = {}, .board = "pico", .firmware = "", .started = ""},
                  .utc_us = {}})));
  put_samples(queue, 2, 3);
  CHECK(taken(queue) == Lines{"0", "1", kEvent, "board pico", "2"});
  CHECK(taken(queue).empty());
}

TEST_CASE("What is being recorded takes room until the next is asked for", "[recorder]") {
  RecordingQueue queue(3, WhenFull::kLose);
  put_samples(queue, 0, 3);
  CHECK(taken(queue) == Lines{"0", "1", "2"});
  put_samples(queue, 3, 5);
  CHECK(queue.lost() == 2);
  CHECK(taken(queue).empty());
  put_samples(queue, 5, 6);
  CHECK(taken(queue) == Lines{"# event = { kind = \"unrecorded\", samples = 2 }\n", "5"});
}

TEST_CASE("A full queue loses the samples that come, and says where and how many", "[recorder]") {
  RecordingQueue queue(2, WhenFull::kLose);
  put_samples(queue, 0, 5);
  CHECK(taken(queue) == Lines{"0", "1"});
  CHECK(taken(queue).empty());
  put_samples(queue, 5, 6);
  CHECK(taken(queue) == Lines{"# event = { kind = \"unrecorded\", samples = 3 }\n", "5"});
  CHECK(queue.lost() == 3);
}

TEST_CASE("A full queue takes events, each in its place among the losses", "[recorder]") {
  RecordingQueue queue(2, WhenFull::kLose);
  put_samples(queue, 0, 3);
  REQUIRE(queue.put(RecordingEvent{.kind = "trigger"}));
  put_samples(queue, 3, 5);
  queue.close();
  CHECK(taken(queue) == Lines{"0", "1", "# event = { kind = \"unrecorded\", samples = 1 }\n",
                              kEvent, "# event = { kind = \"unrecorded\", samples = 2 }\n"});
}

TEST_CASE("Events cannot fill the memory either", "[recorder]") {
  RecordingQueue queue(2, WhenFull::kLose);
  for (int i = 0; i < 1000; ++i) {
    REQUIRE(queue.put(RecordingEvent{.kind = "trigger"}));
  }
  queue.close();
  CHECK(taken(queue) == Lines{kEvent, kEvent, kEvent, kEvent,
                              "# event = { kind = \"unrecorded\", samples = 0, events = 996 }\n"});
}

TEST_CASE("take waits for an entry, but not beyond its moment", "[recorder]") {
  RecordingQueue queue(10, WhenFull::kLose);
  std::vector<RecordingEntry> entries;
  const auto moment = Clock::now() + 20ms;
  CHECK(queue.take(entries, moment));
  CHECK(entries.empty());
  CHECK(Clock::now() >= moment);
  std::thread other([&] {
    std::this_thread::sleep_for(10ms);
    [[maybe_unused]] const auto put = queue.put(rest_sample(0));
  });
  CHECK(queue.take(entries, Clock::now() + 60s));
  CHECK(entries.size() == 1);
  other.join();
}

TEST_CASE("A closed queue is emptied before it ends", "[recorder]") {
  RecordingQueue queue(10, WhenFull::kLose);
  put_samples(queue, 0, 1);
  queue.close();
  std::vector<RecordingEntry> entries;
  CHECK(queue.take(entries, Clock::now() + 60s));
  CHECK(entries.size() == 1);
  CHECK_FALSE(queue.take(entries, Clock::now() + 60s));
  CHECK(queue.wait_for_close(60000ms));
}

TEST_CASE("In a simulation a full queue waits until there is room, and loses nothing",
          "[recorder]") {
  RecordingQueue queue(4, WhenFull::kWait);
  bool all_put = true;
  std::thread simulation([&] {
    for (std::uint64_t seq = 0; seq < 1000; ++seq) {
      all_put = queue.put(rest_sample(seq)) && all_put;
    }
    queue.close();
  });
  Lines all;
  std::vector<RecordingEntry> entries;
  while (queue.take(entries, Clock::now() + 10ms)) {
    CHECK(entries.size() <= 4);
    for (const RecordingEntry& entry : entries) {
      all.push_back(shown(entry));
    }
  }
  simulation.join();
  CHECK(all_put);
  REQUIRE(all.size() == 1000);
  for (std::size_t i = 0; i < all.size(); ++i) {
    REQUIRE(all[i] == fmt::format("{}", i));
  }
  CHECK(queue.lost() == 0);
}

TEST_CASE("An abandoned queue frees who waits, with the reason", "[recorder]") {
  RecordingQueue queue(2, WhenFull::kWait);
  put_samples(queue, 0, 2);
  std::string reason;
  std::thread simulation([&] { reason = queue.put(rest_sample(2)).error().message; });
  std::this_thread::sleep_for(10ms);
  CHECK(queue.abandon({"the disk is gone"}) == 2);
  simulation.join();
  CHECK(reason == "the disk is gone");
  CHECK_FALSE(queue.put(rest_sample(3)));
}

}  // namespace
