// SPDX-License-Identifier: Apache-2.0
// Tests of the queue of estimates: order, the bound, and what ends a wait.
#include "host/output/estimate_queue.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

namespace {

using namespace penduline;
using namespace std::chrono_literals;

using Clock = EstimateQueue::Clock;

constexpr int kNoFile = EstimateQueue::kNoFile;

StampedEstimate numbered(std::uint64_t seq) {
  return {.estimate = {.seq = seq}, .unix_s = 0};
}

std::vector<std::uint64_t> popped(EstimateQueue& queue) {
  std::vector<std::uint64_t> seqs;
  while (const auto next = queue.pop()) {
    seqs.push_back(next->estimate.seq);
  }
  return seqs;
}

TEST_CASE("Estimates come out in the order in which they went in", "[threads]") {
  EstimateQueue queue(3);
  queue.push(numbered(1));
  queue.push(numbered(2));
  CHECK(popped(queue) == std::vector<std::uint64_t>{1, 2});
}

TEST_CASE("A full queue loses its oldest", "[threads]") {
  EstimateQueue queue(3);
  for (std::uint64_t seq = 0; seq < 10; ++seq) {
    queue.push(numbered(seq));
  }
  CHECK(popped(queue) == std::vector<std::uint64_t>{7, 8, 9});
}

TEST_CASE("What was pushed and not written is counted, wherever it is", "[threads]") {
  EstimateQueue queue(3);
  for (std::uint64_t seq = 0; seq < 10; ++seq) {
    queue.push(numbered(seq));
  }
  CHECK(queue.unwritten() == 10);
  CHECK(popped(queue).size() == 3);
  CHECK(queue.unwritten() == 10);
  queue.count_written(2);
  CHECK(queue.unwritten() == 8);
}

TEST_CASE("An estimate ends the wait of an empty queue", "[threads]") {
  EstimateQueue queue;
  std::thread sampling([&] {
    std::this_thread::sleep_for(20ms);
    queue.push(numbered(1));
  });
  queue.wait(kNoFile, 0, 60s);
  CHECK(popped(queue).size() == 1);
  sampling.join();
}

TEST_CASE("Closing ends a wait, and what is there can still be popped", "[threads]") {
  EstimateQueue queue;
  queue.push(numbered(1));
  queue.wait(kNoFile, 0, 60s);  // the estimate's own
  std::thread sampling([&] {
    std::this_thread::sleep_for(20ms);
    queue.close(Clock::now() + 60s);
  });
  CHECK_FALSE(queue.closed());
  queue.wait(kNoFile, 0, 60s);
  CHECK(queue.closed());
  CHECK_FALSE(queue.expired());
  CHECK(popped(queue).size() == 1);
  sampling.join();
}

TEST_CASE("The deadline of a closed queue ends a wait", "[threads]") {
  EstimateQueue queue;
  queue.close(Clock::now() + 50ms);
  queue.wait(kNoFile, 0, 60s);
  const auto start = Clock::now();
  queue.wait(kNoFile, 0, 60s);
  CHECK(Clock::now() - start < 30s);
  CHECK(queue.expired());
}

TEST_CASE("A file that is ready ends a wait and is told", "[threads]") {
  std::array<int, 2> ends{};
  REQUIRE(::pipe(ends.data()) == 0);
  EstimateQueue queue;
  CHECK(queue.wait(ends[1], POLLOUT, 60s) == POLLOUT);
  CHECK(queue.wait(ends[0], POLLIN, 1ms) == 0);
  ::close(ends[1]);
  CHECK(queue.wait(ends[0], POLLIN, 60s) == POLLHUP);
  ::close(ends[0]);
}

TEST_CASE("Two threads lose nothing that the queue has room for", "[threads]") {
  constexpr std::uint64_t kCount = 2000;
  EstimateQueue queue(kCount);
  std::thread sampling([&] {
    for (std::uint64_t seq = 0; seq < kCount; ++seq) {
      queue.push(numbered(seq));
    }
    queue.close(Clock::now() + 60s);
  });
  std::uint64_t expected = 0;
  bool last = false;
  while (!last) {
    queue.wait(kNoFile, 0, 60s);
    last = queue.closed();
    for (const std::uint64_t seq : popped(queue)) {
      REQUIRE(seq == expected++);
      queue.count_written(1);
    }
  }
  sampling.join();
  CHECK(expected == kCount);
  CHECK(queue.unwritten() == 0);
}

}  // namespace
