// SPDX-License-Identifier: Apache-2.0
#include "host/analysis/measured.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

using namespace penduline;

TEST_CASE("A straight line through points of known sigmas is NumPy's polyfit") {
  // numpy.polyfit([0, 1, 2, 3, 4], y, 1, w=1/sigma, cov=True)
  Eigen::MatrixXd design(5, 2);
  design << 1, 0, 1, 1, 1, 2, 1, 3, 1, 4;
  const Eigen::VectorXd y{{1.0, 2.9, 5.2, 6.8, 9.1}};
  const Eigen::VectorXd sigmas{{0.1, 0.2, 0.1, 0.3, 0.1}};
  const LinearFit fit = fit_linear(design, y, sigmas);
  CHECK(fit.factor(1).value == Approx(2.02551929).epsilon(1e-8));
  CHECK(fit.factor(1).sigma == Approx(0.03600382).epsilon(1e-6));
  CHECK(fit.factor(0).value == Approx(1.02522255).epsilon(1e-8));
  CHECK(fit.factor(0).sigma == Approx(0.09052877).epsilon(1e-6));
}

TEST_CASE("Points that lie nearer to a line than their sigmas leave the sigmas as they are") {
  Eigen::MatrixXd design(3, 1);
  design.setOnes();
  const LinearFit fit =
      fit_linear(design, Eigen::VectorXd::Constant(3, 7), Eigen::VectorXd::Constant(3, 0.3));
  CHECK(fit.factor(0).value == Approx(7));
  CHECK(fit.factor(0).sigma == Approx(0.3 / std::sqrt(3)));
}

TEST_CASE("The uncertainty of a product is propagated with the factors' correlation") {
  const Eigen::VectorXd values{{3, 5}};
  Eigen::MatrixXd covariance(2, 2);
  covariance << 0.04, 0.01, 0.01, 0.09;
  const Measured product =
      propagated(values, covariance, [](const Eigen::VectorXd& at) { return at[0] * at[1]; });
  CHECK(product.value == 15);
  CHECK(product.sigma == Approx(std::sqrt(25 * 0.04 + 9 * 0.09 + 2 * 15 * 0.01)));
}

TEST_CASE("What is known exactly adds no uncertainty") {
  const Measured figure = propagated(Eigen::VectorXd{{2, 4}}, Eigen::MatrixXd::Zero(2, 2),
                                     [](const Eigen::VectorXd& at) { return at[0] + at[1]; });
  CHECK(figure.sigma == 0);
}

TEST_CASE("Where the figure of values nearby is no number, nothing is known of its uncertainty") {
  const Measured figure =
      propagated(Eigen::VectorXd{{2}}, Eigen::MatrixXd::Ones(1, 1), [](const Eigen::VectorXd& at) {
        return at[0] > 2 ? std::numeric_limits<double>::infinity() : at[0];
      });
  CHECK(figure.value == 2);
  CHECK_FALSE(std::isfinite(figure.sigma));
}

TEST_CASE("Values that stand there five times each repeat five times") {
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  Eigen::VectorXd once(5000);
  Eigen::VectorXd five_times(5000);
  for (Eigen::Index i = 0; i < once.size(); ++i) {
    once[i] = noise(random);
    five_times[i] = once[i / 5];
  }
  CHECK(repetition(once) == Approx(1).margin(0.1));
  CHECK(repetition(five_times) == Approx(5).margin(0.5));
  CHECK(autocorrelation(five_times, 1) == Approx(0.8).margin(0.05));
}
