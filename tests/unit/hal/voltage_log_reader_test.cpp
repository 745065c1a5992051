// SPDX-License-Identifier: Apache-2.0
// Tests of foreign logs of voltages: layouts, times and rates, dropouts, missing volts.
#include "hal/replay/voltage_log_reader.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/unit/hal/recording_text.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

using Lines = std::vector<std::string>;

struct LogOut {
  Lines rows;  ///< "seq t_us on on", "-" for missing volts
  std::string error;
  Acquisition<double> acquisition;
  Lines complaints;
};

/// Reads a text as the log `log.csv` of the working directory.
LogOut read_log(const std::string& text, const std::string& columns,
                std::optional<double> rate_hz = {}) {
  const TemporaryFolder folder;
  auto layout = parse_log_layout(columns).value();
  layout.rate_hz = rate_hz;
  auto reader = VoltageLogReader::open(folder.write("log.csv", text), layout);
  if (!reader) {
    return {.rows = {},
            .error = folder.relative(reader.error().message),
            .acquisition = {},
            .complaints = {}};
  }
  LogOut out{.rows = {}, .error = "", .acquisition = reader->acquisition(), .complaints = {}};
  for (Sample sample;;) {
    const auto more = reader->read(sample);
    if (!more || !*more) {
      out.error = more ? "" : folder.relative(more.error().message);
      for (const std::string& complaint : reader->complaints()) {
        out.complaints.push_back(folder.relative(complaint));
      }
      return out;
    }
    std::string row = fmt::format("{} {}", sample.seq, sample.t_us);
    for (std::size_t i = 0; i < out.acquisition.sensor_count; ++i) {
      row += sample.has_reading(i) ? fmt::format(" {}", sample.readings[i].on) : " -";
    }
    out.rows.push_back(row);
  }
}

/// The `seq` of each row.
Lines seqs(const LogOut& out) {
  Lines numbers;
  for (const std::string& row : out.rows) {
    numbers.push_back(row.substr(0, row.find(' ')));
  }
  return numbers;
}

TEST_CASE("The paper's log of two voltages without times needs only a rate", "[import]") {
  const LogOut out = read_log("1.25,1.5\n1.26,1.49\n", "x,y", 20);
  CHECK(out.error.empty());
  CHECK(out.acquisition.rate_hz == 20);
  CHECK(out.acquisition.sensor_count == 2);
  CHECK(out.rows == Lines{"0 0 125000000 150000000", "1 50000 126000000 149000000"});
}

TEST_CASE("Imported counts mean the volts they came from", "[import]") {
  const LogOut out = read_log("1.25,1.5\n", "x,y", 20);
  CHECK(signal_v({.on = 125'000'000, .off = 0}, out.acquisition) == 1.25);
}

TEST_CASE("Times may be seconds, milliseconds or microseconds", "[import]") {
  const Lines rows = {"0 1500000 100000000 200000000", "1 1550000 100000000 200000000"};
  CHECK(read_log("1.5,1,2\n1.55,1,2\n", "t_s,x,y").rows == rows);
  CHECK(read_log("1500,1,2\n1550,1,2\n", "t_ms,x,y").rows == rows);
  CHECK(read_log("1500000,1,2\n1550000,1,2\n", "t_us,x,y").rows == rows);
}

TEST_CASE("The first two times give the rate", "[import]") {
  CHECK(read_log("0,1,2\n0.005,1,2\n0.01,1,2\n", "t_s,x,y").acquisition.rate_hz ==
        Approx(200).epsilon(1e-12));
}

TEST_CASE("A rate that is said goes before the times'", "[import]") {
  CHECK(read_log("0,1,2\n0.1,1,2\n", "t_s,x,y", 20).acquisition.rate_hz == 20);
}

TEST_CASE("A log with a rate may have one row", "[import]") {
  CHECK(read_log("1.5,1,2\n", "t_s,x,y", 20).rows == Lines{"0 1500000 100000000 200000000"});
}

TEST_CASE("Cells end with commas, semicolons or tabs, blanks around them", "[import]") {
  CHECK(read_log("0;1 ; 2\n0.05\t1\t2\r\n0.1, 1,2\n", "t_s,x,y").rows ==
        Lines{"0 0 100000000 200000000", "1 50000 100000000 200000000",
              "2 100000 100000000 200000000"});
}

TEST_CASE("A first line of names, comments and blank lines are skipped", "[import]") {
  CHECK(read_log("time,ch0,ch1\n# DAQ\n\n0,1,2\n  \n0.05,1,2\n", "t_s,x,y").rows ==
        Lines{"0 0 100000000 200000000", "1 50000 100000000 200000000"});
}

TEST_CASE("A first row that begins with missing volts is no line of names", "[import]") {
  CHECK(read_log(",1\n1,2\n", "x,y", 20).rows ==
        Lines{"0 0 - 100000000", "1 50000 100000000 200000000"});
}

