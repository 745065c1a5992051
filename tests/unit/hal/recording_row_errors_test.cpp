// SPDX-License-Identifier: Apache-2.0
// Tests of recordings with wrong rows, and of paths that are no recording: each message in full.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/unit/hal/recording_text.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

/// The error of a recording whose second row, on line 10, is `row`; the first must arrive.
std::string row_error(const std::string& row) {
  const ReadOut out = read_text(recording("0,1,2,3,4,5,6\n" + row + "\n2,3,4,5,6,7,8\n"));
  CHECK(out.rows == std::vector<std::string>{"0 1 2/3 4/5 6"});
  return out.error;
}

TEST_CASE("Text in a reading is named", "[recording]") {
  CHECK(row_error("1,2,dark,3,4,5,6") ==
        "rec.csv:10: field 'x_on': found 'dark', expected a whole number from 0 to 65535");
}

TEST_CASE("What begins like a number but is none is named", "[recording]") {
  const std::string cell = GENERATE("12a", "0x10", "1 2", "1.5", "--1", "1e", "inf", "1_000");
  CHECK(row_error("1,2,3,4," + cell + ",5,6") ==
        "rec.csv:10: field 'y_on': found '" + cell + "', expected a whole number from 0 to 65535");
}

TEST_CASE("A negative reading is named", "[recording]") {
  CHECK(row_error("1,2,3,-5,4,5,6") ==
        "rec.csv:10: field 'x_off': found '-5', expected a whole number from 0 to 65535");
}

TEST_CASE("A reading beyond full scale is named", "[recording]") {
  CHECK(row_error("1,2,3,4,5,65536,6") ==
        "rec.csv:10: field 'y_off': found '65536', expected a whole number from 0 to 65535");
}

TEST_CASE("A reading that wraps round 32 bits is named", "[recording]") {
  // 2^32 + 1
  CHECK(row_error("1,2,3,4,5,4294967297,6") ==
        "rec.csv:10: field 'y_off': found '4294967297', expected a whole number from 0 to 65535");
}

TEST_CASE("The header's full scale is the readings' limit", "[recording]") {
  CHECK(read_text("# penduline_recording = 1\n# rate_hz = 20\n# full_scale_counts = 4095\n"
                  "# reference_v = 3.3\n" +
                  std::string(kDesignColumns) + "0,1,4096,3,4,5,6\n")
            .error ==
        "rec.csv:6: field 'x_on': found '4096', expected a whole number from 0 to 4095");
}

TEST_CASE("NaN, an empty cell and a negative number are no seq", "[recording]") {
  const std::string cell = GENERATE("NaN", "", "-1");
  CHECK(row_error(cell + ",2,3,4,5,6,7") == "rec.csv:10: field 'seq': found '" + cell +
                                                "', expected a whole number from 0 to "
                                                "9007199254740991");
}

TEST_CASE("An empty time is named", "[recording]") {
  CHECK(row_error("1,,3,4,5,6,7") ==
        "rec.csv:10: field 't_us': found '', expected a whole number from 0 to 9007199254740991");
}

TEST_CASE("Empty flags are named", "[recording]") {
  CHECK(row_error("1,2,3,4,5,6,") ==
        "rec.csv:10: field 'flags': found '', expected a whole number from 0 to 255");
}

TEST_CASE("A seq that not every reader keeps exactly is told the largest", "[recording]") {
  // 2^53 with and without blanks, and the first beyond 64 bits.
  const std::string cell =
      GENERATE("9007199254740992", " 9007199254740992", "18446744073709551616");
  CHECK(row_error(cell + ",2,3,4,5,6,7") == "rec.csv:10: field 'seq': found '" + cell +
                                                "', expected a whole number from 0 to "
                                                "9007199254740991");
}

TEST_CASE("A time that not every reader keeps exactly is told the largest", "[recording]") {
  // 2^53, 2^53 + 1 with a blank, 2^63 - 1 and 2^63
  const std::string cell = GENERATE("9007199254740992", "9007199254740993 ", "9223372036854775807",
                                    "9223372036854775808");
  CHECK(row_error("1," + cell + ",3,4,5,6,7") == "rec.csv:10: field 't_us': found '" + cell +
                                                     "', expected a whole number from 0 to "
                                                     "9007199254740991");
}

