// SPDX-License-Identifier: Apache-2.0
// Tests of numbers with a fixed count of decimals, against printf.
#include "host/output/fixed_decimals.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

namespace {

using penduline::append_fixed;

std::string fixed(double value, std::size_t decimals) {
  std::string text;
  append_fixed(text, value, decimals);
  return text;
}

/// printf's text, without the sign of a zero.
std::string printed(double value, std::size_t decimals) {
  std::array<char, 512> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", static_cast<int>(decimals), value);
  std::string text = buffer.data();
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  return zero && text.front() == '-' ? text.substr(1) : text;
}

TEST_CASE("Numbers have printf's decimals", "[output]") {
  for (const double value : {0.0, 1.0, 0.1, 0.123456789, 0.9999999999, 9.87654321, 12.0, 99.999999,
                             1e-9, 4.9e-10, 1e-300, 123456.789012345, 3.141592653589793}) {
    for (std::size_t decimals = 0; decimals <= 9; ++decimals) {
      CAPTURE(value, decimals);
      CHECK(fixed(value, decimals) == printed(value, decimals));
      CHECK(fixed(-value, decimals) == printed(-value, decimals));
    }
  }
}

TEST_CASE("What rounds to zero has no sign", "[output]") {
  CHECK(fixed(-0.0, 3) == "0.000");
  CHECK(fixed(-0.0004, 3) == "0.000");
  CHECK(fixed(-0.4, 0) == "0");
}

TEST_CASE("What rounds up to a power of ten has its extra digit", "[output]") {
  CHECK(fixed(9.9996, 3) == "10.000");
  CHECK(fixed(-0.99996, 4) == "-1.0000");
  CHECK(fixed(0.96, 1) == "1.0");
}

TEST_CASE("A tie rounds away from zero", "[output]") {
  // Exact in binary. printf goes to even here.
  CHECK(fixed(0.5, 0) == "1");
  CHECK(fixed(2.5, 0) == "3");
  CHECK(fixed(-0.125, 2) == "-0.13");
}

TEST_CASE("Whole numbers are exact up to 2^53", "[output]") {
  CHECK(fixed(9007199254740992.0, 0) == "9007199254740992");
  CHECK(fixed(-9007199254740991.0, 0) == "-9007199254740991");
}

TEST_CASE("Numbers too large for 64-bit arithmetic are printf's", "[output]") {
  for (const double value :
       {9e18, 1e19, 1.8446744073709552e19, 1e22, 1e300, std::numeric_limits<double>::max()}) {
    for (const std::size_t decimals : {0U, 6U, 9U}) {
      CAPTURE(value, decimals);
      CHECK(fixed(value, decimals) == printed(value, decimals));
      CHECK(fixed(-value, decimals) == printed(-value, decimals));
    }
  }
}

TEST_CASE("On both sides of the change of method the text is a number of the right size",
          "[output]") {
  const double edge = 9e18 / 1e9;
  for (const double value : {std::nextafter(edge, 0.0), edge, std::nextafter(edge, 1e300)}) {
    CAPTURE(value);
    CHECK(std::strtod(fixed(value, 9).c_str(), nullptr) == Approx(value).epsilon(1e-15));
  }
}

TEST_CASE("The text is appended", "[output]") {
  std::string text = "t=";
  append_fixed(text, 1.25, 2);
  CHECK(text == "t=1.25");
}

TEST_CASE("Angles at random are printf's to the last digit", "[output]") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-3.2, 3.2);
  for (int i = 0; i < 200'000; ++i) {
    const double value = angle(random);
    // A tie to within the product's own rounding may go either way; there are none here.
    REQUIRE(fixed(value, 9) == printed(value, 9));
  }
}

TEST_CASE("Any double is written within half a unit of its last digit, and its rounding",
          "[output]") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-12, 20);
  std::uniform_int_distribution<std::size_t> places(0, 9);
  for (int i = 0; i < 200'000; ++i) {
    const double value = std::pow(10, exponent(random)) * (i % 2 == 0 ? 1 : -1);
    const std::size_t decimals = places(random);
    const double half = 0.5 * std::pow(10, -static_cast<double>(decimals));
    const double ulp = std::nextafter(std::abs(value), 1e300) - std::abs(value);
    const double error = std::strtod(fixed(value, decimals).c_str(), nullptr) - value;
    CAPTURE(value, decimals, fixed(value, decimals));
    // The product with the scale and strtod each round, too.
    REQUIRE(std::abs(error) <= half * (1 + 1e-9) + 2 * ulp);
  }
}

TEST_CASE("Every text has as many digits behind the point as asked for", "[output]") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-15, 20);
  for (int i = 0; i < 20'000; ++i) {
    const double value = std::pow(10, exponent(random));
    for (std::size_t decimals = 1; decimals <= 9; ++decimals) {
      const std::string text = fixed(value, decimals);
      CAPTURE(value, text);
      REQUIRE(text.size() - text.find('.') - 1 == decimals);
      REQUIRE(text.find('.') >= 1);
    }
  }
}

}  // namespace
