// SPDX-License-Identifier: Apache-2.0
// Central differences.
#include "host/plot/rates.hpp"

#include <cstddef>
#include <limits>

namespace penduline {

std::vector<double> central_differences(const EstimateSeries& series,
                                        const std::vector<double>& values) {
  const std::vector<bool> joined = joined_rows(series);
  std::vector<double> rates(series.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 1; row + 1 < series.size(); ++row) {
    if (joined[row] && joined[row + 1]) {
      rates[row] =
          (values[row + 1] - values[row - 1]) / (series.t_s[row + 1] - series.t_s[row - 1]);
    }
  }
  return rates;
}

}  // namespace penduline
