// SPDX-License-Identifier: Apache-2.0
// Linear least squares of sine and cosine, and what they say of the ellipse.
#include "host/analysis/swing_ellipse.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace penduline {
namespace {

/// A quantity that depends linearly on the small errors of (cos x, sin x, cos y, sin y).
using Gradient = Eigen::RowVector4d;

/// One turning arrow of the motion, z = x + i y = plus e^(i w t) + minus e^(-i w t).
struct Arrow {
  std::complex<double> at;
  Gradient real;
  Gradient imaginary;

  [[nodiscard]] double length() const { return std::abs(at); }
  [[nodiscard]] Gradient by_length() const {
    return (at.real() * real + at.imag() * imaginary) / std::max(length(), 1e-300);
  }
  [[nodiscard]] Gradient by_angle() const {
    return (at.real() * imaginary - at.imag() * real) / std::max(std::norm(at), 1e-300);
  }
};

Measured measured(double value, const Gradient& gradient, const Eigen::Matrix4d& covariance) {
  return {.value = value, .sigma = std::sqrt((gradient * covariance).dot(gradient))};
}

/// The ellipse of x = c[0] cos + c[1] sin, y = c[2] cos + c[3] sin.
SwingEllipse ellipse_of(const Eigen::Vector4d& c, const Eigen::Matrix4d& covariance) {
  const Arrow plus{.at = {(c[0] + c[3]) / 2, (c[2] - c[1]) / 2},
                   .real = Gradient(1, 0, 0, 1) / 2,
                   .imaginary = Gradient(0, -1, 1, 0) / 2};
  const Arrow minus{.at = {(c[0] - c[3]) / 2, (c[2] + c[1]) / 2},
                    .real = Gradient(1, 0, 0, -1) / 2,
                    .imaginary = Gradient(0, 1, 1, 0) / 2};
  const double angle1 = std::arg(plus.at);
  const double angle2 = std::arg(minus.at);
  SwingEllipse ellipse;
  ellipse.semi_major_rad =
      measured(plus.length() + minus.length(), plus.by_length() + minus.by_length(), covariance);
  ellipse.semi_minor_rad =
      measured(plus.length() - minus.length(), plus.by_length() - minus.by_length(), covariance);
  ellipse.orientation_rad =
      measured((angle1 + angle2) / 2, (plus.by_angle() + minus.by_angle()) / 2, covariance);
  ellipse.phase_rad =
      measured((angle1 - angle2) / 2, (plus.by_angle() - minus.by_angle()) / 2, covariance);
  return ellipse;
}

/// The ellipse of the rows from `begin` to `end`.
SwingEllipse fit_piece(const std::vector<TiltPoint>& points, const AngleSeries& series,
                       std::size_t begin, std::size_t end, double middle_s, const SwingCut& cut) {
  const auto rows = static_cast<Eigen::Index>(end - begin);
  const Eigen::Index columns = cut.rest ? 4 : 5;
  Eigen::MatrixXd design(rows, columns);
  Eigen::VectorXd x(rows);
  Eigen::VectorXd y(rows);
  const double omega_rad_s = 2 * std::numbers::pi / cut.period_s;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const std::size_t row = begin + static_cast<std::size_t>(i);
    const double t_s = series.t_s[row] - middle_s;
    const double cosine = std::cos(omega_rad_s * t_s);
    const double sine = std::sin(omega_rad_s * t_s);
    design.row(i).head(4) << cosine, sine, t_s * cosine, t_s * sine;
    if (!cut.rest) {
      design(i, 4) = 1;
    }
    x[i] = points[row].x_rad - (cut.rest ? cut.rest->x_rad : 0);
    y[i] = points[row].y_rad - (cut.rest ? cut.rest->y_rad : 0);
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(design);
  const Eigen::VectorXd of_x = qr.solve(x);
  const Eigen::VectorXd of_y = qr.solve(y);
  const double freedom = static_cast<double>(std::max<Eigen::Index>(rows - columns, 1));
  const double square_x = (design * of_x - x).squaredNorm() / freedom;
  const double square_y = (design * of_y - y).squaredNorm() / freedom;
  const Eigen::Matrix2d spread = (design.transpose() * design)
                                     .completeOrthogonalDecomposition()
                                     .pseudoInverse()
                                     .topLeftCorner<2, 2>();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  covariance.topLeftCorner<2, 2>() =
      spread * (cut.noise ? cut.noise->x_rad * cut.noise->x_rad : square_x);
  covariance.bottomRightCorner<2, 2>() =
      spread * (cut.noise ? cut.noise->y_rad * cut.noise->y_rad : square_y);
  SwingEllipse ellipse = ellipse_of({of_x[0], of_x[1], of_y[0], of_y[1]}, covariance);
  ellipse.t_s = middle_s;
  ellipse.residual_rad = std::sqrt(square_x + square_y);
  ellipse.centre =
      cut.rest.value_or(TiltPoint{.x_rad = of_x[columns - 1], .y_rad = of_y[columns - 1]});
  return ellipse;
}

double nearest(double angle, double expected, double turn) {
  return angle + turn * std::round((expected - angle) / turn);
}

/// Lets angle and phase go on from those of the swing before. Both may jump by a half turn
/// together, which is the same ellipse.
void go_on(const SwingEllipse& before, double omega_rad_s, SwingEllipse& ellipse) {
  const double orientation = ellipse.orientation_rad.value;
  ellipse.orientation_rad.value =
      nearest(orientation, before.orientation_rad.value, std::numbers::pi);
  ellipse.phase_rad.value = nearest(
      ellipse.phase_rad.value + (ellipse.orientation_rad.value - orientation),
      before.phase_rad.value + omega_rad_s * (ellipse.t_s - before.t_s), 2 * std::numbers::pi);
}

}  // namespace

