// SPDX-License-Identifier: Apache-2.0
#include "host/calibration/response_fit.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace penduline;

namespace {

/// The share of its strongest signal that a TCRT5000 has at a gap in mm: Vishay data sheet 83760,
/// figure 9.
constexpr std::array<std::pair<double, double>, 13> kDataSheet = {{{0.5, 0.641},
                                                                   {1, 0.833},
                                                                   {2, 0.991},
                                                                   {2.36, 1},
                                                                   {3, 0.976},
                                                                   {4, 0.889},
                                                                   {5, 0.776},
                                                                   {6, 0.663},
                                                                   {8, 0.480},
                                                                   {10, 0.355},
                                                                   {12, 0.269},
                                                                   {14, 0.217},
                                                                   {15, 0.199}}};

std::vector<SensorPoint> data_sheet_points(double nearest_mm = 0) {
  std::vector<SensorPoint> points;
  for (const auto& [gap_mm, share] : kDataSheet) {
    if (gap_mm >= nearest_mm) {
      points.push_back({.place = "points.csv:2",
                        .gap_m = gap_mm * 1e-3,
                        .volts = 1.9 * share,
                        .standard_error_v = 1e-4});
    }
  }
  return points;
}

template <class Signal>
std::vector<SensorPoint> points_of(Signal signal, int count = 12) {
  std::vector<SensorPoint> points;
  for (int i = 0; i < count; ++i) {
    const double gap_m = 0.004 + 0.001 * i;
    points.push_back({.place = "points.csv:2",
                      .gap_m = gap_m,
                      .volts = signal(gap_m),
                      .standard_error_v = 1e-4});
  }
  return points;
}

std::string error_of(const std::vector<SensorPoint>& points, ResponseModel model) {
  const auto fit = fit_response(points, model, {}, "Sx");
  return fit ? "" : fit.error().message;
}

}  // namespace

TEST_CASE("A table goes through a data sheet's points beyond the peak", "[calibration]") {
  const auto fit = fit_response(data_sheet_points(3), ResponseModel::kTable, {}, "Sx");
  REQUIRE(fit);
  INFO(fit->names.size());
  CHECK(fit->response.nearest_m == Approx(0.003));
  CHECK(fit->response.farthest_m == Approx(0.015));
  for (const SensorPoint& point : data_sheet_points(3)) {
    CHECK(std::abs(*fit->response.read(point.volts).gap_m - point.gap_m) < 60e-6);
  }
}

TEST_CASE("Points in the fold are left out, counted and said, and the peak is kept",
          "[calibration]") {
  const auto fit = fit_response(data_sheet_points(), ResponseModel::kTable, {}, "Sx");
  REQUIRE(fit);
  // 1.25 times 2.36 mm are 2.95: the points at 0.5, 1, 2 and 2.36 mm.
  CHECK(fit->left_out == 4);
  CHECK(fit->response.peak_m == Approx(0.00236));
  CHECK(fit->response.nearest_m == Approx(0.003));
  REQUIRE(fit->warnings.size() == 1);
  CHECK(fit->warnings[0] ==
        "sensor Sx: 4 of 13 points are nearer than 2.95 mm and left out: the signal folds back at "
        "its peak at 2.36 mm, where two gaps give one signal");
}

TEST_CASE("The rig's own peak counts where no point is nearer than it", "[calibration]") {
  const Response<double> start{.model = {}, .peak_m = 0.0036};
  const auto fit = fit_response(data_sheet_points(3), ResponseModel::kTable, start, "Sx");
  REQUIRE(fit);
  CHECK(fit->left_out == 2);  // those at 3 and 4 mm, 4.5 being the nearest readable
}

TEST_CASE("An inverse square's numbers come back from its points", "[calibration]") {
  const auto points =
      points_of([](double gap_m) { return 1e-4 / std::pow(gap_m + 0.004, 2) + 0.05; });
  const auto fit = fit_response(points, ResponseModel::kInverseSquare, {}, "Sx");
  REQUIRE(fit);
  const auto& model = std::get<InverseSquareResponse<double>>(fit->response.model);
  CHECK(model.a_v_m2 == Approx(1e-4).epsilon(1e-4));
  CHECK(model.b_m == Approx(0.004).epsilon(1e-3));
  CHECK(model.c_v == Approx(0.05).epsilon(1e-3));
}

TEST_CASE("A line and a polynomial come back from their points", "[calibration]") {
  const auto line = fit_response(points_of([](double gap_m) { return (0.02 - gap_m) / 0.006; }),
                                 ResponseModel::kLinear, {}, "Sx");
  REQUIRE(line);
  const auto& linear = std::get<LinearResponse<double>>(line->response.model);
  CHECK(linear.gap_at_zero_m == Approx(0.02));
  CHECK(linear.slope_m_per_v == Approx(-0.006));
  // gap = 0.02 - 0.012 v + 0.002 v^2, solved for v.
  const auto bent =
      fit_response(points_of([](double gap_m) {
                     return (0.012 - std::sqrt(1.44e-4 - 0.008 * (0.02 - gap_m))) / 0.004;
                   }),
                   ResponseModel::kPolynomial, {}, "Sx");
  REQUIRE(bent);
  CHECK(*bent->response.read(0.8).gap_m == Approx(0.02 - 0.0096 + 0.00128));
}

TEST_CASE("A response is refused where its points are too few or too near each other",
          "[calibration]") {
  const auto falling = [](double gap_m) { return 0.01 / gap_m; };
  CHECK(error_of({}, ResponseModel::kTable) == "sensor Sx: found no points of it");
  CHECK(error_of(points_of(falling, 4), ResponseModel::kTable) ==
        "sensor Sx: found 4 different gaps, expected 5 or more for this model");
  auto close = points_of(falling, 8);
  for (SensorPoint& point : close) {
    point.gap_m = 0.004 + (point.gap_m - 0.004) / 10;
    point.volts = falling(point.gap_m);
  }
  CHECK(error_of(close, ResponseModel::kTable) ==
        "sensor Sx: found gaps from 4.00 to 4.70 mm, expected 2 mm or more");
}

TEST_CASE("A response is refused where the signal does not fall", "[calibration]") {
  const auto wave = [](double gap_m) { return 1 + 0.3 * std::sin(gap_m / 0.0018); };
  CHECK_FALSE(error_of(points_of(wave), ResponseModel::kTable).empty());
  CHECK(error_of(points_of([](double gap_m) { return gap_m - 0.005; }), ResponseModel::kTable) ==
        "sensor Sx: found a signal not above 0 V, expected the emitter's light in every point");
}

TEST_CASE("A response is refused where the points scatter too much", "[calibration]") {
  auto scattered = points_of([](double gap_m) { return 0.005 / gap_m; }, 6);
  for (std::size_t i = 0; i < scattered.size(); ++i) {
    scattered[i].gap_m += i % 2 == 0 ? 0.4e-3 : -0.4e-3;
  }
  INFO(error_of(scattered, ResponseModel::kInverseSquare));
  CHECK(error_of(scattered, ResponseModel::kInverseSquare).find("expected 0.1 mm or less") !=
        std::string::npos);
}
