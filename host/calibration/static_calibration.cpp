// SPDX-License-Identifier: Apache-2.0
// Sensor by sensor, and what came of all in one record.
#include "host/calibration/static_calibration.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/units.hpp"

namespace penduline {
namespace {

/// Adds a sensor's numbers to the record; sensors know nothing of each other.
void append(const ResponseFit& fit, const std::string& sensor, CalibrationRecord& record) {
  const Eigen::Index before = record.values.size();
  const Eigen::Index added = fit.fit.values.size();
  record.values.conservativeResize(before + added);
  record.values.tail(added) = fit.fit.values;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(before + added, before + added);
  covariance.topLeftCorner(before, before) = record.covariance;
  covariance.bottomRightCorner(added, added) = fit.fit.covariance;
  record.covariance = covariance;
  for (const std::string& name : fit.names) {
    record.parameters.push_back(fmt::format("{} {}", sensor, name));
  }
}

}  // namespace

Curve points_curve(const std::vector<double>& gap_m, const std::vector<double>& volts) {
  Curve curve{.name = "measured", .style = CurveStyle::kPoints, .x = {}, .y = volts};
  for (const double gap : gap_m) {
    curve.x.push_back(gap / kMillimetre);
  }
  return curve;
}

std::vector<Panel> response_panels(const std::string& sensor, const Response<double>& response,
                                   const GapRange& range, const Curve& points) {
  constexpr int kPlaces = 200;
  Curve line{.name = "fitted", .style = CurveStyle::kLine, .x = {}, .y = {}};
  for (int i = 0; i <= kPlaces; ++i) {
    const double gap_m = range.nearest_m + (range.farthest_m - range.nearest_m) * i / kPlaces;
    line.x.push_back(gap_m / kMillimetre);
    line.y.push_back(response.volts(gap_m));
  }
  Curve residuals{.name = "", .style = CurveStyle::kPoints, .x = points.x, .y = {}};
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    residuals.y.push_back(
        (response.read(points.y[i]).gap_m.value_or(NAN) - points.x[i] * kMillimetre) / kMicrometre);
  }
  return {
      {.title = sensor, .x_label = "gap / mm", .y_label = "signal / V", .curves = {line, points}},
      {.title = sensor + ": residuals",
       .x_label = "gap / mm",
       .y_label = "gap found less gap known / um",
       .curves = {residuals}}};
}

tl::expected<Calibration, Error> calibrate_static(const RigFile& rig, const SensorPoints& points,
                                                  ResponseModel model) {
  Calibration result;
  result.record.method = "static";
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
    const std::string& name = rig.sensor_names[i];
    const auto fit = fit_response(points[i], model, rig.rig.responses[i], name);
    if (!fit) {
      return tl::unexpected(fit.error());
    }
    append(*fit, name, result.record);
    result.changes.responses[i] = fit->response;
    result.warnings.insert(result.warnings.end(), fit->warnings.begin(), fit->warnings.end());
    result.notes.push_back(fmt::format(
        "{}: {} of {} points, {} of {} numbers, gaps {:.2f} to {:.2f} mm, residual {:.1f} um RMS",
        name, fit->used.size(), fit->used.size() + fit->left_out, model_name(model),
        fit->names.size(), fit->range.nearest_m / kMillimetre, fit->range.farthest_m / kMillimetre,
        fit->residual_m / kMicrometre));
    std::vector<double> gaps;
    std::vector<double> volts;
    for (const SensorPoint& point : fit->used) {
      gaps.push_back(point.gap_m);
      volts.push_back(point.volts);
    }
    for (Panel& panel :
         response_panels(name, fit->response, fit->range, points_curve(gaps, volts))) {
      result.figure.panels.push_back(std::move(panel));
    }
    squares += fit->residual_m * fit->residual_m * static_cast<double>(fit->used.size());
    count += fit->used.size();
  }
  result.record.residual_m = std::sqrt(squares / static_cast<double>(count));
  return result;
}

}  // namespace penduline
