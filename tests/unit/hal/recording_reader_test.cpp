// SPDX-License-Identifier: Apache-2.0
// Tests of reading recordings that are good, or good enough: all their samples arrive.
#include "hal/replay/recording_reader.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/hal/recording_text.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

using Lines = std::vector<std::string>;

/// The rows of a recording that must have nothing wrong with it.
Lines good_rows(const std::string& text) {
  const ReadOut out = read_text(text);
  CHECK(out.error.empty());
  CHECK(out.complaints.empty());
  return out.rows;
}

TEST_CASE("design.md's example reads as it says", "[recording]") {
  const ReadOut out = read_text(recording("0,50000,23411,102,22876,99,0\n"));
  CHECK(out.error.empty());
  CHECK(out.header.acquisition.rate_hz == 20);
  CHECK(out.header.acquisition.full_scale_counts == 65535);
  CHECK(out.header.acquisition.reference_v == 3.3);
  CHECK(out.header.acquisition.sensor_count == 2);
  CHECK(out.header.board == "pico");
  CHECK(out.header.firmware == "0.1.0");
  CHECK(out.header.started == "2026-11-21T07:00:00Z");
  CHECK(out.rows == Lines{"0 50000 23411/102 22876/99 0"});
}

TEST_CASE("Columns without a row are a recording of no samples", "[recording]") {
  CHECK(good_rows(recording("")).empty());
}

TEST_CASE("Unknown header keys, tables and comments are ignored", "[recording]") {
  CHECK(good_rows("# penduline_recording = 1\n# mood = \"fine\"\n## a note\n# rate_hz = 20 # so\n"
                  "# full_scale_counts = 65535\n# reference_v = 3.3\n# [site]\n# x_m = [1, 2]\n" +
                  std::string(kDesignColumns) + "0,1,2,3,4,5,6\n") == Lines{"0 1 2/3 4/5 6"});
}

TEST_CASE("Extra columns are skipped, whatever stands in them", "[recording]") {
  CHECK(good_rows(std::string(kDesignHeader) +
                  "note,seq,t_us,x_on,x_off,,y_on,y_off,flags,host_time\n"
                  "first,0,1,2,3,,4,5,6,2026-11-21T07:00:00Z\n"
                  ",1,2,3,4,nan,5,6,7,\n") == Lines{"0 1 2/3 4/5 6", "1 2 3/4 5/6 7"});
}

TEST_CASE("Blank lines are skipped in the header and after it", "[recording]") {
  CHECK(good_rows("\n" + std::string(kDesignHeader) + "\n\n" + std::string(kDesignColumns) +
                  "0,1,2,3,4,5,6\n") == Lines{"0 1 2/3 4/5 6"});
}

TEST_CASE("The columns may stand in any order", "[recording]") {
  CHECK(good_rows(std::string(kDesignHeader) +
                  "flags,y_off,y_on,s3_on,s3_off,x_off,x_on,t_us,seq\n6,5,4,7,8,3,2,1,0\n") ==
        Lines{"0 1 2/3 4/5 7/8 6"});
}

TEST_CASE("Lines may end with CR LF", "[recording]") {
  std::string text = recording("0,1,2,3,4,5,6\n1,2,3,4,5,6,7\n");
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) {
    text.insert(at, 1, '\r');
  }
  CHECK(good_rows(text) == Lines{"0 1 2/3 4/5 6", "1 2 3/4 5/6 7"});
}

TEST_CASE("Blank lines and comments between rows are skipped", "[recording]") {
  CHECK(good_rows(recording("\n0,1,2,3,4,5,6\n# a note, with commas\n\n#\n1,2,3,4,5,6,7\n\n")) ==
        Lines{"0 1 2/3 4/5 6", "1 2 3/4 5/6 7"});
}

TEST_CASE("Numbers may have blanks around them", "[recording]") {
  CHECK(good_rows(recording(" 0, 1 ,2 ,\t3,4\t, 5, 6 \n")) == Lines{"0 1 2/3 4/5 6"});
}

