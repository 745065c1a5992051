// SPDX-License-Identifier: Apache-2.0
// Tests of the recorder: it never holds up the sampling, and full and slow disks cost what they
// must.
#include "host/recorder/recorder.hpp"

#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hal/replay/recording_reader.hpp"
#include "tests/unit/hal/recording_text.hpp"
#include "tests/unit/host/scripted_source.hpp"
#include "tests/unit/host/slow_disk.hpp"
#include "tests/unit/host/small_disk.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;
using namespace std::chrono_literals;

using Clock = std::chrono::steady_clock;
using Lines = std::vector<std::string>;
using WhenFull = RecordingQueue::WhenFull;

/// A folder to record in, and what the recorder said, from whichever thread.
class Place {
 public:
  [[nodiscard]] RecorderSettings settings(std::size_t entries = 100'000) {
    return {.series = {.path = path(),
                       .warn =
                           [this](const std::string& text) {
                             const std::lock_guard lock(mutex_);
                             said_.push_back(folder_.relative(text));
                           }},
            .queue_bytes = entries * sizeof(RecordingEntry),
            .retry_period = 5ms};
  }
  [[nodiscard]] std::string path() const { return folder_.path("rec.csv"); }
  [[nodiscard]] Lines said() {
    const std::lock_guard lock(mutex_);
    return said_;
  }
  /// Waits until so much was said.
  void wait_until_said(std::size_t count) {
    wait_until([&] { return said().size() >= count; });
  }
  static void wait_until(const std::function<bool()>& done) {
    for (const auto patience = Clock::now() + 60s; !done();) {
      REQUIRE(Clock::now() < patience);
      std::this_thread::sleep_for(1ms);
    }
  }
  [[nodiscard]] std::vector<std::uint64_t> seqs() const {
    auto reader = RecordingReader::open(path()).value();
    std::vector<std::uint64_t> seqs;
    for (Sample sample; reader.read(sample).value();) {
      seqs.push_back(sample.seq);
    }
    return seqs;
  }

 private:
  TemporaryFolder folder_;
  std::mutex mutex_;
  Lines said_;
};

std::unique_ptr<Recorder> started(RecorderSettings settings) {
  return Recorder::start(std::move(settings), RecordingHeader{}).value();
}

void record(Recorder& recorder, std::uint64_t begin, std::uint64_t end) {
  for (std::uint64_t seq = begin; seq < end; ++seq) {
    REQUIRE(recorder.record(rest_sample(seq)));
  }
}

/// The numbers from `begin` up to and without `end`.
std::vector<std::uint64_t> numbers(std::uint64_t begin, std::uint64_t end) {
  std::vector<std::uint64_t> all;
  for (std::uint64_t seq = begin; seq < end; ++seq) {
    all.push_back(seq);
  }
  return all;
}

TEST_CASE("A recording has its whole head before the first sample", "[recorder]") {
  Place place;
  const auto recorder = started(place.settings());
  CHECK(text_of(place.path()) == recording_head(RecordingHeader{}));
}

TEST_CASE("All samples and events are recorded, in order", "[recorder]") {
  Place place;
  auto recorder = started(place.settings());
  REQUIRE(recorder->record(rest_sample(0)));
  REQUIRE(recorder->record(RecordingEvent{.kind = "trigger"}));
  REQUIRE(recorder->record(rest_sample(1)));
  const RecorderReport& report = recorder->finish();
  CHECK(report.samples == 2);
  CHECK(report.lost == 0);
  CHECK_FALSE(report.error);
  CHECK(text_of(place.path()) == recording_head(RecordingHeader{}) +
                                     "0,0,33099,0,33099,0,0\n"
                                     "# event = { kind = \"trigger\" }\n"
                                     "1,50000,33099,0,33099,0,0\n");
  CHECK(place.said().empty());
}

TEST_CASE("A sample is in the file a moment after it was measured", "[recorder]") {
  Place place;
  const auto recorder = started(place.settings());
  for (std::uint64_t seq = 0; seq < 5; ++seq) {
    REQUIRE(recorder->record(rest_sample(seq)));
    Place::wait_until([&] { return place.seqs() == numbers(0, seq + 1); });
  }
}

TEST_CASE("A recorder that is finished twice, or not at all, has recorded", "[recorder]") {
  Place place;
  {
    auto recorder = started(place.settings());
    record(*recorder, 0, 10);
    recorder->finish();
    CHECK(recorder->finish().samples == 10);
  }
  CHECK(place.seqs().size() == 10);
  Place other;
  record(*started(other.settings()), 0, 10);
  CHECK(other.seqs().size() == 10);
}

