// SPDX-License-Identifier: Apache-2.0
#include "host/plot/plot_kinds.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace penduline;

namespace {

constexpr double kOmegaRadS = 5.7155;  // of 0.3 m

/// Ten seconds at 20 Hz of an elliptical swing of 10 by 4 deg along theta1, the mass 0.3 m below.
EstimateSeries ellipse_swing() {
  EstimateSeries series;
  for (int i = 0; i < 200; ++i) {
    const double phase = kOmegaRadS * 0.05 * i;
    const double to_y = 10 * std::numbers::pi / 180 * std::cos(phase);
    const double to_x = 4 * std::numbers::pi / 180 * std::sin(phase);
    // The tilt is (to_x, to_y): the angles whose rod points there.
    const double tilt = std::hypot(to_x, to_y);
    const double share = tilt > 0 ? std::sin(tilt) / tilt : 1;
    const double theta2 = std::asin(-share * to_x);
    const double theta1 = std::asin(share * to_y / std::cos(theta2));
    series.push_back({.t_us = 50'000 * static_cast<std::int64_t>(i),
                      .attitude = {{.angles = {.theta1_rad = theta1, .theta2_rad = theta2},
                                    .mass_m = Vector3<double>::Zero()}},
                      .omega_rad_s = {{.first = 0.5, .second = 0.25}},
                      .sigma_rad = {{.first = 0.002, .second = 0.004}}});
  }
  series.name = "swing.csv";
  series.hang_mass(0.3);
  return series;
}

Figure plot(const std::string& kind, const std::vector<EstimateSeries>& inputs,
            std::string* warning = nullptr) {
  const auto found = std::ranges::find(plot_kinds(), kind, &PlotKind::name);
  REQUIRE(found != plot_kinds().end());
  const auto figure = found->make(inputs, {.warn = [&](const std::string& text) {
                                    if (warning != nullptr) {
                                      *warning = text;
                                    }
                                  }});
  REQUIRE(figure);
  return *figure;
}

const Curve& curve_of(const Panel& panel, CurveStyle style) {
  const auto found = std::ranges::find(panel.curves, style, &Curve::style);
  REQUIRE(found != panel.curves.end());
  return *found;
}

double largest(const std::vector<double>& values) {
  return *std::ranges::max_element(values);
}

}  // namespace

TEST_CASE("Angles are drawn in degrees with a band of one sigma") {
  const EstimateSeries series = ellipse_swing();
  const Figure figure = plot("angles", {series});
  REQUIRE(figure.panels.size() == 2);
  CHECK(figure.panels[0].y_label == "theta1 / deg");
  CHECK(figure.panels[1].x_label == "t / s");
  const Curve& line = curve_of(figure.panels[1], CurveStyle::kLine);
  const Curve& band = curve_of(figure.panels[1], CurveStyle::kBand);
  REQUIRE(line.x == series.t_s);
  for (std::size_t i = 0; i < series.size(); ++i) {
    REQUIRE(line.y[i] == Approx(series.theta2_rad[i] * 180 / std::numbers::pi));
    REQUIRE(band.sigma_y[i] == Approx(0.004 * 180 / std::numbers::pi));
  }
  CHECK(band.y == line.y);
  CHECK(band.colour == line.colour);
}

TEST_CASE("A row without an answer and a dropout lift the pen; a flagged row is marked") {
  EstimateSeries series = ellipse_swing();
  series.theta1_rad[50] = NAN;
  series.flags[100] = flag::kDropout;
  series.flags[150] = flag::kOutOfRange;
  const Panel panel = plot("angles", {series}).panels[0];
  for (const CurveStyle style : {CurveStyle::kLine, CurveStyle::kBand}) {
    const Curve& curve = curve_of(panel, style);
    REQUIRE(curve.x.size() == 201);  // one row is not there, two places are
    CHECK(std::isnan(curve.y[50]));
    CHECK(curve.x[51] == series.t_s[51]);
    CHECK(std::isnan(curve.y[100]));
    CHECK(curve.x[101] == series.t_s[100]);
  }
  CHECK(curve_of(panel, CurveStyle::kMarks).x == std::vector<double>{series.t_s[150]});
}

TEST_CASE("Series over each other are told apart by colour, pattern and name") {
  EstimateSeries other = ellipse_swing();
  other.name = "other.csv";
  const Panel panel = plot("xyz", {ellipse_swing(), other}).panels[2];
  REQUIRE(panel.curves.size() == 2);
  CHECK(panel.curves[0].name == "swing.csv");
  CHECK(panel.curves[1].name == "other.csv");
  CHECK(panel.curves[0].colour != panel.curves[1].colour);
  CHECK(panel.curves[0].dash != panel.curves[1].dash);
  CHECK(panel.y_label == "z / mm");
}