TiltPoint tilt_point(double theta1_rad, double theta2_rad) {
  const double x = -std::sin(theta2_rad);
  const double y = std::sin(theta1_rad) * std::cos(theta2_rad);
  const double sine = std::hypot(x, y);
  const double tilt = std::atan2(sine, std::cos(theta1_rad) * std::cos(theta2_rad));
  const double stretch = sine > 0 ? tilt / sine : 1;
  return {.x_rad = stretch * x, .y_rad = stretch * y};
}

double SwingEllipse::square_rad2() const {
  return semi_major_rad.value * semi_major_rad.value + semi_minor_rad.value * semi_minor_rad.value;
}

std::vector<SwingEllipse> swing_ellipses(const AngleSeries& series, const SwingCut& cut) {
  constexpr double kFewestSamples = 8;
  std::vector<SwingEllipse> ellipses;
  if (series.size() < 2) {
    return ellipses;
  }
  std::vector<TiltPoint> points(series.size());
  std::ranges::transform(series.theta1_rad, series.theta2_rad, points.begin(), tilt_point);
  const double piece_s = std::max(cut.period_s, kFewestSamples * series.period_s());
  const auto row_at = [&](double t_s) {
    return static_cast<std::size_t>(std::ranges::lower_bound(series.t_s, t_s) - series.t_s.begin());
  };
  // A piece holds its last moment's row as well as its first's.
  const double least = 0.7 * piece_s / series.period_s();
  const double margin_s = series.period_s() / 2;
  const double last_s = series.t_s.back() + margin_s - piece_s;
  for (int i = 0; series.t_s.front() + i * cut.step_s <= last_s; ++i) {
    const double begin_s = series.t_s.front() + i * cut.step_s;
    const std::size_t begin = row_at(begin_s - margin_s / 2);
    const std::size_t end = row_at(begin_s + piece_s - margin_s / 2);
    if (static_cast<double>(end - begin) < least) {
      continue;  // samples are missing
    }
    SwingEllipse ellipse = fit_piece(points, series, begin, end, begin_s + piece_s / 2, cut);
    if (!ellipses.empty()) {
      go_on(ellipses.back(), 2 * std::numbers::pi / cut.period_s, ellipse);
    }
    ellipses.push_back(ellipse);
  }
  return ellipses;
}

}  // namespace penduline