TEST_CASE("A disk that is full for a while costs no sample, and is told once", "[recorder]") {
  Place place;
  auto recorder = started(place.settings());
  {
    const SmallDisk disk(4000);
    record(*recorder, 0, 10'000);
    place.wait_until_said(1);
    std::this_thread::sleep_for(50ms);
    record(*recorder, 10'000, 10'010);
    // Half a line is there for the moment between a try and its taking back.
    Place::wait_until([&] { return text_of(place.path()).ends_with('\n'); });
    CHECK(place.said() ==
          Lines{"rec.csv: File too large; sampling goes on, and recording will when it can"});
  }
  place.wait_until_said(2);
  record(*recorder, 10'010, 10'020);
  CHECK(recorder->finish().lost == 0);
  CHECK(recorder->finish().text() == "recorded 10020 samples in " + place.path());
  CHECK((place.seqs() == numbers(0, 10'020)));
  CHECK(place.said().back() == "rec.csv: recording goes on; 0 samples are missing in it");
}

TEST_CASE("Samples that found no room are counted, and marked in their place", "[recorder]") {
  Place place;
  auto recorder = started(place.settings(100));
  {
    const SmallDisk disk(200);
    record(*recorder, 0, 10);
    place.wait_until_said(1);
    record(*recorder, 10, 1000);
    place.wait_until_said(2);
  }
  place.wait_until_said(3);
  record(*recorder, 1000, 1005);
  const RecorderReport& report = recorder->finish();
  const auto seqs = place.seqs();
  REQUIRE(report.lost > 800);
  CHECK(report.samples + report.lost == 1005);
  CHECK(seqs.size() == report.samples);
  // What was recorded before the loss, and after it.
  const std::uint64_t kept = 1000 - report.lost;
  CHECK(seqs[kept - 1] == kept - 1);
  CHECK(seqs[kept] == 1000);
  CHECK(text_of(place.path())
            .find(fmt::format("# event = {{ kind = \"unrecorded\", samples = {} }}\n1000,",
                              report.lost)) != std::string::npos);
  CHECK(place.said()[1] ==
        "rec.csv: the disk is too slow, and the memory for what waits is full: samples are lost to "
        "the recording; further ones are counted");
  CHECK(place.said()[2] ==
        fmt::format("rec.csv: recording goes on; {} samples are missing in it", report.lost));
  CHECK(report.text() == fmt::format("recorded {} samples in {}, lost {}", report.samples,
                                     place.path(), report.lost));
}

TEST_CASE("A disk that is full at the end gets one more try, then what waits is lost",
          "[recorder]") {
  Place place;
  auto recorder = started(place.settings());
  const SmallDisk disk(1000);
  record(*recorder, 0, 1000);
  const RecorderReport& report = recorder->finish();
  CHECK(report.samples == place.seqs().size());
  CHECK(report.samples > 10);
  CHECK(report.samples + report.lost == 1000);
  REQUIRE(report.error);
  CHECK(report.error->message.ends_with("rec.csv: File too large"));
}

TEST_CASE("A full disk ends a simulation that records", "[recorder]") {
  Place place;
  RecorderSettings settings = place.settings(100);
  settings.when_full = WhenFull::kWait;
  auto recorder = started(settings);
  const SmallDisk disk(1000);
  std::string error;
  for (std::uint64_t seq = 0; error.empty(); ++seq) {
    REQUIRE(seq < 10'000);
    if (const auto recorded = recorder->record(rest_sample(seq)); !recorded) {
      error = recorded.error().message;
    }
  }
  CHECK(error.ends_with("rec.csv: File too large"));
  CHECK(recorder->finish().error->message == error);
  CHECK(place.said().empty());
}

TEST_CASE("A simulation waits for the disk and loses nothing", "[recorder]") {
  Place place;
  RecorderSettings settings = place.settings(50);
  settings.when_full = WhenFull::kWait;
  auto recorder = started(settings);
  record(*recorder, 0, 20'000);
  CHECK(recorder->finish().samples == 20'000);
  CHECK((place.seqs() == numbers(0, 20'000)));
}

/// A disk that hangs from now on, for as long as this lives.
class HangingDisk {
 public:
  HangingDisk() { SlowDisk::the_one().hangs = true; }
  HangingDisk(const HangingDisk&) = delete;
  HangingDisk& operator=(const HangingDisk&) = delete;
  ~HangingDisk() { SlowDisk::the_one().hangs = false; }
};

TEST_CASE("A disk that hangs holds up no sample", "[recorder]") {
  Place place;
  RecorderSettings settings = place.settings();
  settings.sync_period = 1ms;
  auto recorder = started(settings);
  {
    const HangingDisk disk;
    const int before = SlowDisk::the_one().syncs;
    record(*recorder, 0, 1);
    Place::wait_until([&] { return SlowDisk::the_one().syncs > before; });
    // The disk hangs now, and every one of these returns.
    record(*recorder, 1, 50'000);
    CHECK(place.seqs().size() == 1);
  }
  CHECK(recorder->finish().lost == 0);
  CHECK(place.seqs().size() == 50'000);
}

TEST_CASE("A disk that hangs too long costs samples, which are counted and told once",
          "[recorder]") {
  Place place;
  RecorderSettings settings = place.settings(100);
  settings.sync_period = 1ms;
  auto recorder = started(settings);
  {
    const HangingDisk disk;
    const int before = SlowDisk::the_one().syncs;
    record(*recorder, 0, 1);
    Place::wait_until([&] { return SlowDisk::the_one().syncs > before; });
    record(*recorder, 1, 1000);
  }
  const RecorderReport& report = recorder->finish();
  // What was being brought to the disk may or may not count as waiting.
  CHECK(report.lost >= 899);
  CHECK(report.lost <= 900);
  CHECK(report.samples + report.lost == 1000);
  CHECK(place.said().size() == 1);
}

TEST_CASE("With a sync period the disk is asked that often, and at the end", "[recorder]") {
  Place place;
  RecorderSettings settings = place.settings();
  settings.sync_period = 30ms;
  const int before = SlowDisk::the_one().syncs;
  auto recorder = started(settings);
  const auto start = Clock::now();
  std::uint64_t seq = 0;
  Place::wait_until([&] {
    REQUIRE(recorder->record(rest_sample(seq++)));
    return SlowDisk::the_one().syncs == before + 3;
  });
  CHECK(Clock::now() - start >= 90ms);
  REQUIRE(recorder->record(rest_sample(seq++)));
  recorder->finish();
  CHECK(SlowDisk::the_one().syncs == before + 4);
}

TEST_CASE("While nothing comes the disk is left alone", "[recorder]") {
  Place place;
  RecorderSettings settings = place.settings();
  settings.sync_period = 1ms;
  auto recorder = started(settings);
  const int before = SlowDisk::the_one().syncs;
  record(*recorder, 0, 1);
  Place::wait_until([&] { return SlowDisk::the_one().syncs > before; });
  std::this_thread::sleep_for(50ms);
  CHECK(SlowDisk::the_one().syncs == before + 1);
}

TEST_CASE("Without a sync period the disk is never asked", "[recorder]") {
  Place place;
  const int before = SlowDisk::the_one().syncs;
  auto recorder = started(place.settings());
  record(*recorder, 0, 1000);
  recorder->finish();
  CHECK(SlowDisk::the_one().syncs == before);
}

TEST_CASE("A disk that cannot keep what it took is told once", "[recorder]") {
  Place place;
  RecorderSettings settings = place.settings();
  settings.sync_period = 1ms;
  auto recorder = started(settings);
  SlowDisk::the_one().fails = true;
  const int before = SlowDisk::the_one().syncs;
  std::uint64_t seq = 0;
  Place::wait_until([&] {
    REQUIRE(recorder->record(rest_sample(seq++)));
    return SlowDisk::the_one().syncs >= before + 3;
  });
  CHECK(recorder->finish().lost == 0);
  SlowDisk::the_one().fails = false;
  CHECK(place.said() == Lines{"rec.csv: fsync: Input/output error; what was recorded last may not "
                              "be on the disk"});
}

TEST_CASE("Signals go to the session's thread, not to the recorder's", "[recorder]") {
  Place place;
  const auto recorder = started(place.settings());
  // Of all threads of this process only one may be interrupted by SIGINT; Linux tells by file.
  int open_to_signal = 0;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream status(thread.path() / "status");
    for (std::string line; std::getline(status, line);) {
      if (line.starts_with("SigBlk:")) {
        const auto blocked = std::stoull(line.substr(7), nullptr, 16);
        open_to_signal += (blocked >> (SIGINT - 1) & 1U) == 0 ? 1 : 0;
      }
    }
  }
  CHECK(open_to_signal == 1);
}

TEST_CASE("A recording that cannot begin says why", "[recorder]") {
  Place place;
  RecorderSettings settings = place.settings();
  settings.series.path = "/dev/full";
  const auto recorder = Recorder::start(settings, RecordingHeader{});
  REQUIRE_FALSE(recorder);
  CHECK(recorder.error().message == "/dev/full: No space left on device");
}

TEST_CASE("A board that starts anew midway is in the recording as it was live", "[recorder]") {
  Place place;
  RecordingHeader header;
  header.boot_id = 7;
  auto recorder = Recorder::start(place.settings(), header).value();
  record(*recorder, 100, 102);
  header.boot_id = 8;
  REQUIRE(recorder->go_on_with(header, std::nullopt));
  record(*recorder, 0, 2);
  recorder->finish();
  const ReadOut out = read_out(place.path());
  CHECK(out.rows == Lines{"100 5000000 33099/0 33099/0 0", "101 5050000 33099/0 33099/0 0",
                          "0 0 33099/0 33099/0 4", "1 50000 33099/0 33099/0 0"});
  REQUIRE(out.events.size() == 1);
  CHECK(out.events[0].starts_with("0: # event = { kind = \"boot\", board = "));
}

}  // namespace
