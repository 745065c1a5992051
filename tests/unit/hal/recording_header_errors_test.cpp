// SPDX-License-Identifier: Apache-2.0
// Tests of files that do not begin as a recording does: each message in full.
#include <catch2/catch.hpp>
#include <string>

#include "hal/replay/recording_format.hpp"
#include "tests/unit/hal/recording_text.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

/// design.md's header with one line replaced, and its columns.
std::string header_with(int line, const std::string& replacement) {
  std::string text = recording("");
  std::size_t begin = 0;
  for (int i = 1; i < line; ++i) {
    begin = text.find('\n', begin) + 1;
  }
  return text.replace(begin, text.find('\n', begin) + 1 - begin, replacement);
}

std::string columns_error(const std::string& columns) {
  return read_text(std::string(kDesignHeader) + columns + "\n").error;
}

TEST_CASE("An empty file is no recording", "[recording]") {
  CHECK(read_text("").error ==
        "rec.csv: the file is empty, expected a recording that begins with "
        "'# penduline_recording = 1'");
}

TEST_CASE("A file without a header is no recording", "[recording]") {
  CHECK(read_text("0.0,1.25,1.31\n0.05,1.26,1.30\n").error ==
        "rec.csv:1: found '0.0,1.25,1.31', expected a recording that begins with "
        "'# penduline_recording = 1' (plain logs of voltages are read with --import)");
}

TEST_CASE("A header without column names is told where it ends", "[recording]") {
  CHECK(read_text(std::string(kDesignHeader)).error ==
        "rec.csv: the file ends after line 7, in its header; expected the column names "
        "seq,t_us,...");
}

TEST_CASE("A header that is not TOML is told the line and why", "[recording]") {
  // The reason is toml++ 3.3's.
  CHECK(read_text(header_with(2, "# twenty samples a second\n")).error ==
        "rec.csv:2: the header is not TOML behind '# ': Error while parsing key-value pair: "
        "expected '=', saw 's'");
}

TEST_CASE("A header's own characters do not break a message's line", "[recording]") {
  // toml++ quotes the line's end.
  CHECK(read_text(header_with(2, "# rate_hz = f\n")).error ==
        "rec.csv:2: the header is not TOML behind '# ': Error while parsing boolean: expected "
        "'false', saw 'f?'");
}

TEST_CASE("A key that stands there twice is told with its second line", "[recording]") {
  CHECK(read_text(header_with(3, "# rate_hz = 50.0\n")).error ==
        "rec.csv:3: the header is not TOML behind '# ': Error while parsing key-value pair: "
        "cannot redefine existing floating-point 'rate_hz'");
}

TEST_CASE("A header without end is not read for ever", "[recording]") {
  std::string text;
  for (int i = 0; i < 1500; ++i) {
    text += "# # a note\n";
  }
  CHECK(read_text(text).error == "rec.csv:1000: the header has more than 1000 lines");
}

TEST_CASE("Each required key is missed", "[recording]") {
  CHECK(read_text(header_with(1, "")).error ==
        "rec.csv: header key 'penduline_recording': missing, expected 1");
  CHECK(read_text(header_with(2, "")).error ==
        "rec.csv: header key 'rate_hz': missing, expected a rate from 0.001 to 1000000");
  CHECK(read_text(header_with(3, "")).error ==
        "rec.csv: header key 'full_scale_counts': missing, expected the counts at full scale, "
        "a whole number such as 65535");
  CHECK(read_text(header_with(4, "")).error ==
        "rec.csv: header key 'reference_v': missing, expected a voltage from 1e-06 to 1000000");
}

TEST_CASE("The keys that the list calls optional may be missing, the others may not",
          "[recording]") {
  const std::string whole = recording_head({.acquisition = {},
                                            .board = "pico",
                                            .firmware = "0.1.0",
                                            .started = "2026-11-21T07:00:00Z",
                                            .serial = "e66058388340b32a",
                                            .boot_id = 7});
  for (const HeaderKeyDescription& key : kHeaderKeys) {
    std::string without = whole;
    const std::size_t begin = without.find("# " + std::string(key.key) + " = ");
    REQUIRE(begin != std::string::npos);
    without.erase(begin, without.find('\n', begin) + 1 - begin);
    CAPTURE(without);
    CHECK(read_text(without).error.empty() == !key.required);
  }
}

