// SPDX-License-Identifier: Apache-2.0
// Columns to bytes, bytes to text.
#include "host/report/report_points.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <string_view>
#include <vector>

#include "host/report/base64.hpp"

namespace penduline {
namespace {

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

/// `value` of each row, in quotes.
template <class Number, class Value>
void append_column(std::string& text, std::span<const LiveRow> rows, const Value& value) {
  std::vector<Number> numbers;
  numbers.reserve(rows.size());
  for (const LiveRow& row : rows) {
    numbers.push_back(static_cast<Number>(value(row)));
  }
  const auto bytes = std::as_bytes(std::span(numbers));
  text += '"';
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes are what is wanted
  append_base64(text, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  text += '"';
}

/// One column a sensor, in an array.
template <class Values>
void append_columns(std::string& text, std::span<const LiveRow> rows, std::size_t sensors,
                    const Values& values) {
  text += '[';
  for (std::size_t i = 0; i < sensors; ++i) {
    text += i > 0 ? "," : "";
    append_column<float>(text, rows, [&](const LiveRow& row) { return (row.*values)[i]; });
  }
  text += ']';
}

}  // namespace

std::string report_points(std::span<const LiveRow> rows, std::size_t sensors) {
  std::string text = "{\"t_s\":";
  append_column<double>(text, rows, [](const LiveRow& row) { return row.t_s; });
  struct NumberColumn {
    std::string_view name;
    double LiveRow::*member;
  };
  constexpr std::array kNumbers = {NumberColumn{"theta1_rad", &LiveRow::theta1_rad},
                                   NumberColumn{"theta2_rad", &LiveRow::theta2_rad},
                                   NumberColumn{"sigma1_rad", &LiveRow::sigma1_rad},
                                   NumberColumn{"sigma2_rad", &LiveRow::sigma2_rad},
                                   NumberColumn{"x_m", &LiveRow::x_m},
                                   NumberColumn{"y_m", &LiveRow::y_m},
                                   NumberColumn{"z_m", &LiveRow::z_m}};
  for (const NumberColumn& column : kNumbers) {
    text.append(",\"").append(column.name).append("\":");
    append_column<float>(text, rows, [&](const LiveRow& row) { return row.*column.member; });
  }
  text += ",\"signal_v\":";
  append_columns(text, rows, sensors, &LiveRow::signal_v);
  text += ",\"gap_m\":";
  append_columns(text, rows, sensors, &LiveRow::gap_m);
  text += ",\"flags\":";
  append_column<std::uint32_t>(text, rows, [](const LiveRow& row) { return row.flags; });
  return text + '}';
}

}  // namespace penduline
