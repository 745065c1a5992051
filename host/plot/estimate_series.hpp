// SPDX-License-Identifier: Apache-2.0
// Estimates as columns of numbers over time, as figures take them.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/estimate.hpp"
#include "host/analysis/angle_series.hpp"

namespace penduline {

/// Every row of a file, at rising times; NaN where a row does not know a number.
struct EstimateSeries {
  std::string name{};   ///< what figures call it
  bool planar = false;  ///< it has one angle only, and theta2_rad is 0
  std::vector<double> t_s{};
  std::vector<double> theta1_rad{};
  std::vector<double> theta2_rad{};
  std::vector<double> x_m{};
  std::vector<double> y_m{};
  std::vector<double> z_m{};
  std::vector<double> omega1_rad_s{};
  std::vector<double> omega2_rad_s{};
  std::vector<double> sigma1_rad{};
  std::vector<double> sigma2_rad{};
  std::vector<double> flags{};

  [[nodiscard]] std::size_t size() const { return t_s.size(); }
  /// Whether a column stands for more than its place: theta2_rad of a planar series does not.
  [[nodiscard]] bool measures(std::vector<double> EstimateSeries::*column) const {
    return !planar || column != &EstimateSeries::theta2_rad;
  }
  /// Whether a row has angles.
  [[nodiscard]] bool answers(std::size_t row) const;
  /// Whether a row has angles and nothing against them.
  [[nodiscard]] bool trusted(std::size_t row) const;
  /// The rows from the moment `from_s` to `to_s`, both included.
  [[nodiscard]] EstimateSeries between(double from_s, double to_s) const;
  /// The angles that can be trusted, for an analysis.
  [[nodiscard]] AngleSeries angles() const;
  /// Puts the mass `length_m` below the pivot, in the direction that the angles give.
  void hang_mass(double length_m);

  /// Appends an estimate.
  void push_back(const Estimate<double>& estimate);
};

/// One column of a series, called as in estimates.
struct SeriesColumn {
  std::string_view name;
  std::vector<double> EstimateSeries::*values;
};

/// All of them.
inline constexpr std::array kSeriesColumns = {
    SeriesColumn{"t_s", &EstimateSeries::t_s},
    SeriesColumn{"theta1_rad", &EstimateSeries::theta1_rad},
    SeriesColumn{"theta2_rad", &EstimateSeries::theta2_rad},
    SeriesColumn{"x_m", &EstimateSeries::x_m},
    SeriesColumn{"y_m", &EstimateSeries::y_m},
    SeriesColumn{"z_m", &EstimateSeries::z_m},
    SeriesColumn{"omega1_rad_s", &EstimateSeries::omega1_rad_s},
    SeriesColumn{"omega2_rad_s", &EstimateSeries::omega2_rad_s},
    SeriesColumn{"sigma1_rad", &EstimateSeries::sigma1_rad},
    SeriesColumn{"sigma2_rad", &EstimateSeries::sigma2_rad},
    SeriesColumn{"flags", &EstimateSeries::flags},
};

/// For each row whether it follows on the one before without a break: both answer, none is lost
/// between them and the board did not start anew.
[[nodiscard]] std::vector<bool> joined_rows(const EstimateSeries& series);

/// Whether a column says anything at all.
[[nodiscard]] bool any_known(const std::vector<double>& values);

}  // namespace penduline
