// SPDX-License-Identifier: Apache-2.0
// Tests of the responses: volts to gap and back for every model, and the flags at exact edges.
#include "common/response.hpp"

#include <array>
#include <catch2/catch.hpp>

#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

// float: the rounding of a gap of 30 mm (2e-9 m) and of a volt or two (1e-7 V), a few times.
template <class Scalar>
constexpr double kGapTolerance = tolerance<Scalar>(2e-17, 8e-9);
template <class Scalar>
constexpr double kVoltsTolerance = tolerance<Scalar>(2e-15, 1e-6);

template <class Scalar>
Response<Scalar> linear_sensor() {
  // Powers of two, so that the edges are exact: 31.25 mm at 0 V, 15.625 mm at 2 V.
  return {.model = LinearResponse<Scalar>{Scalar(0.03125), Scalar(-0.0078125)}};
}

template <class Scalar>
Response<Scalar> table_sensor() {
  constexpr std::array<Scalar, 6> kVolts = {Scalar(0.31), Scalar(0.42), Scalar(0.55),
                                            Scalar(0.8),  Scalar(1.3),  Scalar(2.1)};
  constexpr std::array<Scalar, 6> kGaps = {Scalar(0.026),  Scalar(0.020),  Scalar(0.016),
                                           Scalar(0.0115), Scalar(0.0082), Scalar(0.0031)};
  return {.model = TableResponse<Scalar>{MonotoneCubic<Scalar>(kVolts, kGaps)}};
}

template <class Scalar>
Response<Scalar> inverse_square_sensor() {
  return {.model = InverseSquareResponse<Scalar>{Scalar(2e-4), Scalar(0.004), Scalar(0.05)}};
}

template <class Scalar>
Response<Scalar> falling_polynomial_sensor() {
  return {.model = PolynomialResponse<Scalar>{
              {Scalar(0.03), Scalar(-0.012), Scalar(0.0025), Scalar(-0.0003)}, 4, 0, 2}};
}

/// As many coefficients as a polynomial may have.
template <class Scalar>
Response<Scalar> rising_polynomial_sensor() {
  return {.model = PolynomialResponse<Scalar>{{Scalar(0.001), Scalar(0.004), Scalar(0.001), 0,
                                               Scalar(0.0003), Scalar(-0.0002), 0, Scalar(0.0001)},
                                              8,
                                              0,
                                              Scalar(1.5)}};
}

template <class Scalar>
double gap_at(const Response<Scalar>& response, double volts) {
  return response.read(static_cast<Scalar>(volts)).gap_m.value();
}

template <class Scalar>
double volts_at(const Response<Scalar>& response, double gap_m) {
  return response.volts(static_cast<Scalar>(gap_m));
}

TEMPLATE_TEST_CASE("A linear sensor turns volts into gap and back", "[response]", float, double) {
  const auto sensor = linear_sensor<TestType>();
  // 0.03125 - 0.0078125 * 1.5, by hand
  CHECK(gap_at(sensor, 1.5) == 0.01953125);
  CHECK(volts_at(sensor, 0.01953125) == 1.5);
}

TEMPLATE_TEST_CASE("A table's gap is SciPy's PCHIP, and its volts are where that has the gap",
                   "[response]", float, double) {
  const auto sensor = table_sensor<TestType>();
  // p = scipy.interpolate.PchipInterpolator(volts, gaps): p(1.05)
  CHECK_THAT(gap_at(sensor, 1.05), Catch::WithinAbs(0.009619459674341687, kGapTolerance<TestType>));
  // scipy.optimize.brentq(lambda v: p(v) - 0.018, 0.31, 2.1, xtol=1e-16)
  CHECK_THAT(volts_at(sensor, 0.018),
             Catch::WithinAbs(0.47644318550120746, kVoltsTolerance<TestType>));
}

TEMPLATE_TEST_CASE("An inverse square turns volts into gap and back", "[response]", float, double) {
  const auto sensor = inverse_square_sensor<TestType>();
  // numpy.sqrt(2e-4 / (1.25 - 0.05)) - 0.004
  CHECK_THAT(gap_at(sensor, 1.25), Catch::WithinAbs(0.008909944487358056, kGapTolerance<TestType>));
  // 2e-4 / 0.024**2 + 0.05 in Python
  CHECK_THAT(volts_at(sensor, 0.02),
             Catch::WithinAbs(0.3972222222222222, kVoltsTolerance<TestType>));
}

TEMPLATE_TEST_CASE("A falling polynomial turns volts into gap and back", "[response]", float,
                   double) {
  const auto sensor = falling_polynomial_sensor<TestType>();
  // numpy.polyval([-0.0003, 0.0025, -0.012, 0.03], 1.3)
  CHECK_THAT(gap_at(sensor, 1.3), Catch::WithinAbs(0.017965899999999996, kGapTolerance<TestType>));
  // scipy.optimize.brentq(lambda v: polyval(c, v) - 0.02, 0, 2, xtol=1e-16)
  CHECK_THAT(volts_at(sensor, 0.02),
             Catch::WithinAbs(1.0254469790558371, kVoltsTolerance<TestType>));
}

