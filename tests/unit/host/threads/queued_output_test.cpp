// SPDX-License-Identifier: Apache-2.0
// Tests of an output with a thread of its own: whoever hands on estimates never waits, and the
// thread ends, whatever the reader does.
#include "host/output/queued_output.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "host/output/line_writer.hpp"
#include "tests/unit/host/fifo.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;
using namespace std::chrono_literals;

using Clock = Output::Clock;

constexpr std::size_t kFewRows = 100;

/// CSV for a file, in a thread.
std::unique_ptr<QueuedOutput> lines_to(const std::string& path,
                                       std::size_t capacity = EstimateQueue::kCapacity) {
  return std::make_unique<QueuedOutput>(
      std::make_unique<LineWriter>(TextFile::create(path).value(), EstimateLayout{}, false),
      capacity);
}

/// Hands on rows with these numbers.
void take_rows(Output& output, std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t seq = from; seq < to; ++seq) {
    REQUIRE(output.take({.seq = seq}));
  }
}

/// The numbers of CSV rows; fails where a line is not whole.
std::vector<std::uint64_t> seqs_of(const std::string& text) {
  constexpr std::size_t kCommas = 12;
  std::vector<std::uint64_t> seqs;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    REQUIRE(end != std::string::npos);
    const std::string line = text.substr(begin, end - begin);
    REQUIRE(static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) == kCommas);
    if (!line.starts_with("t_s,")) {
      seqs.push_back(std::stoull(line.substr(line.find(',') + 1)));
    }
    begin = end + 1;
  }
  return seqs;
}

/// Reads until so many lines have come.
std::string read_lines(const Fifo& fifo, std::int64_t count) {
  std::string text;
  const auto deadline = Clock::now() + 30s;
  while (std::count(text.begin(), text.end(), '\n') < count && Clock::now() < deadline) {
    text += fifo.read();
    std::this_thread::sleep_for(1ms);
  }
  return text;
}

TEST_CASE("Rows arrive one by one, without waiting for more", "[threads]") {
  const Fifo fifo;
  const auto output = lines_to(fifo.path());
  CHECK(read_lines(fifo, 1).starts_with("t_s,seq,"));
  for (std::uint64_t seq = 0; seq < 5; ++seq) {
    take_rows(*output, seq, seq + 1);
    CHECK(seqs_of(read_lines(fifo, 1)) == std::vector<std::uint64_t>{seq});
  }
}

TEST_CASE("A reader that stalls costs rows, which are counted, and nobody waits for it",
          "[threads]") {
  constexpr std::uint64_t kRows = 1000;
  const Fifo fifo;
  const auto output = lines_to(fifo.path(), kFewRows);
  const auto start = Clock::now();
  take_rows(*output, 0, kRows);
  output->close(Clock::now() + 50ms);
  REQUIRE(output->finish());
  CHECK(Clock::now() - start < 30s);
  const auto seqs = seqs_of(fifo.read());
  CHECK_FALSE(seqs.empty());
  CHECK(seqs.size() + output->dropped() == kRows);
}

TEST_CASE("A reader that goes on reading finds whole lines and the newest rows", "[threads]") {
  constexpr std::uint64_t kRows = 1000;
  const Fifo fifo;
  const auto output = lines_to(fifo.path(), kFewRows);
  take_rows(*output, 0, kRows);
  // The newest of them wait in the queue.
  std::vector<std::uint64_t> seqs;
  while (seqs.empty() || seqs.back() + 1 < kRows) {
    const std::string text = read_lines(fifo, 1);
    REQUIRE_FALSE(text.empty());
    const auto more = seqs_of(text);
    seqs.insert(seqs.end(), more.begin(), more.end());
  }
  CHECK(std::is_sorted(seqs.begin(), seqs.end()));
  CHECK(seqs.size() >= kFewRows);
  output->close(Clock::now() + 30s);
  REQUIRE(output->finish());
  CHECK(seqs.size() + output->dropped() == kRows);
}

