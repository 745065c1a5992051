// SPDX-License-Identifier: Apache-2.0
// Which rows a line goes through, and where its pen is lifted.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/plot/estimate_series.hpp"

namespace penduline {

/// Rows in order; none: the pen is lifted.
using PenPath = std::vector<std::optional<std::size_t>>;

/// A path over `x`, which rises, for an eye that sees `columns` of them: in each the first, the
/// last, the least and the largest of `y`. It breaks where a row is not `joined` to the one before
/// and over rows that are not finite.
[[nodiscard]] PenPath pen_over(const std::vector<double>& x, const std::vector<double>& y,
                               const std::vector<bool>& joined, std::size_t columns = 2000);

/// A path through all rows, which breaks as that of `pen_over` does.
[[nodiscard]] PenPath pen_through(const std::vector<double>& values,
                                  const std::vector<bool>& joined);

/// The mass's path, but for rows that are nearer to the one before than an eye sees.
[[nodiscard]] PenPath pen_in_space(const EstimateSeries& series);

/// The rows of a path between two lifts of the pen, which a line would not show.
[[nodiscard]] PenPath lone_rows(const PenPath& path);

/// Along a path, values in `unit`; NaN where the pen is lifted.
[[nodiscard]] std::vector<double> along(const PenPath& path, const std::vector<double>& values,
                                        double unit = 1);

}  // namespace penduline
