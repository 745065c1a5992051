// SPDX-License-Identifier: Apache-2.0
// Paths that lose no peak, join no dropout and are no larger than an eye needs.
#include "host/plot/pen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace penduline {
namespace {

bool known(const EstimateSeries& series, std::size_t row) {
  return series.answers(row) && std::isfinite(series.x_m[row]) && std::isfinite(series.y_m[row]) &&
         std::isfinite(series.z_m[row]);
}

/// Puts first, least, largest and last of the rows `begin` to `end` into the path, each once.
void put_column(PenPath& path, const std::vector<double>& y, std::size_t begin, std::size_t end) {
  const auto first = y.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto last = y.begin() + static_cast<std::ptrdiff_t>(end);
  const auto [least, most] = std::minmax_element(first, last);
  std::array rows{first, least, most, last - 1};
  std::ranges::sort(rows);
  std::for_each(rows.begin(), std::unique(rows.begin(), rows.end()),
                [&](auto row) { path.emplace_back(row - y.begin()); });
}

}  // namespace

PenPath pen_over(const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<bool>& joined, std::size_t columns) {
  PenPath path;
  if (x.empty()) {
    return path;
  }
  const double width = (x.back() - x.front()) / static_cast<double>(columns);
  const auto column_of = [&](std::size_t row) {
    return width > 0 ? std::floor((x[row] - x.front()) / width) : 0;
  };
  for (std::size_t begin = 0; begin < x.size();) {
    if (!std::isfinite(y[begin])) {
      ++begin;
      continue;
    }
    if (!path.empty() && !(joined[begin] && std::isfinite(y[begin - 1]))) {
      path.emplace_back();
    }
    std::size_t end = begin + 1;
    while (end < x.size() && joined[end] && std::isfinite(y[end]) &&
           column_of(end) == column_of(begin)) {
      ++end;
    }
    put_column(path, y, begin, end);
    begin = end;
  }
  return path;
}

PenPath pen_through(const std::vector<double>& values, const std::vector<bool>& joined) {
  PenPath path;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!std::isfinite(values[row])) {
      continue;
    }
    if (!path.empty() && !(joined[row] && std::isfinite(values[row - 1]))) {
      path.emplace_back();
    }
    path.emplace_back(row);
  }
  return path;
}

PenPath pen_in_space(const EstimateSeries& series) {
  constexpr double kSeen = 1e-3;  // of the largest distance from the axis
  double extent_m = 0;
  for (std::size_t row = 0; row < series.size(); ++row) {
    if (known(series, row)) {
      extent_m = std::max({extent_m, std::abs(series.x_m[row]), std::abs(series.y_m[row])});
    }
  }
  const std::vector<bool> joined = joined_rows(series);
  PenPath path;
  for (std::size_t row = 0; row < series.size(); ++row) {
    if (!known(series, row)) {
      continue;
    }
    const bool follows = !path.empty() && joined[row] && known(series, row - 1);
    if (!follows && !path.empty()) {
      path.emplace_back();
    }
    const bool goes_on = row + 1 < series.size() && joined[row + 1] && known(series, row + 1);
    if (follows && goes_on) {
      const std::size_t before = *path.back();
      const double moved_m =
          std::hypot(series.x_m[row] - series.x_m[before], series.y_m[row] - series.y_m[before],
                     series.z_m[row] - series.z_m[before]);
      if (moved_m < kSeen * extent_m) {
        continue;
      }
    }
    path.emplace_back(row);
  }
  return path;
}

PenPath lone_rows(const PenPath& path) {
  PenPath alone;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool follows = i > 0 && path[i - 1];
    const bool goes_on = i + 1 < path.size() && path[i + 1];
    if (path[i] && !follows && !goes_on) {
      alone.push_back(path[i]);
    }
  }
  return alone;
}

std::vector<double> along(const PenPath& path, const std::vector<double>& values, double unit) {
  std::vector<double> result(path.size());
  std::ranges::transform(path, result.begin(), [&](const std::optional<std::size_t>& row) {
    return row ? values[*row] / unit : std::numeric_limits<double>::quiet_NaN();
  });
  return result;
}

}  // namespace penduline
