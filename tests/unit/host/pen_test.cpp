// SPDX-License-Identifier: Apache-2.0
#include "host/plot/pen.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace penduline;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Rows as numbers, the pen lifted as -1.
std::vector<int> rows_of(const PenPath& path) {
  std::vector<int> rows;
  for (const auto& row : path) {
    rows.push_back(row ? static_cast<int>(*row) : -1);
  }
  return rows;
}

/// The mass at these places in a row, one a second.
EstimateSeries path_along_x(const std::vector<double>& x_m) {
  EstimateSeries series;
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    const bool known = std::isfinite(x_m[i]);
    series.push_back({.t_us = 1'000'000 * static_cast<std::int64_t>(i), .seq = i});
    if (known) {
      series.theta1_rad[i] = series.theta2_rad[i] = 0;
      series.x_m[i] = x_m[i];
      series.y_m[i] = series.z_m[i] = 0;
    }
  }
  return series;
}

}  // namespace

TEST_CASE("A pen goes through every row where an eye sees them all") {
  const PenPath path = pen_over({0, 1, 2, 3}, {5, 6, 5, 7}, {false, true, true, true});
  CHECK(rows_of(path) == std::vector<int>{0, 1, 2, 3});
  CHECK(along(path, {10, 20, 30, 40}, 10) == std::vector<double>{1, 2, 3, 4});
}

TEST_CASE("A pen is lifted at each break and over what is not finite") {
  const PenPath path =
      pen_over({0, 1, 2, 3, 4}, {1, 2, 3, kNone, 5}, {false, true, false, false, false});
  CHECK(rows_of(path) == std::vector<int>{0, 1, -1, 2, -1, 4});
  const std::vector<double> y = along(path, {1, 2, 3, kNone, 5});
  CHECK(std::isnan(y[2]));
  CHECK(std::isnan(y[4]));
  CHECK(y[5] == 5);
}

TEST_CASE("A break at a row that is not finite lifts the pen for the next") {
  // As differences have it: the row after a break has none, and the one behind is joined to it.
  const std::vector<double> y{1, 2, kNone, 4, 5};
  const std::vector<bool> joined{false, true, false, true, true};
  CHECK(rows_of(pen_over({0, 1, 2, 3, 4}, y, joined)) == std::vector<int>{0, 1, -1, 3, 4});
  CHECK(rows_of(pen_through(y, joined)) == std::vector<int>{0, 1, -1, 3, 4});
  CHECK(rows_of(pen_through({kNone, 1, kNone}, {false, true, true})) == std::vector<int>{1});
}

TEST_CASE("A path through all rows is not thinned") {
  const std::vector<double> values(10'000, 1);
  CHECK(pen_through(values, std::vector<bool>(values.size(), true)).size() == 10'000);
}

TEST_CASE("A thinned path keeps peaks, both ends and breaks") {
  std::vector<double> x(100'000);
  std::vector<double> y(x.size());
  std::vector<bool> joined(x.size(), true);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = static_cast<double>(i);
    y[i] = std::sin(0.01 * static_cast<double>(i));
  }
  y[54'321] = 3;
  y[54'322] = -3;
  joined[0] = joined[70'001] = false;
  const PenPath path = pen_over(x, y, joined, 100);
  CHECK(path.size() < 410);
  const std::vector<int> rows = rows_of(path);
  for (const int row : {0, 54'321, 54'322, 70'000, -1, 70'001, 99'999}) {
    CHECK(std::ranges::count(rows, row) == 1);
  }
  CHECK(std::ranges::is_sorted(std::vector<int>(rows.begin(), std::ranges::find(rows, -1))));
}

TEST_CASE("A path in space leaves out what an eye does not see, but no end of a part") {
  // A thousandth of 1 m is seen.
  const PenPath path =
      pen_in_space(path_along_x({0, 0.0004, 0.0008, 0.0012, 0.9, 0.9001, kNone, 0.9002, 1}));
  CHECK(rows_of(path) == std::vector<int>{0, 3, 4, 5, -1, 7, 8});
}

TEST_CASE("A path in space is broken where there are angles but no position") {
  EstimateSeries series = path_along_x({0, 0.5, 0.6, 0.6001, 1});
  series.x_m[1] = kNone;
  series.z_m[3] = kNone;
  CHECK(rows_of(pen_in_space(series)) == std::vector<int>{0, -1, 2, -1, 4});
}

TEST_CASE("Rows without neighbours are told apart") {
  CHECK(rows_of(lone_rows({0, std::nullopt, 2, 3, std::nullopt, 5})) == std::vector<int>{0, 5});
  CHECK(lone_rows({}).empty());
}
