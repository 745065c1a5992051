// SPDX-License-Identifier: Apache-2.0
// Tests of the writer of recordings: design.md's text, one list of keys and columns, round trips.
#include "hal/replay/recording_format.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tests/unit/hal/recording_text.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

/// The header of design.md's example.
RecordingHeader design_header() {
  return {.acquisition = {.rate_hz = 20,
                          .full_scale_counts = 65535,
                          .reference_v = 3.3,
                          .sensor_count = 2},
          .board = "pico",
          .firmware = "0.1.0",
          .started = "2026-11-21T07:00:00Z"};
}

std::string row_of(const Sample& sample, std::size_t sensor_count) {
  std::string text;
  append_recording_row(text, sample, sensor_count);
  return text;
}

/// Samples whose every field differs, with readings missing here and there.
std::vector<Sample> various_samples(std::size_t sensor_count) {
  std::vector<Sample> samples;
  for (std::uint64_t seq = 0; seq < 40; ++seq) {
    Sample sample{.seq = seq, .t_us = static_cast<std::int64_t>(seq * 50'000 + 25'000)};
    for (std::size_t i = 0; i < sensor_count; ++i) {
      if ((seq + i) % 5 == 0) {
        sample.missing |= 1U << i;
      } else {
        const auto base = static_cast<std::int32_t>(1000 * seq + 10 * i);
        sample.readings[i] = {.on = base + 1, .off = base + 2};
      }
    }
    sample.flags = seq == 0 ? flag::kRestarted : seq % 7 == 0 ? flag::kSaturated : 0;
    samples.push_back(sample);
  }
  return samples;
}

TEST_CASE("The head of a recording is design.md's example", "[recording]") {
  CHECK(recording_head(design_header()) ==
        std::string(kDesignHeader) + std::string(kDesignColumns));
}

TEST_CASE("A row of a recording is design.md's example", "[recording]") {
  Sample sample{.seq = 0, .t_us = 50'000};
  sample.readings[0] = {.on = 23411, .off = 102};
  sample.readings[1] = {.on = 22876, .off = 99};
  CHECK(row_of(sample, 2) == "0,50000,23411,102,22876,99,0\n");
}

TEST_CASE("The head has every key of the one list, in its order", "[recording]") {
  RecordingHeader header = design_header();
  header.serial = "e66058388340b32a";
  header.boot_id = 7;
  const std::string head = recording_head(header);
  std::size_t at = 0;
  for (const HeaderKeyDescription& key : kHeaderKeys) {
    const std::string line = "# " + std::string(key.key) + " = ";
    CAPTURE(line);
    REQUIRE(head.compare(at, line.size(), line) == 0);
    at = head.find('\n', at) + 1;
  }
  CHECK(head.substr(at) == kDesignColumns);
}

TEST_CASE("Header keys that nobody knows a value for are left out", "[recording]") {
  RecordingHeader header = design_header();
  header.board = header.firmware = header.started = "";
  CHECK(recording_head(header) ==
        "# penduline_recording = 1\n"
        "# rate_hz = 20.0\n"
        "# full_scale_counts = 65535\n"
        "# reference_v = 3.3\n"
        "seq,t_us,x_on,x_off,y_on,y_off,flags\n");
}

TEST_CASE("A third sensor's columns stand before the flags", "[recording]") {
  CHECK(recording_column_names(3) == "seq,t_us,x_on,x_off,y_on,y_off,s3_on,s3_off,flags");
}

TEST_CASE("Eight sensors have columns up to s8", "[recording]") {
  CHECK(recording_column_names(8) ==
        "seq,t_us,x_on,x_off,y_on,y_off,s3_on,s3_off,s4_on,s4_off,s5_on,s5_off,s6_on,s6_off,"
        "s7_on,s7_off,s8_on,s8_off,flags");
}

TEST_CASE("The text of the column names is the list of columns", "[recording]") {
  for (const std::size_t sensor_count : {2U, 3U, 8U}) {
    std::string joined;
    for (const Column& column : recording_columns(sensor_count)) {
      joined += (joined.empty() ? "" : ",") + column.name;
    }
    CHECK(recording_column_names(sensor_count) == joined);
  }
}

TEST_CASE("A missing reading is two empty cells", "[recording]") {
  Sample sample{.seq = 7, .t_us = 8, .missing = 0b001};
  sample.readings[1] = {.on = 3, .off = 4};
  sample.readings[2] = {.on = 5, .off = 6};
  CHECK(row_of(sample, 3) == "7,8,,,3,4,5,6,0\n");
}

TEST_CASE("The largest values a sample can have are written in full", "[recording]") {
  Sample sample{.seq = std::numeric_limits<std::uint64_t>::max(),
                .t_us = std::numeric_limits<std::int64_t>::max(),
                .flags = std::numeric_limits<Flags>::max()};
  sample.readings[0] = {.on = std::numeric_limits<std::int32_t>::max(), .off = 0};
  CHECK(row_of(sample, 2) ==
        "18446744073709551615,9223372036854775807,2147483647,0,0,0,4294967295\n");
}

TEST_CASE("Samples come back from a recording as they went in", "[recording]") {
  const std::size_t sensor_count = GENERATE(2U, 3U, 8U);
  RecordingHeader header = design_header();
  header.acquisition.sensor_count = sensor_count;
  std::string text = recording_head(header);
  std::vector<std::string> rows;
  for (const Sample& sample : various_samples(sensor_count)) {
    append_recording_row(text, sample, sensor_count);
    rows.push_back(shown(sample, sensor_count));
  }
  const ReadOut out = read_text(text);
  CHECK(out.error.empty());
  CHECK(out.complaints.empty());
  CHECK(out.header.acquisition.sensor_count == sensor_count);
  CHECK(out.rows == rows);
}

TEST_CASE("The acquisition comes back from a recording to the last bit", "[recording]") {
  const double value = GENERATE(20.0, 0.1, 100.0 / 3, 999.0, 1e-2);
  RecordingHeader header = design_header();
  header.acquisition.rate_hz = value * 100;
  header.acquisition.reference_v = value / 7;
  header.acquisition.full_scale_counts = 4095;
  const Acquisition<double> read = read_text(recording_head(header)).header.acquisition;
  CHECK(read.rate_hz == value * 100);
  CHECK(read.reference_v == value / 7);
  CHECK(read.full_scale_counts == 4095);
}

TEST_CASE("Whatever a board calls itself comes back from a recording", "[recording]") {
  const std::string name =
      GENERATE(as<std::string>{}, "pico", "with \"quotes\"", "it's", "back\\slash", "two\nlines",
               "a\r\nb", "tab\there", "# sharp", "\x1b[31mred", "del\x7f", "M\xc3\xbcnchen",
               "pico\xf0\x9f\x98\x80", "'''", "\"\"\"", "a\n'''b\\\"\"\"");
  RecordingHeader header = design_header();
  header.board = header.firmware = name;
  const ReadOut out = read_text(recording_head(header));
  CHECK(out.error.empty());
  CHECK(out.header.board == name);
  CHECK(out.header.firmware == name);
}

TEST_CASE("The board's number and its start come back from a recording", "[recording]") {
  RecordingHeader header = design_header();
  header.serial = "e66058388340b32a";
  header.boot_id = 4294967295;
  const ReadOut out = read_text(recording_head(header));
  CHECK(out.header.serial == "e66058388340b32a");
  CHECK(out.header.boot_id == 4294967295);
}

TEST_CASE("The start time comes back from a recording", "[recording]") {
  CHECK(read_text(recording_head(design_header())).header.started == "2026-11-21T07:00:00Z");
}

}  // namespace
