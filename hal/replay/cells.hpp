// SPDX-License-Identifier: Apache-2.0
// The cells of a line of text and the numbers in them.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace penduline {

/// Text without the blanks around it.
[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// The start of a text that may be of any length, for messages.
[[nodiscard]] inline std::string excerpt(std::string_view text) {
  constexpr std::size_t kShown = 60;
  const std::string shown(text.substr(0, kShown));
  return text.size() > kShown ? shown + "..." : shown;
}

/// The cells of a line, trimmed; each of `separators` ends one.
[[nodiscard]] inline std::vector<std::string_view> split_cells(std::string_view line,
                                                               std::string_view separators) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0;;) {
    const std::size_t stop = line.find_first_of(separators, begin);
    cells.push_back(trimmed(line.substr(begin, stop - begin)));
    if (stop == std::string_view::npos) {
      return cells;
    }
    begin = stop + 1;
  }
}

/// Whether a cell says that there is no number: empty, or `nan` as pandas and MATLAB write it.
[[nodiscard]] inline bool is_missing(std::string_view cell) {
  const std::string_view text = trimmed(cell);
  return text.empty() || text == "nan" || text == "NaN" || text == "NAN";
}

/// The number in a cell, blanks around it allowed; none where the cell is not one number.
template <class Number>
[[nodiscard]] std::optional<Number> parse_number(std::string_view cell) {
  std::string_view text = trimmed(cell);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') {
    text.remove_prefix(1);  // which `from_chars` does not know
  }
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) {
    return std::nullopt;
  }
  return number;
}

}  // namespace penduline
