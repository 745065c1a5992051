// SPDX-License-Identifier: Apache-2.0
// Tests of the points as JSON, and of how many are kept.
#include "host/web/live_points.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

using namespace penduline;

TEST_CASE("Points are columns of equal length, null where there is no answer", "[web]") {
  LivePoints points(2);
  LiveRow row{.t_s = 0.05, .theta1_rad = -0.1234567, .theta2_rad = 0.25, .x_m = 0.1};
  row.signal_v = {1.5, kNotKnown};
  row.gap_m = {0.02, kNotKnown};
  row.flags = flag::kMissing;
  points.add(row);
  points.add({.t_s = 0.1});
  CHECK(points.json(0) ==
        R"({"t_s":[0.050000,0.100000],"theta1_rad":[-0.123457,null],"theta2_rad":[0.250000,null],)"
        R"("sigma1_rad":[null,null],"sigma2_rad":[null,null],"x_m":[0.100000,null],)"
        R"("y_m":[null,null],"z_m":[null,null],"signal_v":[[1.50000,null],[null,null]],)"
        R"("gap_m":[[0.020000,null],[null,null]],"flags":[1024,0]})");
}

TEST_CASE("Only what came later than a place is told", "[web]") {
  LivePoints points(2);
  points.add({.t_s = 1});
  const auto place = points.end();
  points.add({.t_s = 2});
  const auto json = nlohmann::json::parse(points.json(place));
  CHECK(json["t_s"] == nlohmann::json::parse("[2.0]"));
  CHECK(nlohmann::json::parse(points.json(points.end()))["t_s"].empty());
}

TEST_CASE("Slices are of a second each, and one is there without any row", "[web]") {
  LivePoints points(2);
  const auto moments = [&] {
    std::vector<nlohmann::json> slices;
    for (const std::string& slice : points.slices()) {
      slices.push_back(nlohmann::json::parse(slice)["t_s"]);
    }
    return slices;
  };
  CHECK(moments() == std::vector<nlohmann::json>{nlohmann::json::array()});
  for (const double t_s : {0.25, 0.5, 1.2, 1.25, 3.5}) {
    points.add({.t_s = t_s});
  }
  CHECK(moments() == std::vector<nlohmann::json>{{0.25, 0.5, 1.2}, {1.25}, {3.5}});
}

TEST_CASE("A minute is kept, and never more rows than memory is meant for", "[web]") {
  LivePoints points(2);
  for (int i = 0; i < 2000; ++i) {
    points.add({.t_s = 0.05 * i});
  }
  CHECK(points.rows().size() == 1201);
  CHECK(points.rows().front().t_s == Approx(0.05 * 1999 - 60));
  for (std::size_t i = 0; i < LivePoints::kMostRows + 10; ++i) {
    points.add({.t_s = 100 + 1e-6 * static_cast<double>(i)});
  }
  CHECK(points.rows().size() == LivePoints::kMostRows);
  CHECK(nlohmann::json::parse(points.json(0))["flags"].size() == LivePoints::kMostRows);
}

}  // namespace
