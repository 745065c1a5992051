// SPDX-License-Identifier: Apache-2.0
// Columns from estimates, and what holds together in them.
#include "host/plot/estimate_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/disc_plane.hpp"
#include "host/output/estimate_columns.hpp"

namespace penduline {
namespace {

Flags flags_of(const EstimateSeries& series, std::size_t row) {
  return static_cast<Flags>(series.flags[row]);
}

}  // namespace

bool EstimateSeries::answers(std::size_t row) const {
  return std::isfinite(theta1_rad[row]) && std::isfinite(theta2_rad[row]);
}

bool EstimateSeries::trusted(std::size_t row) const {
  return answers(row) && (flags_of(*this, row) & ~kHarmlessToAngles) == 0;
}

EstimateSeries EstimateSeries::between(double from_s, double to_s) const {
  const auto begin = std::ranges::lower_bound(t_s, from_s) - t_s.begin();
  const auto end = std::max(std::ranges::upper_bound(t_s, to_s) - t_s.begin(), begin);
  EstimateSeries part{.name = name, .planar = planar};
  for (const SeriesColumn& column : kSeriesColumns) {
    const std::vector<double>& values = this->*column.values;
    (part.*column.values).assign(values.begin() + begin, values.begin() + end);
  }
  return part;
}

AngleSeries EstimateSeries::angles() const {
  AngleSeries series{.planar = planar};
  for (std::size_t row = 0; row < size(); ++row) {
    if (!trusted(row)) {
      ++series.left_out;
      continue;
    }
    series.t_s.push_back(t_s[row]);
    series.theta1_rad.push_back(theta1_rad[row]);
    series.theta2_rad.push_back(theta2_rad[row]);
  }
  return series;
}

void EstimateSeries::hang_mass(double length_m) {
  for (std::size_t row = 0; row < size(); ++row) {
    const Angles<double> angles{.theta1_rad = theta1_rad[row], .theta2_rad = theta2_rad[row]};
    const Vector3<double> mass_m = length_m * DiscPlane<double>(slopes_of(angles)).rod();
    x_m[row] = mass_m.x();
    y_m[row] = mass_m.y();
    z_m[row] = mass_m.z();
  }
}

void EstimateSeries::push_back(const Estimate<double>& estimate) {
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  for (const EstimateColumn& known : estimate_columns()) {
    const auto* const column = std::ranges::find(kSeriesColumns, known.name, &SeriesColumn::name);
    if (column != kSeriesColumns.end()) {
      (this->*column->values).push_back(known.value(estimate).value_or(kNoNumber));
    }
  }
}

std::vector<bool> joined_rows(const EstimateSeries& series) {
  constexpr double kLongestStep = 1.5;  // of the usual one, as where samples count as lost
  constexpr Flags kBreaks = flag::kDropout | flag::kRestarted | flag::kOutOfOrder;
  const double usual_s = AngleSeries{.t_s = series.t_s}.period_s();
  std::vector<bool> joined(series.size());
  for (std::size_t row = 1; row < series.size(); ++row) {
    joined[row] = series.answers(row) && series.answers(row - 1) &&
                  (flags_of(series, row) & kBreaks) == 0 &&
                  series.t_s[row] - series.t_s[row - 1] < kLongestStep * usual_s;
  }
  return joined;
}

bool any_known(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return std::isfinite(value); });
}

}  // namespace penduline
