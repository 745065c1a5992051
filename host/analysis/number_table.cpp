// SPDX-License-Identifier: Apache-2.0
// Rows and cells of a table of numbers.
#include "host/analysis/number_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/replay/cells.hpp"

namespace penduline {

tl::expected<NumberTable, Error> NumberTable::open(const std::string& path) {
  auto lines = LineReader::open(path);
  if (!lines) {
    return tl::unexpected(lines.error());
  }
  NumberTable table(std::move(*lines));
  const auto more = table.next_line();
  if (!more) {
    return tl::unexpected(more.error());
  }
  if (*more) {
    table.names_ = table.lines_.line();
  }
  table.columns_ = split_cells(table.names_, ",").size();
  return table;
}

std::optional<std::size_t> NumberTable::column(std::string_view name) const {
  const auto names = split_cells(names_, ",");
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - names.begin());
}

tl::expected<bool, Error> NumberTable::next_line() {
  while (true) {
    const auto outcome = lines_.next();
    if (!outcome) {
      return tl::unexpected(outcome.error());
    }
    if (*outcome != LineReader::Outcome::kLine) {
      return false;
    }
    if (!trimmed(lines_.line()).empty() && !lines_.line().starts_with('#')) {
      return true;
    }
  }
}

tl::expected<bool, Error> NumberTable::next() {
  auto more = next_line();
  if (!more || !*more) {
    return more;
  }
  cells_ = split_cells(lines_.line(), ",");
  if (cells_.size() != columns_) {
    return failure(
        fmt::format("{}: found {} cells, expected {}", place(), cells_.size(), columns_));
  }
  return true;
}

tl::expected<void, Error> NumberTable::for_each_row(
    const std::function<tl::expected<void, Error>()>& take) {
  while (true) {
    const auto more = next();
    if (!more) {
      return tl::unexpected(more.error());
    }
    if (!*more) {
      return {};
    }
    if (auto taken = take(); !taken) {
      return taken;
    }
  }
}

bool NumberTable::is_empty(std::size_t column) const {
  return is_missing(cells_[column]);
}

tl::expected<double, Error> NumberTable::number(std::size_t column) const {
  const auto value = parse_number<double>(cells_[column]);
  if (!value || !std::isfinite(*value)) {
    return failure(fmt::format("{}: found '{}' in column {}, expected a number", place(),
                               excerpt(cells_[column]), column + 1));
  }
  return *value;
}

}  // namespace penduline
