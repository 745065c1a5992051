// SPDX-License-Identifier: Apache-2.0
// Fewer rows for the eye, with every peak still there.
#pragma once

#include <cstdint>
#include <vector>

#include "host/web/live_row.hpp"

namespace penduline {

/// Cuts time into bins and keeps of each the rows with the extremes of both angles and of every
/// sensor's signal and gap, of each of these the first without an answer among others, the first
/// row with each flag, and those between which angles are lost or there again. What it keeps is as
/// it was.
class PeakKeeper {
 public:
  /// Bins of 0 s: keeps every row.
  PeakKeeper(double bin_s, std::size_t sensors) : bin_s_(bin_s), sensors_(sensors) {}

  /// Takes the next row in time's order, and appends to `kept` what is kept of a bin that is over.
  void add(const LiveRow& row, std::vector<LiveRow>& kept);
  /// Appends what is kept of the present bin, which is over.
  void finish(std::vector<LiveRow>& kept);

 private:
  void keep(std::vector<LiveRow>& kept) const;
  /// Marks the rows that have the extremes of the curve, and the first where it breaks.
  template <class Curve>
  void mark_extremes(const Curve& curve, std::vector<bool>& worth) const;

  double bin_s_;
  std::size_t sensors_;
  std::int64_t bin_ = 0;
  std::vector<LiveRow> rows_;  ///< of the present bin
};

}  // namespace penduline