TEST_CASE("Flags beyond the device's eight bits are told the largest", "[recording]") {
  // The bits above are the pipeline's own.
  const std::string cell = GENERATE("256", "4294967296");
  CHECK(row_error("1,2,3,4,5,6," + cell) ==
        "rec.csv:10: field 'flags': found '" + cell + "', expected a whole number from 0 to 255");
}

TEST_CASE("A row with too few cells is counted", "[recording]") {
  CHECK(row_error("1,2,3,4,5,6") == "rec.csv:10: found 6 cells, expected 7: '1,2,3,4,5,6'");
}

TEST_CASE("A row with too many cells is counted", "[recording]") {
  CHECK(row_error("1,2,3,4,5,6,7,8") == "rec.csv:10: found 8 cells, expected 7: '1,2,3,4,5,6,7,8'");
}

TEST_CASE("A comma too many at the end is counted", "[recording]") {
  CHECK(row_error("1,2,3,4,5,6,7,") == "rec.csv:10: found 8 cells, expected 7: '1,2,3,4,5,6,7,'");
}

TEST_CASE("Two rows on one line are counted", "[recording]") {
  // What is left where a writer died and the next one went on.
  CHECK(row_error("1,2,3,42,3,4,5,6,7,8") ==
        "rec.csv:10: found 10 cells, expected 7: '1,2,3,42,3,4,5,6,7,8'");
}

TEST_CASE("A long cell is shown by its first 60 characters", "[recording]") {
  CHECK(row_error("1,2," + std::string(100, 'x') + ",4,5,6,7") ==
        "rec.csv:10: field 'x_on': found '" + std::string(60, 'x') +
            "...', expected a whole number from 0 to 65535");
}

TEST_CASE("Control characters do not reach the terminal", "[recording]") {
  CHECK(row_error("1,2,\x1b[31m\x07,4,5,6,7") ==
        "rec.csv:10: field 'x_on': found '?[31m?', expected a whole number from 0 to 65535");
}

TEST_CASE("A line of the longest length is read", "[recording]") {
  CHECK(read_text(recording("#" + std::string(4095, '.') + "\n")).error.empty());
}

TEST_CASE("A line one byte longer is refused", "[recording]") {
  CHECK(row_error("#" + std::string(4096, '.')) ==
        "rec.csv:10: the line is longer than 4096 bytes; is this the right file?");
}

TEST_CASE("A line of a megabyte is refused", "[recording]") {
  CHECK(row_error(std::string(1'000'000, '7')) ==
        "rec.csv:10: the line is longer than 4096 bytes; is this the right file?");
}

TEST_CASE("A NUL byte among the rows is refused", "[recording]") {
  CHECK(row_error(std::string("1,2,3,\0004,5,6,7", 14)) ==
        "rec.csv:10: found a NUL byte, expected text; is this the right file?");
}

TEST_CASE("A binary file is refused", "[recording]") {
  CHECK(read_text(std::string("\x7f"
                              "ELF\2\1\1\0\0\n\0\0",
                              12))
            .error == "rec.csv:1: found a NUL byte, expected text; is this the right file?");
}

TEST_CASE("A folder is no recording", "[recording]") {
  const TemporaryFolder folder;
  CHECK(read_out(folder.path()).error == folder.path() + ": Is a directory");
}

TEST_CASE("A file that is not there is named", "[recording]") {
  const TemporaryFolder folder;
  CHECK(folder.relative(read_out(folder.path("none.csv")).error) ==
        "none.csv: No such file or directory");
}

TEST_CASE("A file that fails while it is read is named", "[recording]") {
  // Address 0 of our own memory.
  CHECK(read_out("/proc/self/mem").error == "/proc/self/mem: Input/output error");
}

TEST_CASE("A file that we may not read is named", "[recording]") {
  if (::geteuid() == 0) {
    WARN("root may read every file: not tested");
    return;
  }
  const TemporaryFolder folder;
  const std::string path = folder.write("rec.csv", recording(""));
  std::filesystem::permissions(path, std::filesystem::perms::none);
  CHECK(folder.relative(read_out(path).error) == "rec.csv: Permission denied");
}

}  // namespace
