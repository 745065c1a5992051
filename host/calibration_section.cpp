// SPDX-License-Identifier: Apache-2.0
// The section [calibration], read and written.
#include "host/calibration_section.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "hal/replay/cells.hpp"
#include "hal/replay/toml_text.hpp"
#include "hal/replay/utc_text.hpp"

namespace penduline {
namespace {

constexpr std::size_t kMostParameters = 256;  // their covariance is as many squared

std::vector<std::string> read_texts(const toml::table& table, std::string_view key,
                                    TomlSection& section) {
  std::vector<std::string> texts;
  const toml::array* array = section.has(key) ? table[key].as_array() : nullptr;
  bool good = array != nullptr;
  if (good) {
    for (const toml::node& element : *array) {
      good = good && element.is_string();
      texts.push_back(element.value_or(std::string()));
    }
  }
  if (!good) {
    section.fail(key, "expected an array of texts in quotes");
  }
  return texts;
}

std::string read_date(const toml::table& table, TomlSection& section) {
  const toml::date_time* date = section.has("date") && table["date"].is_date_time()
                                    ? &table["date"].as_date_time()->get()
                                    : nullptr;
  if (date == nullptr) {
    section.fail("date", "expected a time such as 2026-11-21T07:00:00Z");
    return {};
  }
  return utc_text_s(utc_us_of(*date));
}

/// A covariance of `count` numbers: square, symmetric, nothing below 0 on its diagonal.
Eigen::MatrixXd read_covariance(const toml::table& table, std::size_t count, TomlSection& section) {
  const auto size = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  const toml::array* rows = section.has("covariance") ? table["covariance"].as_array() : nullptr;
  bool good = rows != nullptr && rows->size() == count;
  for (std::size_t i = 0; good && i < count; ++i) {
    const toml::array* row = (*rows)[i].as_array();
    good = row != nullptr && row->size() == count;
    for (std::size_t j = 0; good && j < count; ++j) {
      const auto value = (*row)[j].value<double>();
      good = value && std::isfinite(*value);
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = value.value_or(0);
    }
  }
  good = good && (count == 0 || matrix.diagonal().minCoeff() >= 0) &&
         matrix.isApprox(matrix.transpose(), 1e-5);
  if (!good) {
    section.fail("covariance",
                 fmt::format("expected {0} rows of {0} numbers, as many as parameters, the same "
                             "above the diagonal as below it",
                             count));
  }
  return matrix;
}

toml::array texts_of(const std::vector<std::string>& texts) {
  toml::array array;
  for (const std::string& text : texts) {
    array.push_back(text);
  }
  return array;
}

}  // namespace

double rounded(double value, int digits) {
  return std::isfinite(value)
             ? parse_number<double>(fmt::format("{:.{}e}", value, digits - 1)).value_or(value)
             : value;
}

CalibrationRecord read_calibration(const toml::table& table, TomlFindings& findings) {
  TomlSection section(table, "[calibration]", findings);
  CalibrationRecord record;
  record.method = section.text("method", "a name in quotes");
  if (std::ranges::find(kCalibrationMethods, record.method) == kCalibrationMethods.end()) {
    section.fail("method", fmt::format("found \"{}\", expected \"{}\"", record.method,
                                       fmt::join(kCalibrationMethods, "\", \"")));
  }
  record.date = read_date(table, section);
  record.recordings = read_texts(table, "recordings", section);
  record.residual_m = section.number("residual_m", kNotNegative);
  record.parameters = read_texts(table, "parameters", section);
  if (record.parameters.size() > kMostParameters) {
    section.fail("parameters", fmt::format("found {}, expected {} at most",
                                           record.parameters.size(), kMostParameters));
    return record;
  }
  const std::size_t count = record.parameters.size();
  const std::vector<double> values = section.numbers("values", count, count);
  record.values = Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
  record.covariance = read_covariance(table, count, section);
  const std::vector<double> sigmas = section.numbers("sigmas", count, count);
  for (std::size_t i = 0; i < count && !findings.error; ++i) {
    const double variance =
        record.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
    if (!(std::abs(sigmas[i] * sigmas[i] - variance) <= 1e-4 * variance)) {
      section.fail("sigmas", fmt::format("found {} for {}, expected the root of the covariance's "
                                         "diagonal, {}",
                                         sigmas[i], record.parameters[i], std::sqrt(variance)));
    }
  }
  if (section.has("not_determined")) {
    record.not_determined = read_texts(table, "not_determined", section);
  }
  section.complain_of_unknown_keys();
  return record;
}

toml::table calibration_table(const CalibrationRecord& record) {
  toml::array covariance;
  for (Eigen::Index i = 0; i < record.covariance.rows(); ++i) {
    covariance.push_back(rounded_numbers(record.covariance.row(i)));
  }
  toml::table table;
  table.insert("method", record.method);
  std::istringstream date("date = " + record.date);
  table.insert("date", *toml::parse(date)["date"].node());
  table.insert("recordings", texts_of(record.recordings));
  table.insert("residual_m", rounded(record.residual_m));
  table.insert("parameters", texts_of(record.parameters));
  table.insert("values", rounded_numbers(record.values));
  table.insert("sigmas", rounded_numbers(record.covariance.diagonal().cwiseSqrt()));
  table.insert("covariance", std::move(covariance));
  if (!record.not_determined.empty()) {
    table.insert("not_determined", texts_of(record.not_determined));
  }
  return table;
}

}  // namespace penduline
