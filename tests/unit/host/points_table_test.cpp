// SPDX-License-Identifier: Apache-2.0
#include "host/calibration/points_table.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "tests/accuracy/simulated_unit.hpp"
#include "tests/unit/temporary_folder.hpp"

using namespace penduline;
using namespace penduline::test;

namespace {

/// What reading a table of this text comes to, its folder's name taken out of messages.
std::string error_of(const std::string& text, const std::string& recording = "rec.csv") {
  const TemporaryFolder folder;
  const std::string path = folder.path("p.csv");
  std::ofstream(path) << text;
  const auto points = read_points(path, recording, 2);
  return points ? "" : points.error().message.substr(path.size() - 5);
}

/// A recording of a held disc in the folder.
void put_recording(const std::string& path, int x_on, int last_x_on) {
  std::ofstream file(path);
  file << "# penduline_recording = 1\n# rate_hz = 20.0\n# full_scale_counts = 65535\n"
          "# reference_v = 3.3\nseq,t_us,x_on,x_off,y_on,y_off,flags\n";
  for (int i = 0; i < 20; ++i) {
    file << i << ',' << i * 50000 << ',' << (i < 10 ? x_on : last_x_on) << ",0,19859,0,0\n";
  }
}

}  // namespace

TEST_CASE("A table of tilts names recordings beside it", "[calibration]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path("p.csv"))
      << "# jig 2\n\nrecording, theta1_deg, theta2_deg\na.csv, 10, -5\nb.csv,0,0\n";
  const auto points = read_points(folder.path("p.csv"), "", 2);
  REQUIRE(points);
  REQUIRE(points->size() == 2);
  CHECK(points->front().recording == folder.path("a.csv"));
  CHECK(points->front().place == folder.path("p.csv") + ":4");
  CHECK(points->front().angles->theta1_rad == Approx(10 * kRadPerDeg));
  CHECK(points->front().angles->theta2_rad == Approx(-5 * kRadPerDeg));
}

TEST_CASE("A table of gaps may leave one sensor out, and take spans of one recording",
          "[calibration]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path("p.csv")) << "from_s,to_s,gap_x_mm,gap_y_mm\n1,2.5,9,\n3,4,,8.5\n";
  const auto points = read_points(folder.path("p.csv"), "rec.csv", 2);
  REQUIRE(points);
  CHECK(points->at(0).recording == "rec.csv");
  CHECK(points->at(0).to_s == 2.5);
  CHECK(points->at(0).gap_m[0] == Approx(0.009));
  CHECK(std::isnan(points->at(0).gap_m[1]));
  CHECK(points->at(1).gap_m[1] == Approx(0.0085));
}

TEST_CASE("What is wrong with a table is said with its line", "[calibration]") {
  CHECK(error_of("recording,theta_deg\n") ==
        "p.csv:1: found column 'theta_deg', expected each at most once of recording, from_s, to_s, "
        "theta1_deg, theta2_deg, gap_x_mm, gap_y_mm");
  CHECK(error_of("theta1_deg\n1\n") ==
        "p.csv:1: expected either theta1_deg and theta2_deg or gaps such as gap_x_mm among the "
        "columns");
  CHECK(error_of("from_s,gap_x_mm\n") == "p.csv:1: expected from_s and to_s together");
  CHECK(error_of("theta1_deg,theta2_deg\n1,2\n3\n") == "p.csv:3: found 1 cells, expected 2");
  CHECK(error_of("theta1_deg,theta2_deg\n1,two\n") ==
        "p.csv:2: theta2_deg: found 'two', expected a number");
  CHECK(error_of("theta1_deg,theta2_deg\n1,75\n") ==
        "p.csv:2: found 1 and 75 deg, expected angles within 60 deg");
  CHECK(error_of("from_s,to_s,gap_x_mm\n2,1,9\n") ==
        "p.csv:2: found from_s 2, to_s 1, expected from_s to be less");
  CHECK(error_of("gap_x_mm\n9\n", "") ==
        "p.csv:2: expected a column 'recording', or the recording as an argument");
  CHECK(error_of("gap_x_mm\n") == "p.csv: found no points, expected column names and rows");
}

TEST_CASE("A point is the mean of its span, and its gap that of the tilt", "[calibration]") {
  const TemporaryFolder folder;
  put_recording(folder.path("rec.csv"), 13107, 19859);
  std::ofstream(folder.path("p.csv"))
      << "recording,from_s,to_s,theta1_deg,theta2_deg\nrec.csv,0,0.45,0,0\nrec.csv,0.5,1,0,-5\n";
  const SensorLayout<double> layout = typical_rig().rig.layout;
  std::vector<std::string> complaints;
  const auto points = measure_points(*read_points(folder.path("p.csv"), "", 2), layout, complaints);
  REQUIRE(points);
  CHECK(points->at(0)[0].gap_m == Approx(0.009));
  CHECK(points->at(0)[0].volts == Approx(0.66));
  CHECK(points->at(0)[1].volts == Approx(3.3 * 19859 / 65535));
  // theta2 = -5 deg lifts the disc under X: 0.009 - 0.02 tan(5 deg) + 0.02 (1/cos(5 deg) - 1).
  CHECK(points->at(0)[1].gap_m == Approx(0.0073266).epsilon(1e-4));
}

TEST_CASE("A disc that moves during a point is refused", "[calibration]") {
  const TemporaryFolder folder;
  put_recording(folder.path("rec.csv"), 13107, 19859);
  std::ofstream(folder.path("p.csv")) << "recording,gap_x_mm\nrec.csv,9\n";
  std::vector<std::string> complaints;
  const auto points = measure_points(*read_points(folder.path("p.csv"), "", 2),
                                     typical_rig().rig.layout, complaints);
  REQUIRE_FALSE(points);
  CHECK(points.error().message.find("p.csv:2: the signal of sensor 1 varies by ") !=
        std::string::npos);
}