TEST_CASE("Numbers may have the decimal point that pandas puts beside NaN", "[recording]") {
  CHECK(good_rows(recording("0,50000.0,23411.0,102.0,22876.0,99.0,0.0\n")) ==
        Lines{"0 50000 23411/102 22876/99 0"});
}

TEST_CASE("Whole numbers may be written with an exponent", "[recording]") {
  CHECK(good_rows(recording("0,5e+04,2.3411e4,1.02E2,4,5,6\n")) ==
        Lines{"0 50000 23411/102 4/5 6"});
}

TEST_CASE("An empty or NaN cell is a missing reading", "[recording]") {
  const std::string cell = GENERATE("", " ", "nan", "NaN", "NAN", " NaN ");
  CAPTURE(cell);
  CHECK(good_rows(recording("0,1," + cell + "," + cell + ",4,5,6\n")) == Lines{"0 1 - 4/5 6"});
}

TEST_CASE("A sensor of which one reading is missing has none", "[recording]") {
  CHECK(good_rows(recording("0,1,,3,4,5,6\n1,2,2,,4,5,6\n")) ==
        Lines{"0 1 - 4/5 6", "1 2 - 4/5 6"});
}

TEST_CASE("A sample may lack every reading", "[recording]") {
  CHECK(good_rows(recording("0,1,,,,,6\n")) == Lines{"0 1 - - 6"});
}

TEST_CASE("A row after a missing reading has its own readings", "[recording]") {
  CHECK(good_rows(recording("0,1,,,4,5,6\n1,2,3,4,5,6,7\n")).back() == "1 2 3/4 5/6 7");
}

TEST_CASE("Times run on past the wrap of 32-bit microseconds", "[recording]") {
  // 2^32 us = 71.6 min
  CHECK(good_rows(recording("0,4294967295,2,3,4,5,6\n1,4294967296,2,3,4,5,6\n")) ==
        Lines{"0 4294967295 2/3 4/5 6", "1 4294967296 2/3 4/5 6"});
}

TEST_CASE("The largest seq, time, reading and flags are read in full", "[recording]") {
  // 2^53 - 1, RFC 7493's largest integer: pandas, JSON and JavaScript keep it exactly, too.
  const std::string most = "9007199254740991";
  const Lines expected = {most + " " + most + " 65535/0 0/65535 255"};
  CHECK(good_rows(recording(most + "," + most + ",65535,0,0,65535,255\n")) == expected);
  CHECK(good_rows(recording(" " + most + "," + most + ".0,65535,0,0,65535,255\n")) == expected);
}

TEST_CASE("seq that goes back is handed on as it stands", "[recording]") {
  CHECK(good_rows(recording("5,6,2,3,4,5,6\n0,1,2,3,4,5,6\n")) ==
        Lines{"5 6 2/3 4/5 6", "0 1 2/3 4/5 6"});
}

TEST_CASE("A last line cut short costs no whole line", "[recording]") {
  const ReadOut out = read_text(recording("0,1,2,3,4,5,6\n1,2,3,4,5"));
  CHECK(out.error.empty());
  CHECK(out.rows == Lines{"0 1 2/3 4/5 6"});
  CHECK(out.complaints ==
        Lines{"rec.csv:10: the last line is cut short ('1,2,3,4,5') and not used"});
}

TEST_CASE("Control characters of a line cut short do not reach the terminal", "[recording]") {
  CHECK(read_text(recording("0,\x1b[31m\x07")).complaints ==
        Lines{"rec.csv:9: the last line is cut short ('0,?[31m?') and not used"});
}

TEST_CASE("A recording cut anywhere in its rows gives its whole lines", "[recording]") {
  const std::string head = recording("");
  const std::string rows = "0,1,2,3,4,5,6\n1,2,,,5,6,7\n# note\n2,3,4,5,6,7,8\n";
  const Lines all = {"0 1 2/3 4/5 6", "1 2 - 5/6 7", "2 3 4/5 6/7 8"};
  for (std::size_t bytes = 0; bytes <= rows.size(); ++bytes) {
    const std::string kept = rows.substr(0, bytes);
    const ReadOut out = read_text(head + kept);
    CAPTURE(kept);
    std::size_t whole = 0;
    for (std::size_t at = 0; (at = kept.find('\n', at)) != std::string::npos; ++at) {
      whole += kept[at - 1] == 'e' ? 0U : 1U;
    }
    REQUIRE(out.error.empty());
    REQUIRE(out.rows == Lines(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(whole)));
    REQUIRE(out.complaints.size() == (kept.empty() || kept.back() == '\n' ? 0 : 1));
  }
}