TEST_CASE("A value of the wrong type is shown with its line", "[recording]") {
  CHECK(read_text(header_with(2, "# rate_hz = \"fast\"\n")).error ==
        "rec.csv:2: header key 'rate_hz': found 'fast', expected a rate from 0.001 to 1000000");
  CHECK(read_text(header_with(4, "# reference_v = [3.5]\n")).error ==
        "rec.csv:4: header key 'reference_v': found [ 3.5 ], expected a voltage from 1e-06 to "
        "1000000");
}

TEST_CASE("Another version of the format is refused", "[recording]") {
  CHECK(read_text(header_with(1, "# penduline_recording = 2\n")).error ==
        "rec.csv:1: header key 'penduline_recording': found 2, expected 1");
}

TEST_CASE("A version that is no number is refused", "[recording]") {
  CHECK(read_text(header_with(1, "# penduline_recording = true\n")).error ==
        "rec.csv:1: header key 'penduline_recording': found true, expected 1");
}

TEST_CASE("A rate that is not above 0, or that no clock keeps, is refused", "[recording]") {
  // The period of the last two would be none, or beyond 64 bits of microseconds.
  const std::string rate = GENERATE("-20.5", "0", "nan", "inf", "1e+300", "1e-300");
  CHECK(read_text(header_with(2, "# rate_hz = " + rate + "\n")).error ==
        "rec.csv:2: header key 'rate_hz': found " + rate +
            ", expected a rate from 0.001 to 1000000");
}

TEST_CASE("A header's number is shown as the file has it", "[recording]") {
  // Not as -3.2999999999999998.
  CHECK(
      read_text(header_with(4, "# reference_v = -3.3\n")).error ==
      "rec.csv:4: header key 'reference_v': found -3.3, expected a voltage from 1e-06 to 1000000");
}

TEST_CASE("Full-scale counts are whole and fit 32 bits", "[recording]") {
  const std::string counts = GENERATE("2147483648", "0", "0.5", "65535.5", "-65535");
  CHECK(read_text(header_with(3, "# full_scale_counts = " + counts + "\n")).error ==
        "rec.csv:3: header key 'full_scale_counts': found " + counts +
            ", expected the counts at full scale, a whole number such as 65535");
}

TEST_CASE("A reference of no volts is refused", "[recording]") {
  CHECK(read_text(header_with(4, "# reference_v = 0\n")).error ==
        "rec.csv:4: header key 'reference_v': found 0, expected a voltage from 1e-06 to 1000000");
}

TEST_CASE("A missing column is named", "[recording]") {
  CHECK(columns_error("seq,t_us,x_on,x_off,y_on,flags") ==
        "rec.csv:8: column 'y_off' is missing, expected seq,t_us,x_on,x_off,y_on,y_off,flags; "
        "found 'seq,t_us,x_on,x_off,y_on,flags'");
}

TEST_CASE("A column that stands there twice is named", "[recording]") {
  CHECK(columns_error("seq,t_us,x_on,x_off,y_on,y_off,flags,x_on") ==
        "rec.csv:8: column 'x_on' stands there twice, expected "
        "seq,t_us,x_on,x_off,y_on,y_off,flags; found 'seq,t_us,x_on,x_off,y_on,y_off,flags,x_on'");
}

TEST_CASE("Half a third sensor is missed", "[recording]") {
  CHECK(columns_error("seq,t_us,x_on,x_off,y_on,y_off,s3_on,flags") ==
        "rec.csv:8: column 's3_off' is missing, expected "
        "seq,t_us,x_on,x_off,y_on,y_off,s3_on,s3_off,flags; found "
        "'seq,t_us,x_on,x_off,y_on,y_off,s3_on,flags'");
}

TEST_CASE("One sensor is too few", "[recording]") {
  CHECK(columns_error("seq,t_us,x_on,x_off,flags") ==
        "rec.csv:8: column 'y_on' is missing, expected seq,t_us,x_on,x_off,y_on,y_off,flags; "
        "found 'seq,t_us,x_on,x_off,flags'");
}

TEST_CASE("A row where the column names belong is shown", "[recording]") {
  CHECK(columns_error("0,50000,23411,102,22876,99,0") ==
        "rec.csv:8: column 'seq' is missing, expected seq,t_us,x_on,x_off,y_on,y_off,flags; "
        "found '0,50000,23411,102,22876,99,0'");
}

}  // namespace
