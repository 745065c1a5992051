// SPDX-License-Identifier: Apache-2.0
// The report on the standard output.
#include "host/calibration/calibration_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace penduline {
namespace {

/// "-0.93 Sx b_m": the other number that it goes with most.
std::string strongest_correlation(const CalibrationRecord& record, Eigen::Index number) {
  const Eigen::MatrixXd& covariance = record.covariance;
  double strongest = 0;
  Eigen::Index with = number;
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    const double product = covariance(number, number) * covariance(i, i);
    const double correlation = product > 0 ? covariance(number, i) / std::sqrt(product) : 0;
    if (i != number && std::abs(correlation) > std::abs(strongest)) {
      strongest = correlation;
      with = i;
    }
  }
  return with == number ? "-"
                        : fmt::format("{:+.2f} {}", strongest,
                                      record.parameters[static_cast<std::size_t>(with)]);
}

}  // namespace

std::string report_of(const Calibration& calibration) {
  constexpr double kMicro = 1e-6;
  const CalibrationRecord& record = calibration.record;
  std::string text = fmt::format("calibration: {}, residual {:.1f} um RMS of the gaps\n",
                                 record.method, record.residual_m / kMicro);
  for (const std::string& note : calibration.notes) {
    text += "  " + note + '\n';
  }
  std::size_t width = 0;
  for (const std::string& name : record.parameters) {
    width = std::max(width, name.size());
  }
  text += fmt::format("\n{:<{}}  {:>13}  {:>10}  {}\n", "number", width, "value", "sigma",
                      "strongest correlation");
  for (std::size_t i = 0; i < record.parameters.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    text += fmt::format("{:<{}}  {:>13.6g}  {:>10.2g}  {}\n", record.parameters[i], width,
                        record.values[at], std::sqrt(record.covariance(at, at)),
                        strongest_correlation(record, at));
  }
  return text;
}

}  // namespace penduline