TEST_CASE("A recording of many times the buffer arrives whole", "[recording]") {
  std::string rows;
  Lines expected;
  for (std::int64_t i = 0; i < 60'000; ++i) {
    rows += fmt::format("{},{},{},2,3,4,0\n", i, 50'000 * i, i % 65'536);
    expected.push_back(fmt::format("{} {} {}/2 3/4 0", i, 50'000 * i, i % 65'536));
  }
  CHECK((good_rows(recording(rows)) == expected));
}

TEST_CASE("A recording may come through a pipe in pieces", "[recording]") {
  int ends[2] = {};
  REQUIRE(::pipe(ends) == 0);
  const std::string text = recording("0,1,2,3,4,5,6\n1,2,3,4,5,6,7\n");
  std::thread writer([&] {
    for (std::size_t at = 0; at < text.size(); at += 7) {
      const std::string piece = text.substr(at, 7);
      if (::write(ends[1], piece.data(), piece.size()) < 0) {
        break;
      }
    }
    ::close(ends[1]);
  });
  const ReadOut out = read_out(fmt::format("/dev/fd/{}", ends[0]));
  writer.join();
  ::close(ends[0]);
  CHECK(out.error.empty());
  CHECK(out.rows == Lines{"0 1 2/3 4/5 6", "1 2 3/4 5/6 7"});
}

TEST_CASE("The path - is the standard input", "[recording]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("rec.csv", recording("0,1,2,3,4,5,6\n1,"));
  const int before = ::dup(STDIN_FILENO);
  const int file = ::open(path.c_str(), O_RDONLY);
  REQUIRE(::dup2(file, STDIN_FILENO) == STDIN_FILENO);
  ::close(file);
  const ReadOut out = read_out("-");
  REQUIRE(::dup2(before, STDIN_FILENO) == STDIN_FILENO);
  ::close(before);
  CHECK(out.rows == Lines{"0 1 2/3 4/5 6"});
  CHECK(out.complaints ==
        Lines{"standard input:10: the last line is cut short ('1,') and not used"});
}

TEST_CASE("place() names the line of the row read last", "[recording]") {
  const TemporaryFolder folder;
  auto reader =
      RecordingReader::open(folder.write("rec.csv", recording("0,1,2,3,4,5,6\n\n1,2,3,4,5,6,7\n")));
  REQUIRE(reader);
  Sample sample;
  REQUIRE(reader->read(sample));
  CHECK(folder.relative(reader->place()) == "rec.csv:9");
  REQUIRE(reader->read(sample));
  CHECK(folder.relative(reader->place()) == "rec.csv:11");
}

TEST_CASE("Progress runs up to 1", "[recording]") {
  const TemporaryFolder folder;
  auto reader =
      RecordingReader::open(folder.write("rec.csv", recording("0,1,2,3,4,5,6\n1,2,3,4,5,6,7\n")));
  REQUIRE(reader);
  Sample sample;
  REQUIRE(reader->read(sample));
  CHECK(reader->progress() > 0.5);
  CHECK(reader->progress() < 1);
  REQUIRE(reader->read(sample));
  CHECK(reader->progress() == 1);
}

TEST_CASE("Progress stays at 1 while a recording grows under its reader", "[recording]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("rec.csv", recording(""));
  auto reader = RecordingReader::open(path);
  REQUIRE(reader);
  std::ofstream(path, std::ios::app) << "0,1,2,3,4,5,6\n";
  Sample sample;
  REQUIRE(reader->read(sample).value());
  CHECK(reader->progress() == 1);
}

}  // namespace
