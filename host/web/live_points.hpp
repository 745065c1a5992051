// SPDX-License-Identifier: Apache-2.0
// The last minute's rows, for who opens the page now.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "host/web/live_row.hpp"

namespace penduline {

/// Rows in time's order, those of the last `kKeptS` seconds and never more than `kMostRows`.
class LivePoints {
 public:
  static constexpr double kKeptS = 60;
  static constexpr std::size_t kMostRows = 40000;
  static constexpr double kSliceS = 1;

  explicit LivePoints(std::size_t sensors) : sensors_(sensors) {}

  void add(const LiveRow& row);

  [[nodiscard]] const std::deque<LiveRow>& rows() const { return rows_; }
  /// How many were ever added.
  [[nodiscard]] std::uint64_t end() const { return end_; }
  /// The columns, as JSON on one line (docs/web_protocol.md), of the rows that were added after the
  /// first `from` ones and are still kept.
  [[nodiscard]] std::string json(std::uint64_t from) const;
  /// The same of all rows that are kept, in slices of `kSliceS`; one, if there is no row.
  [[nodiscard]] std::vector<std::string> slices() const;

 private:
  using Row = std::deque<LiveRow>::const_iterator;

  [[nodiscard]] std::string json(Row begin, Row end) const;

  std::size_t sensors_;
  std::deque<LiveRow> rows_;
  std::uint64_t end_ = 0;
};

}  // namespace penduline
