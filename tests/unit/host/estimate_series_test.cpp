// SPDX-License-Identifier: Apache-2.0
#include "host/plot/estimate_series.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "host/plot/estimate_input.hpp"
#include "host/plot/rates.hpp"
#include "tests/unit/temporary_folder.hpp"

using namespace penduline;
using penduline::test::TemporaryFolder;

namespace {

EstimateSeries read(const std::string& text) {
  const TemporaryFolder folder;
  const auto series = read_estimate_table(folder.write("estimates.csv", text));
  REQUIRE(series);
  return *series;
}

}  // namespace

TEST_CASE("A table's columns are found by name; what it lacks is not known") {
  const EstimateSeries series =
      read("sigma1_rad,theta2_rad,theta1_rad,t_s,flags\n0.01,0.2,0.1,1.5,0\n,0.4,0.3,2,8192\n");
  CHECK(series.t_s == std::vector<double>{1.5, 2});
  CHECK(series.theta1_rad == std::vector<double>{0.1, 0.3});
  CHECK(series.theta2_rad == std::vector<double>{0.2, 0.4});
  CHECK(series.sigma1_rad[0] == 0.01);
  CHECK(std::isnan(series.sigma1_rad[1]));
  CHECK_FALSE(any_known(series.x_m));
  CHECK(series.trusted(0));
  CHECK_FALSE(series.trusted(1));  // folded
  CHECK(series.answers(1));
}

TEST_CASE("A table with one angle is planar and swings about X") {
  EstimateSeries series = read("t_s,theta_rad\n0,0.1\n1,0.2\n");
  CHECK(series.planar);
  CHECK(series.theta2_rad == std::vector<double>{0, 0});
  series.hang_mass(0.3);
  // 0.3 (-sin t2, sin t1 cos t2, -cos t1 cos t2)
  CHECK(series.x_m[1] == Approx(0));
  CHECK(series.y_m[1] == Approx(0.3 * std::sin(0.2)));
  CHECK(series.z_m[1] == Approx(-0.3 * std::cos(0.2)));
}

TEST_CASE("An estimate's numbers stand in the columns of their names") {
  EstimateSeries series;
  series.push_back({.t_us = 2'500'000,
                    .attitude = {{.angles = {.theta1_rad = 0.1, .theta2_rad = 0.2},
                                  .mass_m = {0.01, 0.02, -0.29}}},
                    .omega_rad_s = {{.first = 1, .second = 2}},
                    .flags = flag::kDropout});
  series.push_back({.t_us = 3'000'000, .flags = flag::kNoSolution});
  REQUIRE(series.size() == 2);
  for (const SeriesColumn& column : kSeriesColumns) {
    CHECK((series.*column.values).size() == 2);
  }
  CHECK(series.t_s == std::vector<double>{2.5, 3});
  CHECK(series.theta2_rad[0] == 0.2);
  CHECK(series.y_m[0] == 0.02);
  CHECK(series.omega2_rad_s[0] == 2);
  CHECK(std::isnan(series.sigma1_rad[0]));
  CHECK(series.flags[0] == 256);
  CHECK_FALSE(series.answers(1));
}

TEST_CASE("Rows hold together but over lost ones, dropouts, restarts and missing answers") {
  const EstimateSeries series = read(
      "t_s,theta1_rad,theta2_rad,flags\n"
      "0,1,1,0\n1,1,1,0\n2,1,1,256\n3,1,1,0\n4,,,1024\n5,1,1,0\n6,1,1,4\n7.4,1,1,0\n9,1,1,0\n");
  //                                             0      1     2      3     4      5      6      7.4
  //                                             9
  CHECK(joined_rows(series) ==
        std::vector<bool>{false, true, false, true, false, false, false, true, false});
}

TEST_CASE("A part has the rows from one moment to another, both included") {
  const EstimateSeries part = read("t_s,theta_rad\n0,0.1\n1,0.2\n2,0.3\n3,0.4\n").between(1, 2);
  CHECK(part.t_s == std::vector<double>{1, 2});
  CHECK(part.theta1_rad == std::vector<double>{0.2, 0.3});
  CHECK(part.planar);
}

TEST_CASE("An analysis gets the trusted rows only") {
  const AngleSeries angles =
      read("t_s,theta1_rad,theta2_rad,flags\n0,,,0\n1,0.1,0.2,2048\n2,0.1,0.2,16384\n").angles();
  CHECK(angles.t_s == std::vector<double>{1});
  CHECK(angles.left_out == 2);
}

TEST_CASE("Rates by differences are the slope between neighbours, unknown beside a break") {
  const EstimateSeries series =
      read("t_s,theta_rad\n0,0.1\n0.1,0.3\n0.2,0.4\n0.3,0.8\n0.5,0.9\n0.6,1.0\n0.7,1.2\n");
  const std::vector<double> rates = central_differences(series, series.theta1_rad);
  CHECK(std::isnan(rates[0]));
  CHECK(rates[1] == Approx(1.5));
  CHECK(rates[2] == Approx(2.5));
  CHECK(std::isnan(rates[3]));
  CHECK(std::isnan(rates[4]));
  CHECK(rates[5] == Approx(1.5));
  CHECK(std::isnan(rates[6]));
}

TEST_CASE("A table whose time does not rise is refused with its line") {
  const TemporaryFolder folder;
  const auto series = read_estimate_table(folder.write("back.csv", "t_s,theta_rad\n1,0\n1,0\n"));
  REQUIRE_FALSE(series);
  CHECK(series.error().message ==
        folder.path("back.csv") + ":3: the time went from 1 s to 1 s, expected it to rise");
}
