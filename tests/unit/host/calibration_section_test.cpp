// SPDX-License-Identifier: Apache-2.0
#include "host/calibration_section.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "host/rig_file.hpp"
#include "tests/unit/host/rig_text.hpp"

using namespace penduline;
using namespace penduline::test;

namespace {

/// A rig with the section, whose header is on line 20 and whose keys follow on 21 to 28.
std::string error_with(const std::string& replaced, const std::string& by) {
  std::string section =
      "[calibration]\n"
      "method = \"swing\"\n"
      "date = 2026-11-21T07:00:00Z\n"
      "recordings = [\"a.csv\"]\n"
      "residual_m = 1e-5\n"
      "parameters = [\"a\", \"b\"]\n"
      "values = [1.0, 2.0]\n"
      "sigmas = [0.1, 0.2]\n"
      "covariance = [[0.01, 0.001], [0.001, 0.04]]\n";
  if (!replaced.empty()) {
    section.replace(section.find(replaced), replaced.size(), by);
  }
  return rig_error(std::string(kRigText) + section);
}

}  // namespace

TEST_CASE("A sound record is read without a word", "[calibration]") {
  CHECK(error_with("", "").empty());
}

TEST_CASE("A record of an unknown method is refused", "[calibration]") {
  CHECK(error_with("swing", "guess") ==
        "rig.toml:21: [calibration] method: found \"guess\", expected \"static\", \"rest\", "
        "\"swing\", \"geometry\"");
}

TEST_CASE("A record's date must be one", "[calibration]") {
  CHECK(error_with("2026-11-21T07:00:00Z", "\"today\"") ==
        "rig.toml:22: [calibration] date: expected a time such as 2026-11-21T07:00:00Z");
}

TEST_CASE("A record's arrays must go with each other", "[calibration]") {
  CHECK(error_with("[1.0, 2.0]", "[1.0]") ==
        "rig.toml:26: [calibration] values: found [ 1.0 ], expected an array of 2 numbers");
  CHECK(error_with("[0.001, 0.04]", "[0.002, 0.04]") ==
        "rig.toml:28: [calibration] covariance: expected 2 rows of 2 numbers, as many as "
        "parameters, the same above the diagonal as below it");
  CHECK(error_with("[0.1, 0.2]", "[0.1, 0.3]") ==
        "rig.toml:27: [calibration] sigmas: found 0.3 for b, expected the root of the "
        "covariance's diagonal, 0.2");
}

TEST_CASE("A record of more parameters than any calibration has is refused", "[calibration]") {
  std::string many = "[\"a\"";
  for (int i = 0; i < 256; ++i) {
    many += ", \"a\"";
  }
  CHECK(error_with("[\"a\", \"b\"]", many + "]") ==
        "rig.toml:25: [calibration] parameters: found 257, expected 256 at most");
}

TEST_CASE("A number is rounded to its significant digits", "[calibration]") {
  CHECK(rounded(0.0123456789) == 0.0123457);
  CHECK(rounded(-98765.4321, 3) == -98800);
  CHECK(rounded(0) == 0);
}
