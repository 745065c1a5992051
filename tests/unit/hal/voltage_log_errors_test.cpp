// SPDX-License-Identifier: Apache-2.0
// Tests of foreign logs and layouts that are wrong: each message in full.
#include <catch2/catch.hpp>
#include <optional>
#include <string>

#include "hal/replay/voltage_log_reader.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

std::string layout_error(const std::string& text) {
  const auto layout = parse_log_layout(text);
  return layout ? "" : layout.error().message;
}

/// The error of reading a log to its end, as the file `log.csv` of the working directory.
std::string log_error(const std::string& text, const std::string& columns,
                      std::optional<double> rate_hz = {}) {
  const TemporaryFolder folder;
  auto layout = parse_log_layout(columns).value();
  layout.rate_hz = rate_hz;
  auto reader = VoltageLogReader::open(folder.write("log.csv", text), layout);
  if (!reader) {
    return folder.relative(reader.error().message);
  }
  for (Sample sample;;) {
    const auto more = reader->read(sample);
    if (!more || !*more) {
      return more ? "" : folder.relative(more.error().message);
    }
  }
}

TEST_CASE("Layouts of two to eight sensors are good", "[import]") {
  const std::string layout =
      GENERATE("x,y", "t_s,x,y", "y,x,t_us", "x, y ,-,-", "-,t_ms,x,y,s3", "s3,y,x");
  CHECK(layout_error(layout).empty());
}

TEST_CASE("An unknown word in a layout is named", "[import]") {
  const std::string word = GENERATE("t", "z", "s2", "s9", "X", "x_on", "");
  CHECK(layout_error("x,y," + word) ==
        "found column '" + word + "', expected t_s, t_ms, t_us, x, y, s3 to s8, or -");
}

TEST_CASE("A sensor that stands twice in a layout is named", "[import]") {
  CHECK(layout_error("x,y,x") == "column 'x' stands there twice in 'x,y,x'");
}

TEST_CASE("A second time in a layout is named", "[import]") {
  CHECK(layout_error("t_s,x,y,t_ms") == "column 't_ms' stands there twice in 't_s,x,y,t_ms'");
}

TEST_CASE("A layout needs x and y and no gap after them", "[import]") {
  const std::string layout = GENERATE("x", "y,s3", "x,s3", "x,y,s4", "t_s,-");
  CHECK(layout_error(layout) ==
        "found the columns '" + layout + "', expected at least x and y, then s3, s4, ...");
}

TEST_CASE("A log without times and without a rate asks for one", "[import]") {
  CHECK(log_error("1,2\n3,4\n", "x,y") ==
        "log.csv: no column gives the time; say the rate with --rate");
}

TEST_CASE("A log of one row without a rate says what is missing", "[import]") {
  CHECK(log_error("0,1,2\n", "t_s,x,y") == "log.csv: found 1 rows of numbers, expected at least 2");
}

TEST_CASE("An empty log is no log", "[import]") {
  CHECK(log_error("", "x,y", 20) == "log.csv: found 0 rows of numbers, expected at least 1");
}

TEST_CASE("A log of names alone is no log", "[import]") {
  CHECK(log_error("x,y\n", "x,y", 20) == "log.csv: found 0 rows of numbers, expected at least 1");
}

TEST_CASE("Times that do not rise at the start give no rate", "[import]") {
  CHECK(log_error("0.05,1,2\n0.05,1,2\n", "t_s,x,y") ==
        "log.csv:2: the time went from 50000 us to 50000 us, expected it to rise");
  CHECK(log_error("0.05,1,2\n0,1,2\n", "t_s,x,y") ==
        "log.csv:2: the time went from 50000 us to 0 us, expected it to rise");
}

TEST_CASE("First times that no device has give no rate", "[import]") {
  CHECK(log_error("0,1,2\n0.5,1,2\n", "t_us,x,y") ==
        "log.csv:2: the first two rows are 0.5 us apart, expected a rate from 0.001 to 1000000 Hz");
  CHECK(log_error("0,1,2\n2000,1,2\n", "t_s,x,y") ==
        "log.csv:2: the first two rows are 2000000000 us apart, expected a rate from 0.001 to "
        "1000000 Hz");
}

TEST_CASE("First times that lie closer than a rate can say give no rate", "[import]") {
  // 1e6 / 1e-314 is infinite.
  CHECK_FALSE(log_error("0,1,2\n1e-320,1,2\n", "t_s,x,y").empty());
}

TEST_CASE("A first row of which one cell is wrong is no line of names", "[import]") {
  CHECK(log_error("1,err\n1,2\n", "x,y", 20) ==
        "log.csv:1: field 'y': found 'err', expected a number from -21 to 21");
}

TEST_CASE("Text among the volts is named", "[import]") {
  CHECK(log_error("1,2\n1,two\n", "x,y", 20) ==
        "log.csv:2: field 'y': found 'two', expected a number from -21 to 21");
}

TEST_CASE("A second line of names is named", "[import]") {
  CHECK(log_error("ch0,ch1\nVolts,Volts\n1,2\n", "x,y", 20) ==
        "log.csv:2: field 'x': found 'Volts', expected a number from -21 to 21");
}

TEST_CASE("Volts that the counts cannot hold are refused", "[import]") {
  CHECK(log_error("1,2\n22,2\n", "x,y", 20) ==
        "log.csv:2: field 'x': found '22', expected a number from -21 to 21");
  CHECK(log_error("1,2\n1,-22\n", "x,y", 20) ==
        "log.csv:2: field 'y': found '-22', expected a number from -21 to 21");
}

TEST_CASE("21 V are held", "[import]") {
  CHECK(log_error("21,-21\n", "x,y", 20).empty());
}

TEST_CASE("Infinite volts are refused", "[import]") {
  CHECK(log_error("1,inf\n", "x,y", 20) ==
        "log.csv:1: field 'y': found 'inf', expected a number from -21 to 21");
}

TEST_CASE("A missing time is named", "[import]") {
  CHECK(log_error("0,1,2\n0.05,1,2\n,1,2\n", "t_s,x,y") ==
        "log.csv:3: field 't_s': found '', expected a number from -1000000000 to 1000000000");
}

TEST_CASE("A row with too few or too many cells is counted", "[import]") {
  CHECK(log_error("1,2\n1\n", "x,y", 20) ==
        "log.csv:2: found 1 cells, expected 2 as --import says");
  CHECK(log_error("1,2\n1,2,3\n", "x,y", 20) ==
        "log.csv:2: found 3 cells, expected 2 as --import says");
}

TEST_CASE("A binary log is refused", "[import]") {
  CHECK(log_error(std::string("1,2\n\0\0", 6), "x,y", 20) ==
        "log.csv:2: found a NUL byte, expected text; is this the right file?");
}

TEST_CASE("A log that is not there is named", "[import]") {
  const TemporaryFolder folder;
  const auto reader =
      VoltageLogReader::open(folder.path("none.csv"), parse_log_layout("x,y").value());
  REQUIRE_FALSE(reader);
  CHECK(folder.relative(reader.error().message) == "none.csv: No such file or directory");
}

}  // namespace
