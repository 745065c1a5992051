// SPDX-License-Identifier: Apache-2.0
// Tests of estimates as text: design.md's columns, whole and empty cells, JSON lines.
#include "host/output/estimate_writer.hpp"

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "host/output/estimate_columns.hpp"

namespace {

using namespace penduline;

/// design.md, "Estimate".
constexpr std::string_view kDesignColumns =
    "t_s,seq,theta1_rad,theta2_rad,x_m,y_m,z_m,omega1_rad_s,omega2_rad_s,sigma1_rad,sigma2_rad,"
    "residual_m,flags";

/// An estimate that knows everything, each number another.
Estimate<double> whole_estimate() {
  return {.t_us = 1'234'567,
          .seq = 42,
          .attitude = {{.angles = {0.1, -0.2}, .mass_m = {0.06, 0.03, -0.29}}},
          .omega_rad_s = {{1.5, -2.5}},
          .sigma_rad = {{0.001, 0.002}},
          .residual_m = 0.0000125,
          .flags = flag::kSaturated | flag::kDropout};
}

Estimate<double> empty_estimate() {
  return {.t_us = -325'000, .seq = 0, .flags = flag::kFilling};
}

std::string head(EstimateFormat format) {
  std::string text;
  append_estimate_head(text, {.format = format});
  return text;
}

std::string row(const Estimate<double>& estimate, EstimateFormat format) {
  std::string text;
  append_estimate_row(text, estimate, {.format = format});
  return text;
}

TEST_CASE("The CSV head is design.md's list of columns", "[output]") {
  CHECK(head(EstimateFormat::kCsv) == fmt::format("{}\n", kDesignColumns));
}

TEST_CASE("JSON lines have no head", "[output]") {
  CHECK(head(EstimateFormat::kJsonLines).empty());
}

TEST_CASE("Every column says what it means", "[output]") {
  for (const EstimateColumn& column : estimate_columns()) {
    CHECK_FALSE(column.meaning.empty());
  }
}

TEST_CASE("A whole estimate fills every cell", "[output]") {
  CHECK(row(whole_estimate(), EstimateFormat::kCsv) ==
        "1.234567,42,0.100000000,-0.200000000,0.060000000,0.030000000,-0.290000000,1.500000000,"
        "-2.500000000,0.001000000,0.002000000,0.000012500,257\n");
}

TEST_CASE("Absolute time is a last column on request, empty where it is not known", "[output]") {
  const EstimateLayout layout{.utc = true};
  std::string text;
  append_estimate_head(text, layout);
  CHECK(text == fmt::format("{},utc_s\n", kDesignColumns));
  Estimate<double> estimate = empty_estimate();
  const auto dated = [&] {
    std::string line;
    append_estimate_row(line, estimate, layout);
    return line;
  };
  CHECK(dated() == "-0.325000,0,,,,,,,,,,,2048,\n");
  estimate.utc_us = 1'795'275'130'762'653;
  CHECK(dated() == "-0.325000,0,,,,,,,,,,,2048,1795275130.762653\n");
  CHECK(row(estimate, EstimateFormat::kCsv) == "-0.325000,0,,,,,,,,,,,2048\n");
}

TEST_CASE("What an estimate does not have is an empty cell", "[output]") {
  CHECK(row(empty_estimate(), EstimateFormat::kCsv) == "-0.325000,0,,,,,,,,,,,2048\n");
}

TEST_CASE("An estimate may have angles and nothing else", "[output]") {
  Estimate<double> estimate = whole_estimate();
  estimate.omega_rad_s.reset();
  estimate.sigma_rad.reset();
  estimate.residual_m.reset();
  CHECK(row(estimate, EstimateFormat::kCsv) ==
        "1.234567,42,0.100000000,-0.200000000,0.060000000,0.030000000,-0.290000000,,,,,,257\n");
}

TEST_CASE("A whole estimate as a JSON line has the columns' names and values", "[output]") {
  const std::string line = row(whole_estimate(), EstimateFormat::kJsonLines);
  CHECK(line.back() == '\n');
  CHECK(line.find('\n') == line.size() - 1);
  CHECK(nlohmann::ordered_json::parse(line) == nlohmann::ordered_json({{"t_s", 1.234567},
                                                                       {"seq", 42},
                                                                       {"theta1_rad", 0.1},
                                                                       {"theta2_rad", -0.2},
                                                                       {"x_m", 0.06},
                                                                       {"y_m", 0.03},
                                                                       {"z_m", -0.29},
                                                                       {"omega1_rad_s", 1.5},
                                                                       {"omega2_rad_s", -2.5},
                                                                       {"sigma1_rad", 0.001},
                                                                       {"sigma2_rad", 0.002},
                                                                       {"residual_m", 0.0000125},
                                                                       {"flags", 257}}));
}

TEST_CASE("What an estimate does not have is null in JSON", "[output]") {
  const auto json =
      nlohmann::ordered_json::parse(row(empty_estimate(), EstimateFormat::kJsonLines));
  for (const EstimateColumn& column : estimate_columns()) {
    const std::string name(column.name);
    CAPTURE(name);
    REQUIRE(json.contains(name));
    CHECK(json[name].is_null() == (name != "t_s" && name != "seq" && name != "flags"));
  }
}

TEST_CASE("JSON lines and CSV have the same names in the same order", "[output]") {
  const auto json =
      nlohmann::ordered_json::parse(row(empty_estimate(), EstimateFormat::kJsonLines));
  std::string names;
  for (const auto& [name, value] : json.items()) {
    names += (names.empty() ? "" : ",") + name;
  }
  CHECK(names == kDesignColumns);
}

TEST_CASE("seq and flags are whole numbers in JSON", "[output]") {
  const auto json =
      nlohmann::ordered_json::parse(row(whole_estimate(), EstimateFormat::kJsonLines));
  CHECK(json["seq"].is_number_integer());
  CHECK(json["flags"].is_number_integer());
}

TEST_CASE("Every microsecond of a year is written", "[output]") {
  constexpr std::int64_t kYear_us = 31'557'600'000'000;
  for (const std::int64_t t_us : {kYear_us, kYear_us + 1, kYear_us - 1, std::int64_t{1},
                                  std::int64_t{-1}, std::int64_t{999'999}}) {
    const std::string text = row({.t_us = t_us}, EstimateFormat::kCsv);
    CAPTURE(t_us, text);
    // The digits without the point are the microseconds.
    std::string digits = text.substr(0, text.find(','));
    digits.erase(digits.find('.'), 1);
    CHECK(std::stoll(digits) == t_us);
  }
}

TEST_CASE("The largest seq of a recording and the largest flags are written in full", "[output]") {
  // RFC 7493's largest integer: every reader of JSON keeps it exactly.
  const std::string text = row(
      {.seq = 9007199254740991, .flags = std::numeric_limits<Flags>::max()}, EstimateFormat::kCsv);
  CHECK(text == "0.000000,9007199254740991,,,,,,,,,,,4294967295\n");
}

TEST_CASE("A message is the JSON line with a timestamp before it and no line's end", "[output]") {
  std::string message;
  append_estimate_message(message, whole_estimate(), 1795275130.7626534);
  std::string expected = row(whole_estimate(), EstimateFormat::kJsonLines);
  expected.replace(0, 1, "{\"timestamp\":1795275130.762653,");
  expected.pop_back();
  CHECK(message == expected);
}

TEST_CASE("Rows are appended behind what is there", "[output]") {
  std::string text = "before\n";
  append_estimate_row(text, empty_estimate(), {});
  CHECK(text == "before\n-0.325000,0,,,,,,,,,,,2048\n");
}

}  // namespace