TEST_CASE("From above, the fitted ellipse lies on the path") {
  const Figure figure = plot("top", {ellipse_swing()});
  const Panel& panel = figure.panels[0];
  CHECK(panel.equal_scales);
  REQUIRE(panel.curves.size() == 3);
  CHECK(panel.curves[1].name == "first swing: 10.00 x 4.00 deg");
  // l sin(tilt); the samples of the path miss its width's end by up to 1 %.
  CHECK(largest(panel.curves[0].y) == Approx(52.094).epsilon(1e-3));
  CHECK(largest(panel.curves[0].x) == Approx(20.927).epsilon(0.01));
  CHECK(largest(panel.curves[1].y) == Approx(52.094).epsilon(1e-3));
  CHECK(largest(panel.curves[1].x) == Approx(20.927).epsilon(1e-3));
}

TEST_CASE("From above, a path without a swing has no ellipse, and that is said") {
  EstimateSeries still = ellipse_swing();
  for (std::size_t i = 0; i < still.size(); ++i) {
    still.theta1_rad[i] = still.theta2_rad[i] = 0.01;
  }
  still.hang_mass(0.3);
  std::string warning;
  CHECK(plot("top", {still}, &warning).panels[0].curves.size() == 1);
  CHECK(warning.starts_with("swing.csv: no ellipse: found no swing"));
}

TEST_CASE("In space, a path has a shadow below it") {
  const Panel panel = plot("3d", {ellipse_swing()}).panels[0];
  REQUIRE(panel.curves.size() == 2);
  CHECK(panel.z_label == "z / mm");
  CHECK(panel.curves[0].colour == kGrey);
  CHECK(panel.curves[0].x == panel.curves[1].x);
  const double floor_mm = panel.curves[0].z.front();
  CHECK(floor_mm == largest(panel.curves[0].z));
  CHECK(floor_mm < *std::ranges::min_element(panel.curves[1].z));
}

TEST_CASE("Phase portraits take the estimator's rates, else differences, and say which") {
  EstimateSeries series = ellipse_swing();
  const Curve told = plot("phase", {series}).panels[0].curves[0];
  CHECK(told.name == "the estimator's rate");
  CHECK(told.y.front() == Approx(0.5 * 180 / std::numbers::pi));
  std::ranges::fill(series.omega1_rad_s, NAN);
  std::ranges::fill(series.omega2_rad_s, NAN);
  const Curve by_differences = plot("phase", {series}).panels[1].curves[0];
  CHECK(by_differences.name == "rate by differences");
  // 4 deg at 5.7155 rad/s, less what differences over 0.1 s lose.
  CHECK(largest(by_differences.y) ==
        Approx(4 * kOmegaRadS * std::sin(0.05 * kOmegaRadS) / (0.05 * kOmegaRadS)).epsilon(0.01));
}

TEST_CASE("A spectrum names its peak and, of a broken series, the part that it is of") {
  EstimateSeries series = ellipse_swing();
  std::string warning;
  const Panel panel = plot("spectrum", {series}, &warning).panels[0];
  CHECK(warning.empty());
  CHECK(panel.logarithmic);
  CHECK(panel.curves[0].name.starts_with("10 deg at 0.908"));
  series.flags[120] = flag::kDropout;
  const Panel part = plot("spectrum", {series}, &warning).panels[0];
  CHECK(warning ==
        "swing.csv: the spectrum is that of the longest part without a dropout, 120 of 200 rows "
        "from 0 s to 5.95 s");
  CHECK(part.curves[0].x.front() >= 2 / 6.0);
}

TEST_CASE("A phase portrait keeps every row, however long a pause was") {
  EstimateSeries series = ellipse_swing();
  for (std::size_t i = 100; i < series.size(); ++i) {
    series.t_s[i] += 3600;
  }
  const Curve path = plot("phase", {series}).panels[0].curves[0];
  CHECK(path.x.size() == 201);
  CHECK(std::isnan(path.x[100]));
}

TEST_CASE("A phase portrait by differences draws no chord over a dropout") {
  EstimateSeries series = ellipse_swing();
  std::ranges::fill(series.omega1_rad_s, NAN);
  series.flags[100] = flag::kDropout;
  const Curve path = plot("phase", {series}).panels[0].curves[0];
  // Rows 1 to 98 and 101 to 198 have rates.
  REQUIRE(path.x.size() == 98 + 1 + 98);
  CHECK(std::isnan(path.x[98]));
}

