// SPDX-License-Identifier: Apache-2.0
// Property of the rows for the eye: no curve loses a peak.
#include <rapidcheck/catch.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <vector>

#include "host/web/peak_keeper.hpp"
#include "tests/property/generators.hpp"

namespace penduline::test {
namespace {

constexpr double kBinS = 0.02;
constexpr std::size_t kSensors = 2;

double any_number() {
  // One in ten has no answer.
  return *rc::gen::inRange(0, 10) == 0 ? kNotKnown : *in_steps(-1, 1);
}

std::vector<LiveRow> any_rows() {
  std::vector<LiveRow> rows(*rc::gen::inRange<std::size_t>(1, 120));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].t_s = 0.001 * (static_cast<double>(i) + 0.5);
    rows[i].theta1_rad = any_number();
    rows[i].theta2_rad = any_number();
    for (std::size_t sensor = 0; sensor < kSensors; ++sensor) {
      rows[i].signal_v[sensor] = any_number();
      rows[i].gap_m[sensor] = any_number();
    }
    rows[i].flags = *rc::gen::element<Flags>(0, flag::kSaturated, flag::kDropout | flag::kLate);
  }
  return rows;
}

std::vector<double> curves(const LiveRow& row) {
  return {row.theta1_rad,  row.theta2_rad, row.signal_v[0],
          row.signal_v[1], row.gap_m[0],   row.gap_m[1]};
}

/// Least and greatest of a curve in a bin; infinite where it has no answer there.
struct Range {
  double least = INFINITY;
  double most = -INFINITY;
  bool operator==(const Range&) const = default;
};

Range range(const std::vector<LiveRow>& rows, std::size_t curve, int bin) {
  Range found;
  for (const LiveRow& row : rows) {
    const double value = curves(row)[curve];
    if (static_cast<int>(std::floor(row.t_s / kBinS)) == bin && !std::isnan(value)) {
      found = {.least = std::min(found.least, value), .most = std::max(found.most, value)};
    }
  }
  return found;
}

TEST_CASE("Decimation keeps the extremes of every curve in every bin", "[property]") {
  rc::prop("what is kept is a part of the rows, in order, with the same extremes and flags", [] {
    const auto rows = any_rows();
    PeakKeeper keeper(kBinS, kSensors);
    std::vector<LiveRow> kept;
    for (const LiveRow& row : rows) {
      keeper.add(row, kept);
    }
    keeper.finish(kept);
    RC_ASSERT(std::ranges::is_sorted(kept, {}, &LiveRow::t_s));
    RC_ASSERT(std::ranges::includes(rows, kept, {}, &LiveRow::t_s, &LiveRow::t_s));
    for (int bin = 0; bin < 6; ++bin) {
      for (std::size_t curve = 0; curve < 6; ++curve) {
        RC_ASSERT(range(kept, curve, bin) == range(rows, curve, bin));
      }
      Flags of_rows = 0;
      Flags of_kept = 0;
      for (const LiveRow& row : rows) {
        of_rows |= std::floor(row.t_s / kBinS) == bin ? row.flags : 0;
      }
      for (const LiveRow& row : kept) {
        of_kept |= std::floor(row.t_s / kBinS) == bin ? row.flags : 0;
      }
      RC_ASSERT(of_kept == of_rows);
    }
  });
}

}  // namespace
}  // namespace penduline::test