TEST_CASE("A first row that begins with a skipped text is no line of names", "[import]") {
  CHECK(read_log("10:00:00,1,2\n10:00:01,1,2\n", "-,x,y", 20).rows.size() == 2);
}

TEST_CASE("Columns to skip may hold anything", "[import]") {
  CHECK(read_log("0,abc,1,2\n0.05,,3,4\n", "t_s,-,y,x").rows ==
        Lines{"0 0 200000000 100000000", "1 50000 400000000 300000000"});
}

TEST_CASE("Eight sensors fit a log", "[import]") {
  const LogOut out = read_log("1,2,3,4,5,6,7,8\n", "x,y,s3,s4,s5,s6,s7,s8", 20);
  CHECK(out.rows == Lines{"0 0 100000000 200000000 300000000 400000000 500000000 600000000 "
                          "700000000 800000000"});
}

TEST_CASE("Volts are rounded to 10 nV", "[import]") {
  CHECK(read_log("1.234567894,1.234567896\n", "x,y", 20).rows == Lines{"0 0 123456789 123456790"});
}

TEST_CASE("A line of names may follow comments", "[import]") {
  CHECK(read_log("# from the DAQ\nleft,right\n1,2\n", "x,y", 20).rows ==
        Lines{"0 0 100000000 200000000"});
}

TEST_CASE("A plus sign is part of a number", "[import]") {
  CHECK(read_log("+1,+2.5e-1\n", "x,y", 20).rows == Lines{"0 0 100000000 25000000"});
}

TEST_CASE("Volts may be negative or in exponent form", "[import]") {
  CHECK(read_log("-0.25,-1.5e-3\n", "x,y", 20).rows == Lines{"0 0 -25000000 -150000"});
}

TEST_CASE("Empty and NaN volts are missing readings", "[import]") {
  CHECK(read_log("1,\nNaN,2\n, nan\n", "x,y", 20).rows ==
        Lines{"0 0 100000000 -", "1 50000 - 200000000", "2 100000 - -"});
}

TEST_CASE("A last line without newline is used, and said", "[import]") {
  const LogOut out = read_log("1,2\n3,4", "x,y", 20);
  CHECK(out.rows == Lines{"0 0 100000000 200000000", "1 50000 300000000 400000000"});
  CHECK(out.complaints ==
        Lines{"log.csv:2: the last line ('3,4') does not end; its last number may be cut short"});
}

TEST_CASE("A log whose last line ends is not complained of", "[import]") {
  CHECK(read_log("1,2\n3,4\n", "x,y", 20).complaints.empty());
}

TEST_CASE("A jump of the time counts the samples that are lost", "[import]") {
  CHECK(seqs(read_log("0,1,2\n0.05,1,2\n0.3,1,2\n0.35,1,2\n", "t_s,x,y")) ==
        Lines{"0", "1", "6", "7"});
}

TEST_CASE("Jitter of a third of a period loses nothing", "[import]") {
  std::string text;
  for (int i = 0; i < 300; ++i) {
    const double jitter = i < 2 ? 0 : 0.3 * ((i * 37) % 21 - 10) / 10 / 2;
    text += fmt::format("{:.6f},1,2\n", 0.05 * (i + jitter));
  }
  CHECK(seqs(read_log(text, "t_s,x,y")).back() == "299");
}

TEST_CASE("A first period 10 % off loses nothing in the long run", "[import]") {
  const double first_s = GENERATE(0.045, 0.055);
  std::string text = "0,1,2\n";
  for (int i = 0; i < 1000; ++i) {
    text += fmt::format("{:.6f},1,2\n", first_s + 0.05 * i);
  }
  CHECK(seqs(read_log(text, "t_s,x,y")).back() == "1000");
}

TEST_CASE("A time that goes back is handed on with the next seq", "[import]") {
  // What follows judges it: out of order.
  CHECK(read_log("0,1,2\n0.05,1,2\n0.02,1,2\n0.07,1,2\n", "t_s,x,y").rows ==
        Lines{"0 0 100000000 200000000", "1 50000 100000000 200000000",
              "2 20000 100000000 200000000", "3 70000 100000000 200000000"});
}

TEST_CASE("Times before 0 are times, too", "[import]") {
  CHECK(read_log("-0.05,1,2\n0,1,2\n", "t_s,x,y").rows.front() == "0 -50000 100000000 200000000");
}

TEST_CASE("Progress of a log runs up to 1", "[import]") {
  const TemporaryFolder folder;
  auto layout = parse_log_layout("x,y").value();
  layout.rate_hz = 20;
  auto reader = VoltageLogReader::open(folder.write("log.csv", "1,2\n3,4\n"), layout);
  REQUIRE(reader);
  CHECK(reader->progress() == 0.5);
  Sample sample;
  while (reader->read(sample).value()) {
  }
  CHECK(reader->progress() == 1);
}

}  // namespace
