// SPDX-License-Identifier: Apache-2.0
// A table of numbers as text: columns separated by commas, named by the first line.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"
#include "hal/replay/line_reader.hpp"

namespace penduline {

/// Goes through the rows of a table in constant memory. Blank lines and those behind '#' are
/// skipped.
class NumberTable {
 public:
  /// Reads the line of names, "" in an empty file. Fails where the file cannot be read.
  static tl::expected<NumberTable, Error> open(const std::string& path);

  /// The line of names.
  [[nodiscard]] const std::string& names() const { return names_; }
  /// Where a column stands; none where there is none of that name.
  [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const;

  /// Goes to the next row; false at the end. What stands behind the last newline may have lost
  /// digits and is no row. Fails where reading does, and on a row of another length.
  tl::expected<bool, Error> next();
  /// Goes through all rows to come and calls `take` on each. Fails as `next` does, or as `take`.
  tl::expected<void, Error> for_each_row(const std::function<tl::expected<void, Error>()>& take);

  /// Whether a cell of the row says that there is no number.
  [[nodiscard]] bool is_empty(std::size_t column) const;
  /// The number in a cell of the row. Fails where there is none, or one that is not finite.
  [[nodiscard]] tl::expected<double, Error> number(std::size_t column) const;
  /// "FILE:LINE" of the row.
  [[nodiscard]] std::string place() const { return lines_.place(); }

 private:
  explicit NumberTable(LineReader lines) : lines_(std::move(lines)) {}
  tl::expected<bool, Error> next_line();

  LineReader lines_;
  std::string names_;
  std::size_t columns_ = 0;
  std::vector<std::string_view> cells_;
};

}  // namespace penduline
