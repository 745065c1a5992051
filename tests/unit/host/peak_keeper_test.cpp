// SPDX-License-Identifier: Apache-2.0
// Tests of which rows are kept for the eye.
#include "host/web/peak_keeper.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

namespace {

using namespace penduline;

/// 1 kHz, 20 rows a bin, all curves rising slowly.
std::vector<LiveRow> rising_rows(int count) {
  std::vector<LiveRow> rows;
  for (int i = 0; i < count; ++i) {
    LiveRow row{.t_s = 0.001 * i + 0.0005, .theta1_rad = 0.01 * i, .theta2_rad = 0.02 * i};
    row.signal_v = {0.001 * i, 0.002 * i};
    row.gap_m = {0.1 + 0.001 * i, 0.1 + 0.002 * i};
    rows.push_back(row);
  }
  return rows;
}

/// The places, in rows at 1 kHz, of what is kept.
std::vector<int> kept_places(const std::vector<LiveRow>& rows, double bin_s = 0.02) {
  PeakKeeper keeper(bin_s, 2);
  std::vector<LiveRow> kept;
  for (const LiveRow& row : rows) {
    keeper.add(row, kept);
  }
  keeper.finish(kept);
  std::vector<int> places;
  for (const LiveRow& row : kept) {
    places.push_back(static_cast<int>(std::floor(row.t_s * 1000)));
  }
  return places;
}

TEST_CASE("Of curves that rise through a bin its first and last row are kept", "[web]") {
  CHECK(kept_places(rising_rows(60)) == std::vector<int>{0, 19, 20, 39, 40, 59});
}

TEST_CASE("Of each curve that breaks in a bin a row without its answer is kept", "[web]") {
  auto rows = rising_rows(20);
  rows[5].gap_m[1] = kNotKnown;
  rows[6].gap_m[1] = kNotKnown;
  rows[11].signal_v[0] = kNotKnown;
  CHECK(kept_places(rows) == std::vector<int>{0, 5, 11, 19});
}

TEST_CASE("A peak of one row is kept, whichever curve it is in", "[web]") {
  auto rows = rising_rows(20);
  SECTION("the first angle") {
    rows[7].theta1_rad = 1;
  }
  SECTION("the second angle, downwards") {
    rows[7].theta2_rad = -1;
  }
  SECTION("a signal") {
    rows[7].signal_v[1] = 3;
  }
  SECTION("a gap") {
    rows[7].gap_m[1] = 0.001;
  }
  CHECK(kept_places(rows) == std::vector<int>{0, 7, 19});
}

TEST_CASE("A row with a flag that its bin had not before is kept", "[web]") {
  auto rows = rising_rows(20);
  rows[3].flags = flag::kSaturated;
  rows[4].flags = flag::kSaturated;
  rows[9].flags = flag::kSaturated | flag::kLate;
  CHECK(kept_places(rows) == std::vector<int>{0, 3, 9, 19});
}

TEST_CASE("The rows around lost angles are kept, so that the line breaks where they are", "[web]") {
  auto rows = rising_rows(20);
  for (const std::size_t i : {8U, 9U, 10U}) {
    rows[i].theta1_rad = rows[i].theta2_rad = kNotKnown;
  }
  CHECK(kept_places(rows) == std::vector<int>{0, 7, 8, 10, 11, 19});
}

TEST_CASE("Of a bin without any answer one row is kept", "[web]") {
  std::vector<LiveRow> rows;
  for (int i = 0; i < 40; ++i) {
    rows.push_back({.t_s = 0.001 * i + 0.0005});
  }
  CHECK(kept_places(rows) == std::vector<int>{19, 39});
}

TEST_CASE("Without bins every row is kept at once", "[web]") {
  PeakKeeper keeper(0, 2);
  std::vector<LiveRow> kept;
  keeper.add({.t_s = 1}, kept);
  CHECK(kept.size() == 1);
}

TEST_CASE("A bin waits for its end", "[web]") {
  PeakKeeper keeper(0.02, 2);
  std::vector<LiveRow> kept;
  for (const LiveRow& row : rising_rows(20)) {
    keeper.add(row, kept);
  }
  CHECK(kept.empty());
  keeper.add({.t_s = 0.0205}, kept);
  CHECK(kept.size() == 2);
}

}  // namespace
