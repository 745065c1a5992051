// SPDX-License-Identifier: Apache-2.0
// Columns of numbers with the decimals that a sensor's noise leaves to be of use.
#include "host/web/live_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host/output/fixed_decimals.hpp"

namespace penduline {
namespace {

constexpr std::size_t kTimeDecimals = 6;
constexpr std::size_t kAngleDecimals = 6;   // a thousandth of the best sigma
constexpr std::size_t kLengthDecimals = 6;  // a micrometre
constexpr std::size_t kVoltDecimals = 5;    // a count of 16 bits is 50 uV

void append_number(std::string& text, double value, std::size_t decimals) {
  if (std::isfinite(value)) {
    append_fixed(text, value, decimals);
  } else {
    text += "null";
  }
}

/// Appends a list of what `cell` appends of each row.
template <class Cell>
void append_list(std::string& text, const std::deque<LiveRow>::const_iterator& begin,
                 const std::deque<LiveRow>::const_iterator& end, const Cell& cell) {
  text += '[';
  for (auto row = begin; row != end; ++row) {
    cell(*row);
    text += ',';
  }
  if (text.back() == ',') {
    text.pop_back();
  }
  text += ']';
}

}  // namespace

void LivePoints::add(const LiveRow& row) {
  rows_.push_back(row);
  ++end_;
  while (rows_.size() > kMostRows || rows_.front().t_s < row.t_s - kKeptS) {
    rows_.pop_front();
  }
}

std::string LivePoints::json(std::uint64_t from) const {
  const auto wanted =
      static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(end_ - from, rows_.size()));
  return json(rows_.end() - wanted, rows_.end());
}

std::vector<std::string> LivePoints::slices() const {
  std::vector<std::string> slices;
  auto begin = rows_.begin();
  do {
    const auto end = std::find_if(
        begin, rows_.end(), [&](const LiveRow& row) { return row.t_s >= begin->t_s + kSliceS; });
    slices.push_back(json(begin, end));
    begin = end;
  } while (begin != rows_.end());
  return slices;
}

std::string LivePoints::json(Row begin, Row end) const {
  std::string text = "{";
  const auto column = [&](const char* name, std::size_t decimals, double LiveRow::*member) {
    fmt::format_to(std::back_inserter(text), "{}\"{}\":", text.size() > 1 ? "," : "", name);
    append_list(text, begin, end,
                [&](const LiveRow& row) { append_number(text, row.*member, decimals); });
  };
  const auto columns = [&](const char* name, std::size_t decimals,
                           std::array<double, kMaxSensors> LiveRow::*member) {
    fmt::format_to(std::back_inserter(text), ",\"{}\":[", name);
    for (std::size_t i = 0; i < sensors_; ++i) {
      text += i > 0 ? "," : "";
      append_list(text, begin, end,
                  [&](const LiveRow& row) { append_number(text, (row.*member)[i], decimals); });
    }
    text += ']';
  };
  column("t_s", kTimeDecimals, &LiveRow::t_s);
  column("theta1_rad", kAngleDecimals, &LiveRow::theta1_rad);
  column("theta2_rad", kAngleDecimals, &LiveRow::theta2_rad);
  column("sigma1_rad", kAngleDecimals, &LiveRow::sigma1_rad);
  column("sigma2_rad", kAngleDecimals, &LiveRow::sigma2_rad);
  column("x_m", kLengthDecimals, &LiveRow::x_m);
  column("y_m", kLengthDecimals, &LiveRow::y_m);
  column("z_m", kLengthDecimals, &LiveRow::z_m);
  columns("signal_v", kVoltDecimals, &LiveRow::signal_v);
  columns("gap_m", kLengthDecimals, &LiveRow::gap_m);
  text += ",\"flags\":";
  append_list(text, begin, end, [&](const LiveRow& row) {
    fmt::format_to(std::back_inserter(text), "{}", row.flags);
  });
  text += '}';
  return text;
}

}  // namespace penduline