TEMPLATE_TEST_CASE("A rising polynomial of eight coefficients works both ways", "[response]", float,
                   double) {
  const auto sensor = rising_polynomial_sensor<TestType>();
  // c = [1e-4, 0, -2e-4, 3e-4, 0, 1e-3, 4e-3, 1e-3]: numpy.polyval(c, 0.9); numpy.roots at 3 mm
  CHECK_THAT(gap_at(sensor, 0.9), Catch::WithinAbs(0.0055365616900000005, kGapTolerance<TestType>));
  CHECK_THAT(volts_at(sensor, 0.003),
             Catch::WithinAbs(0.4476897599574347, kVoltsTolerance<TestType>));
}

TEMPLATE_TEST_CASE("Past its range a polynomial may come back to good gaps, and is flagged",
                   "[response]", float, double) {
  // 50 - 30 V + 7.5 V^2 in mm turns round at 2 V: 2.7 V reads as 1.3 V does.
  const Response<TestType> sensor{
      .model =
          PolynomialResponse<TestType>{
              {TestType(0.05), TestType(-0.03), TestType(0.0075)}, 3, 0, TestType(1.9)},
      .nearest_m = TestType(0.020075),
      .farthest_m = TestType(0.05)};
  CHECK(sensor.read(TestType(1.3)).flags == 0);
  CHECK(sensor.read(TestType(2.7)).flags == flag::kOutOfRange);
  CHECK(sensor.read(TestType(-0.1)).flags == flag::kOutOfRange);
}

TEMPLATE_TEST_CASE("A gap that a polynomial does not reach gives the nearer end of its volts",
                   "[response]", float, double) {
  const auto sensor = falling_polynomial_sensor<TestType>();
  // It runs from 30 mm at 0 V to 13.6 mm at 2 V.
  CHECK(volts_at(sensor, 0.04) == 0);
  CHECK_THAT(volts_at(sensor, 0.01), Catch::WithinAbs(2, kVoltsTolerance<TestType>));
}

TEMPLATE_TEST_CASE("A signal at or below an inverse square's c belongs to no gap", "[response]",
                   float, double) {
  const auto sensor = inverse_square_sensor<TestType>();
  for (const TestType volts : {TestType(0.05), TestType(0.04), TestType(-1)}) {
    CAPTURE(volts);
    const GapReading<TestType> reading = sensor.read(volts);
    CHECK_FALSE(reading.gap_m.has_value());
    CHECK(reading.flags == flag::kOutOfRange);
  }
}

TEMPLATE_TEST_CASE("The faintest signal above an inverse square's c is a far gap", "[response]",
                   float, double) {
  const auto reading = inverse_square_sensor<TestType>().read(TestType(0.0501));
  REQUIRE(reading.gap_m.has_value());
  CHECK(*reading.gap_m > 1);
}

TEMPLATE_TEST_CASE("A gap at an edge of the range is in it, one beyond is not", "[response]", float,
                   double) {
  auto sensor = linear_sensor<TestType>();
  sensor.nearest_m = TestType(0.015625);    // at 2 V
  sensor.farthest_m = TestType(0.0234375);  // at 1 V
  const TestType step = TestType(1.0 / 1048576);
  CHECK(sensor.read(2).flags == 0);
  CHECK(sensor.read(2 + step).flags == flag::kOutOfRange);
  CHECK(sensor.read(1).flags == 0);
  CHECK(sensor.read(1 - step).flags == flag::kOutOfRange);
}

TEST_CASE("Out of range the model goes on", "[response]") {
  auto sensor = linear_sensor<double>();
  sensor.nearest_m = 0.015625;
  CHECK(gap_at(sensor, 3) == 0.0078125);
}

TEMPLATE_TEST_CASE("A gap a quarter beyond the peak's is not folded, one nearer is", "[response]",
                   float, double) {
  auto sensor = linear_sensor<TestType>();
  sensor.peak_m = TestType(0.015625);  // at 2 V; 1.25 of it, 0.01953125 m, is at 1.5 V
  CHECK(sensor.read(TestType(1.5)).flags == 0);
  CHECK(sensor.read(TestType(1.5 + 1.0 / 1048576)).flags == flag::kFolded);
}

TEST_CASE("A gap nearer than both the range and the peak carries both flags", "[response]") {
  auto sensor = linear_sensor<double>();
  sensor.nearest_m = 0.0234375;
  sensor.peak_m = 0.015625;
  CHECK(sensor.read(2.5).flags == (flag::kOutOfRange | flag::kFolded));
}

TEST_CASE("Where no peak is known a gap below zero is out of range but not folded", "[response]") {
  CHECK(linear_sensor<double>().read(4.5).flags == flag::kOutOfRange);
}

TEST_CASE("A response without a range takes any gap from contact on", "[response]") {
  const auto sensor = linear_sensor<double>();
  CHECK(sensor.read(4).flags == 0);
  CHECK(sensor.read(-1e6).flags == 0);
}

}  // namespace
}  // namespace penduline::test
