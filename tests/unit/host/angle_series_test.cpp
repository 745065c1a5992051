// SPDX-License-Identifier: Apache-2.0
#include "host/analysis/angle_series.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/unit/temporary_folder.hpp"

using namespace penduline;
using penduline::test::TemporaryFolder;

namespace {

tl::expected<AngleSeries, Error> read(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder.path("angles.csv");
  std::ofstream(path) << text;
  return read_angle_table(path);
}

/// The error's message behind the folder's name.
std::string complaint(const std::string& text) {
  const auto series = read(text);
  REQUIRE_FALSE(series);
  return series.error().message.substr(series.error().message.find("angles.csv"));
}

}  // namespace

TEST_CASE("Estimates are read by their columns' names, in any order") {
  const auto series = read("seq,theta2_rad,flags,theta1_rad,t_s\n0,0.2,0,0.1,1.5\n1,0.4,0,0.3,2\n");
  REQUIRE(series);
  CHECK(series->t_s == std::vector<double>{1.5, 2});
  CHECK(series->theta1_rad == std::vector<double>{0.1, 0.3});
  CHECK(series->theta2_rad == std::vector<double>{0.2, 0.4});
  CHECK_FALSE(series->planar);
}

TEST_CASE("One angle alone is a plane swing") {
  const auto series = read("# of an encoder\nt_s,theta_rad\n0,0.1\n1,0.2\n");
  REQUIRE(series);
  CHECK(series->planar);
  CHECK(series->theta1_rad == std::vector<double>{0.1, 0.2});
  CHECK(series->theta2_rad == std::vector<double>{0, 0});
}

TEST_CASE("Rows without angles or with a flag against them are left out and counted") {
  // 2048 filling is ordinary, 256 a dropout before a good row; 8192 is folded.
  const auto series = read(
      "t_s,theta1_rad,theta2_rad,flags\n0,,,2048\n1,0.1,0.1,2048\n2,0.1,0.1,256\n3,0.1,0.1,8192\n");
  REQUIRE(series);
  CHECK(series->t_s == std::vector<double>{1, 2});
  CHECK(series->left_out == 2);
  CHECK(series->left_out_text() == "2 of 4 rows are left out (1 without angles; 1 folded)");
}

TEST_CASE("Where nothing is left out there is nothing to say of it") {
  CHECK(read("t_s,theta_rad\n0,0.1\n")->left_out_text().empty());
}

TEST_CASE("A flag of a newer version leaves a row out, and that is said") {
  const auto series = read("t_s,theta_rad,flags\n0,0.1,0\n1,0.1,1073741824\n");
  REQUIRE(series);
  CHECK(series->left_out_text() ==
        "1 of 2 rows are left out (flags that this version does not know)");
}

TEST_CASE("A last row that does not end is not used") {
  const auto series = read("t_s,theta_rad\n0,0.1\n1,0.2\n2,0.");
  REQUIRE(series);
  CHECK(series->size() == 2);
}

TEST_CASE("What is no table of angles is refused with place, found and expected") {
  CHECK(complaint("time,angle\n0,1\n") ==
        "angles.csv:1: found the columns 'time,angle', expected t_s with theta1_rad and "
        "theta2_rad, or with theta_rad");
  CHECK(complaint("t_s,theta_rad\n0,0.1\n1,many\n") ==
        "angles.csv:3: found 'many' in column 2, expected a number");
  CHECK(complaint("t_s,theta_rad\n0,0.1\n1\n") == "angles.csv:3: found 1 cells, expected 2");
  CHECK(complaint("t_s,theta_rad\n1,0.1\n1,0.2\n") ==
        "angles.csv:3: the time went from 1 s to 1 s, expected it to rise");
  CHECK(complaint("t_s,theta_rad\n0,inf\n") ==
        "angles.csv:2: found 'inf' in column 2, expected a number");
}

TEST_CASE("A part of a series has the rows from its first to its last moment") {
  const auto series = read("t_s,theta_rad\n0,0.1\n1,0.2\n2,0.3\n3,0.4\n");
  REQUIRE(series);
  CHECK(series->between(1, 2).t_s == std::vector<double>{1, 2});
  CHECK(series->between(5, 4).size() == 0);
  CHECK(series->period_s() == 1);
}
