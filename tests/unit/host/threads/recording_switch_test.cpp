// SPDX-License-Identifier: Apache-2.0
// Tests of recordings that begin and end while samples come.
#include "host/recorder/recording_switch.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "hal/replay/recording_reader.hpp"
#include "tests/unit/host/headers.hpp"
#include "tests/unit/host/scripted_source.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

RecordingSwitch::Begin begin_in(const TemporaryFolder& folder) {
  return [&folder](const RecordingHeader& header, const RecordingSwitch::Warn& warn) {
    return Recorder::start({.series = {.path = folder.path("rec.csv"), .warn = warn}}, header);
  };
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_CASE("Samples are recorded between start and stop only", "[threads]") {
  const TemporaryFolder folder;
  RecordingSwitch recording(begin_in(folder));
  recording.join(header_of("pico", 20, 1));
  REQUIRE(recording.record(rest_sample(0)));
  REQUIRE(recording.start());
  CHECK(recording.state().name == folder.path("rec.csv"));
  REQUIRE(recording.record(rest_sample(1)));
  REQUIRE(recording.record(rest_sample(2)));
  CHECK(recording.state().samples == 2);
  const auto report = recording.stop();
  REQUIRE(report);
  CHECK(report->samples == 2);
  REQUIRE(recording.record(rest_sample(3)));
  CHECK_FALSE(recording.state().name);
  CHECK(recording.state().last == folder.path("rec.csv"));
  const std::string text = text_of(folder.path("rec.csv"));
  CHECK(text.find("\n1,50000,") != std::string::npos);
  CHECK(text.find("\n3,150000,") == std::string::npos);
}

TEST_CASE("No recording begins before there is a source", "[threads]") {
  const TemporaryFolder folder;
  RecordingSwitch recording(begin_in(folder));
  const auto started = recording.start();
  REQUIRE_FALSE(started);
  CHECK(started.error().message == "There are no samples yet: the board is not there.");
  recording.join(header_of("pico", 20, 1));
  CHECK(recording.start());
}

TEST_CASE("A second recording is another file", "[threads]") {
  const TemporaryFolder folder;
  RecordingSwitch recording(begin_in(folder));
  recording.join(header_of("pico", 20, 1));
  REQUIRE(recording.start());
  REQUIRE(recording.stop());
  REQUIRE(recording.start());
  CHECK(recording.state().name == folder.path("rec-0002.csv"));
}

TEST_CASE("Starting twice and stopping twice are refused in words", "[threads]") {
  const TemporaryFolder folder;
  RecordingSwitch recording(begin_in(folder));
  recording.join(header_of("pico", 20, 1));
  CHECK(recording.stop().error().message == "No recording is under way.");
  REQUIRE(recording.start());
  CHECK(folder.relative(recording.start().error().message)
            .starts_with("A recording is under way already"));
}

TEST_CASE("A recording that begins after a restart has the new start's header", "[threads]") {
  const TemporaryFolder folder;
  RecordingSwitch recording(begin_in(folder));
  recording.join(header_of("pico", 20, 1));
  const RecordingHeader again = header_of("pico", 20, 2);
  recording.note(boot_event(again, std::nullopt), again);
  REQUIRE(recording.start());
  REQUIRE(recording.stop());
  CHECK(text_of(folder.path("rec.csv")).find("# boot_id = 2\n") != std::string::npos);
}

TEST_CASE("Marks stand in the recording, in their place", "[threads]") {
  const TemporaryFolder folder;
  RecordingSwitch recording(begin_in(folder));
  recording.join(header_of("pico", 20, 1));
  REQUIRE(recording.start());
  REQUIRE(recording.record(rest_sample(1)));
  recording.note({.kind = "mark", .fields = {{"text", std::string("here")}}}, {});
  REQUIRE(recording.record(rest_sample(2)));
  REQUIRE(recording.stop());
  const std::string text = text_of(folder.path("rec.csv"));
  const auto mark = text.find("# event = { kind = \"mark\", text = \"here\" }");
  REQUIRE(mark != std::string::npos);
  CHECK(text.find("\n1,") < mark);
  CHECK(text.find("\n2,") > mark);
}

TEST_CASE("A recording's warnings go to who is told them now", "[threads]") {
  const TemporaryFolder folder;
  RecordingSwitch::Warn warn;
  RecordingSwitch recording([&](const RecordingHeader& header, const RecordingSwitch::Warn& given) {
    warn = given;
    return begin_in(folder)(header, given);
  });
  recording.join(header_of("pico", 20, 1));
  REQUIRE(recording.start());
  std::vector<std::string> told;
  warn("too early");
  recording.tell_warnings_to([&](const std::string& text) { told.push_back(text); });
  warn("the disk is full");
  recording.tell_warnings_to({});
  warn("too late");
  CHECK(told == std::vector<std::string>{"the disk is full"});
}

TEST_CASE("Another thread starts and stops while samples come: none is lost in between",
          "[threads]") {
  const TemporaryFolder folder;
  RecordingSwitch recording(begin_in(folder));
  recording.join(header_of("pico", 20, 1));
  std::atomic<bool> ended = false;
  std::thread sampling([&] {
    for (std::uint64_t seq = 0; !ended; ++seq) {
      static_cast<void>(recording.record(rest_sample(seq)));
      std::this_thread::sleep_for(std::chrono::microseconds(10));  // or a slow disk has no room
    }
  });
  for (int i = 0; i < 5; ++i) {
    REQUIRE(recording.start());
    while (recording.state().samples < 100) {
      std::this_thread::yield();
    }
    const auto report = recording.stop();
    REQUIRE(report);
    CHECK(report->lost == 0);
    CHECK(report->samples >= 100);
  }
  ended = true;
  sampling.join();
}

}  // namespace
