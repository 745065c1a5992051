// SPDX-License-Identifier: Apache-2.0
// What a recording has to be said against it before anything is made of it.
#include "host/calibration/signal_log.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

constexpr const char* kHeader =
    "# penduline_recording = 1\n# rate_hz = 20.0\n# full_scale_counts = 65535\n"
    "# reference_v = 3.3\nseq,t_us,x_on,x_off,y_on,y_off,flags\n";

/// The complaints of a recording with these rows behind three good ones.
std::vector<std::string> complaints_of(const std::string& rows) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("rec.csv", std::string(kHeader) +
                                  "0,0,9,0,9,0,0\n1,50000,9,0,9,0,0\n2,100000,9,0,9,0,0\n" + rows);
  const auto log = read_signals(path, 2);
  REQUIRE(log);
  std::vector<std::string> complaints;
  for (const std::string& complaint : log->complaints) {
    complaints.push_back(folder.relative(complaint));
  }
  return complaints;
}

TEST_CASE("A sound recording has nothing said against it", "[calibration]") {
  CHECK(complaints_of("3,150000,9,0,9,0,0\n").empty());
}

TEST_CASE("What a replay would flag is said of a recording that is calibrated by",
          "[calibration]") {
  const auto flagged = [](const std::string& row) {
    const auto complaints = complaints_of(row);
    return complaints.size() == 1 ? complaints.front() : "";
  };
  CHECK(flagged("5,250000,9,0,9,0,0\n") == "rec.csv: 4 samples; flagged: 1 dropout");
  CHECK(flagged("3,150000,9,0,9,0,1\n") == "rec.csv: 4 samples; flagged: 1 saturated");
  CHECK(flagged("3,150000,9,0,9,0,10\n") == "rec.csv: 4 samples; flagged: 1 overrun, 1 late");
  CHECK(flagged("3,150000,,,9,0,0\n") == "rec.csv: 4 samples; flagged: 1 missing");
  // A restart: the board's own flag is ordinary, what is lost before it is not.
  CHECK(flagged("3,150000,9,0,9,0,4\n") == "rec.csv: 4 samples; flagged: 1 dropout");
}

TEST_CASE("A last line that is cut off is said, as by a replay", "[calibration]") {
  CHECK(complaints_of("3,1500").size() == 1);
}

TEST_CASE("Samples at another rate than the nominal one are said", "[calibration]") {
  const auto complaints = complaints_of("3,130000,9,0,9,0,0\n4,150000,9,0,9,0,0\n");
  REQUIRE(complaints.size() == 1);
  CHECK(complaints.front() ==
        "rec.csv: the samples come at 26.667 Hz, expected their nominal 20.000 Hz");
}

}  // namespace
