// SPDX-License-Identifier: Apache-2.0
// The section [calibration] of a rig file: where its numbers come from and how well they are known.
#pragma once

#include <toml++/toml.h>
#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "host/toml_section.hpp"

namespace penduline {

/// What a calibration says of itself.
struct CalibrationRecord {
  std::string method;  ///< one of kCalibrationMethods
  std::string date;    ///< "2026-11-21T07:00:00Z"
  std::vector<std::string> recordings;
  double residual_m = 0;                    ///< RMS misfit of the gaps
  std::vector<std::string> parameters;      ///< what was fitted, each with its unit
  Eigen::VectorXd values;                   ///< in the parameters' order
  Eigen::MatrixXd covariance;               ///< of `values`
  std::vector<std::string> not_determined;  ///< what the data did not tell: it stayed as it was
};

inline constexpr std::array<std::string_view, 4> kCalibrationMethods = {"static", "rest", "swing",
                                                                        "geometry"};

/// Reads the section and checks that its arrays go with each other.
[[nodiscard]] CalibrationRecord read_calibration(const toml::table& table, TomlFindings& findings);

/// The section as a table, numbers to six digits.
[[nodiscard]] toml::table calibration_table(const CalibrationRecord& record);

/// A number to as many significant digits: what is beyond no sensor knows, nobody reads.
[[nodiscard]] double rounded(double value, int digits = 6);

/// Numbers as a TOML array, each rounded so.
template <class Numbers>
[[nodiscard]] toml::array rounded_numbers(const Numbers& numbers) {
  toml::array array;
  for (const double number : numbers) {
    array.push_back(rounded(number));
  }
  return array;
}

}  // namespace penduline