TEST_CASE("Rows that wait at the end are still written to a slow reader", "[threads]") {
  constexpr std::uint64_t kRows = 2000;  // several pipes full
  const Fifo fifo;
  const auto output = lines_to(fifo.path());
  take_rows(*output, 0, kRows);
  output->close(Clock::now() + 30s);
  auto text = std::async(std::launch::async, [&] { return read_lines(fifo, 1 + kRows); });
  REQUIRE(output->finish());
  CHECK(seqs_of(text.get()).size() == kRows);
  CHECK(output->dropped() == 0);
}

TEST_CASE("A file has all rows at the end", "[threads]") {
  const TemporaryFolder folder;
  const auto output = lines_to(folder.path("angles.csv"));
  take_rows(*output, 0, kFewRows);
  output->close(Clock::now() + 30s);
  REQUIRE(output->finish());
  CHECK(seqs_of(text_of(folder.path("angles.csv"))).size() == kFewRows);
  CHECK(output->dropped() == 0);
}

TEST_CASE("An output without rows has its head", "[threads]") {
  const TemporaryFolder folder;
  const auto output = lines_to(folder.path("angles.csv"));
  output->close(Clock::now() + 30s);
  REQUIRE(output->finish());
  CHECK(text_of(folder.path("angles.csv")).starts_with("t_s,seq,"));
}

/// Hands rows on until the output fails; what it says then.
std::string failure_of(Output& output) {
  const auto deadline = Clock::now() + 30s;
  while (Clock::now() < deadline) {
    if (const auto taken = output.take({}); !taken) {
      return taken.error().message;
    }
    std::this_thread::sleep_for(1ms);
  }
  return "nothing";
}

TEST_CASE("A reader that has gone ends the output, not the program", "[threads]") {
  Fifo fifo;
  const auto output = lines_to(fifo.path());
  take_rows(*output, 0, 1);
  CHECK_FALSE(read_lines(fifo, 2).empty());
  fifo.close_reader();
  CHECK(failure_of(*output) == fifo.path() + ": Broken pipe");
  output->close(Clock::now());
  CHECK_FALSE(output->finish());
}

TEST_CASE("Rows after a failure are counted as dropped", "[threads]") {
  const auto output = lines_to("/dev/full");
  CHECK(failure_of(*output) == "/dev/full: No space left on device");
  const std::uint64_t before = output->dropped();
  CHECK(before > 0);
  CHECK_FALSE(output->take({}));
  CHECK(output->dropped() == before + 1);
}

/// Does what a test says.
class ScriptedWriter final : public QueueWriter {
 public:
  explicit ScriptedWriter(std::function<void()> script) : script_(std::move(script)) {}

  [[nodiscard]] std::string name() const override { return "script"; }
  tl::expected<void, Error> run(EstimateQueue& /*queue*/) override {
    script_();
    return {};
  }

 private:
  std::function<void()> script_;
};

TEST_CASE("A writer that blocks for ever does not keep the program", "[threads]") {
  const auto released = std::make_shared<std::promise<void>>();
  const auto left = std::make_shared<std::promise<void>>();
  {
    QueuedOutput output(std::make_unique<ScriptedWriter>([released, left] {
      released->get_future().wait();
      left->set_value();
    }));
    take_rows(output, 0, 3);
    const auto start = Clock::now();
    output.close(start + 10ms);
    CHECK(output.finish());
    CHECK(Clock::now() - start < 30s);
    CHECK(output.dropped() == 3);
  }
  released->set_value();
  left->get_future().wait();
}

TEST_CASE("No signal of the session's goes to the thread", "[threads]") {
  sigset_t blocked;
  QueuedOutput output(
      std::make_unique<ScriptedWriter>([&] { pthread_sigmask(SIG_SETMASK, nullptr, &blocked); }));
  output.close(Clock::now() + 30s);
  REQUIRE(output.finish());
  CHECK(sigismember(&blocked, SIGINT) == 1);
  CHECK(sigismember(&blocked, SIGTERM) == 1);
  CHECK(sigismember(&blocked, SIGPIPE) == 1);
  sigset_t ours;
  pthread_sigmask(SIG_SETMASK, nullptr, &ours);
  CHECK(sigismember(&ours, SIGINT) == 0);
}

}  // namespace
