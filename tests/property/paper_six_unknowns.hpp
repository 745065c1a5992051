// SPDX-License-Identifier: Apache-2.0
// The paper's own inverse, as a peer to test against: six equations in six unknowns (Eq. 24).
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

namespace penduline::test {

/// Eq. 22 = (dx, 0, -gap_x) and Eq. 23 = (0, dy, -gap_y) in [theta1, theta2, l1, l2, l3, l4], for
/// sensors at the pivot's height. Has the shape that ceres::TinySolver wants of a function.
struct PaperSixUnknowns {
  using Scalar = double;
  enum { NUM_RESIDUALS = 6, NUM_PARAMETERS = 6 };
  using Unknowns = Eigen::Matrix<double, 6, 1>;
  using Jacobian = Eigen::Matrix<double, 6, 6>;

  double disc_offset_m = 0.02;  ///< lp
  double dx_m = 0.02;
  double dy_m = 0.02;
  double gap_x_m = 0.02;
  double gap_y_m = 0.02;

  /// Where the rod hangs straight down.
  [[nodiscard]] Unknowns rest() const {
    Unknowns unknowns;
    unknowns << 0, 0, 0, dx_m, dy_m, 0;
    return unknowns;
  }

  /// Residuals in metres; the Jacobian column by column, unless null.
  bool operator()(const double* unknowns, double* residuals, double* jacobian) const {
    const double s1 = std::sin(unknowns[0]);
    const double c1 = std::cos(unknowns[0]);
    const double s2 = std::sin(unknowns[1]);
    const double c2 = std::cos(unknowns[1]);
    const double l1 = unknowns[2];
    const double l2 = unknowns[3];
    const double l3 = unknowns[4];
    const double l4 = unknowns[5];
    const double lp = disc_offset_m;
    // How far the spot is along the turned -Z axis, and the same turned by a quarter about Y.
    const double down_x = l2 * s2 + lp * c2;
    const double down_y = l4 * s2 + lp * c2;
    const double along_x = l2 * c2 - lp * s2;
    const double along_y = l4 * c2 - lp * s2;

    residuals[0] = along_x - dx_m;
    residuals[1] = s1 * down_x - l1 * c1;
    residuals[2] = -c1 * down_x - l1 * s1 + gap_x_m;
    residuals[3] = along_y;
    residuals[4] = s1 * down_y + l3 * c1 - dy_m;
    residuals[5] = -c1 * down_y + l3 * s1 + gap_y_m;

    if (jacobian != nullptr) {
      Eigen::Map<Jacobian> by_column(jacobian);
      by_column << 0, -down_x, 0, c2, 0, 0,                           //
          c1 * down_x + l1 * s1, s1 * along_x, -c1, s1 * s2, 0, 0,    //
          s1 * down_x - l1 * c1, -c1 * along_x, -s1, -c1 * s2, 0, 0,  //
          0, -down_y, 0, 0, 0, c2,                                    //
          c1 * down_y - l3 * s1, s1 * along_y, 0, 0, c1, s1 * s2,     //
          s1 * down_y + l3 * c1, -c1 * along_y, 0, 0, s1, -c1 * s2;
    }
    return true;
  }

  /// Plain Newton from where `unknowns` stands; false where it has not converged in 20 steps.
  [[nodiscard]] bool newton(Unknowns& unknowns) const {
    for (int step = 0; step < 20; ++step) {
      Unknowns residuals;
      Jacobian jacobian;
      (*this)(unknowns.data(), residuals.data(), jacobian.data());
      const Unknowns change = jacobian.partialPivLu().solve(residuals);
      unknowns -= change;
      if (change.norm() < 1e-13) {
        return true;
      }
    }
    return false;
  }
};

}  // namespace penduline::test