TEST_CASE("A row between two breaks is a point from above, in space and in the phase portrait") {
  EstimateSeries series = ellipse_swing();
  series.flags[100] = series.flags[101] = flag::kDropout;
  const Curve above = curve_of(plot("top", {series}).panels[0], CurveStyle::kPoints);
  CHECK(above.name.empty());
  CHECK(above.x == std::vector<double>{series.x_m[100] / 1e-3});
  CHECK(above.colour == std::size_t{0});
  const Panel space = plot("3d", {series}).panels[0];
  CHECK(std::ranges::count(space.curves, CurveStyle::kPoints, &Curve::style) == 2);  // and shadow
  CHECK(space.curves.back().z == std::vector<double>{series.z_m[100] / 1e-3});
  const Curve phase = curve_of(plot("phase", {series}).panels[1], CurveStyle::kPoints);
  CHECK(phase.y.front() == Approx(0.25 * 180 / std::numbers::pi));
  CHECK(phase.y.size() == 1);
}

TEST_CASE("A planar series beside a spatial one has no theta2 to show") {
  EstimateSeries planar = ellipse_swing();
  planar.planar = true;
  planar.name = "planar.csv";
  std::ranges::fill(planar.theta2_rad, 0);
  std::ranges::fill(planar.sigma2_rad, NAN);
  std::ranges::fill(planar.omega2_rad_s, NAN);
  for (const char* kind : {"angles", "phase", "spectrum"}) {
    INFO(kind);
    const Figure figure = plot(kind, {planar, ellipse_swing()});
    const auto named = [](const Panel& panel, std::string_view name) {
      return std::ranges::count_if(
          panel.curves, [&](const Curve& curve) { return curve.name.starts_with(name); });
    };
    CHECK(named(figure.panels[0], "planar.csv") == 1);
    CHECK(named(figure.panels[1], "planar.csv") == 0);
    CHECK(named(figure.panels[1], "swing.csv") == 1);
    CHECK(figure.panels[1].curves.back().colour == std::size_t{1});
    CHECK(std::ranges::all_of(figure.panels[1].curves,
                              [](const Curve& curve) { return curve.colour == 1; }));
  }
}

TEST_CASE("A spectrum of what rests is refused") {
  EstimateSeries still = ellipse_swing();
  std::ranges::fill(still.theta2_rad, 0);
  const auto figure = spectrum_plot({still}, {});
  REQUIRE_FALSE(figure);
  CHECK(figure.error().message ==
        "swing.csv: found 200 rows of one theta2, 0 deg, expected a swing: what rests has no "
        "spectrum");
}

TEST_CASE("Flagged rows of several series stand in the key once") {
  EstimateSeries series = ellipse_swing();
  series.flags[150] = flag::kOutOfRange;
  const Panel panel = plot("angles", {series, series}).panels[0];
  CHECK(std::ranges::count(panel.curves, "flagged", &Curve::name) == 1);
  CHECK(std::ranges::count(panel.curves, CurveStyle::kMarks, &Curve::style) == 2);
}

TEST_CASE("Residuals of several series are called by name and RMS alone") {
  const Panel panel = plot("residuals", {ellipse_swing(), ellipse_swing()}).panels[0];
  CHECK(panel.curves[0].name.starts_with("swing.csv: RMS 0."));
}

TEST_CASE("Residuals are measured less simulated, with their RMS") {
  EstimateSeries series = ellipse_swing();
  const Figure figure = plot("residuals", {series});
  REQUIRE(figure.panels.size() == 2);
  CHECK(figure.panels[0].y_label == "residual of theta1 / deg");
  CHECK(figure.panels[0].curves[0].name.starts_with("experiment less simulation, RMS 0."));
  CHECK(figure.panels[0].curves[0].style == CurveStyle::kPoints);
}

TEST_CASE("A path needs positions") {
  EstimateSeries series = ellipse_swing();
  std::ranges::fill(series.x_m, NAN);
  for (const char* kind : {"xyz", "top", "3d"}) {
    const auto found = std::ranges::find(plot_kinds(), kind, &PlotKind::name);
    const auto figure = found->make({series}, {});
    REQUIRE_FALSE(figure);
    CHECK(figure.error().message.starts_with("swing.csv: found no positions, expected"));
  }
}
