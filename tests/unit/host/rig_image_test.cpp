// SPDX-License-Identifier: Apache-2.0
// Tests of a rig's way to a board: what is decoded there is the rig in single precision.
#include "host/rig_image.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "common/wire/rig_image.hpp"
#include "host/rig_file.hpp"
#include "tests/unit/host/rig_text.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

constexpr auto kGaussNewton = wire::OnboardEstimator::kGaussNewton;

/// The rig of a text as a board decodes it.
Rig<float> on_board(const std::string& text) {
  const auto image =
      rig_image(parse_rig(text, "rig.toml").value().rig, kGaussNewton, "rig.toml").value();
  return wire::decode_rig(image).value().rig;
}

TEST_CASE("A board gets the rig's numbers in single precision", "[rig_image]") {
  const Rig<float> rig = on_board(std::string(kRigText));
  CHECK(rig.pendulum.length_m == 0.3F);
  CHECK(rig.pendulum.damping_per_s == 0.01F);
  CHECK(rig.disc_diameter_m == 0.12F);
  CHECK(rig.layout.disc_offset_m == 0.02F);
  CHECK(rig.layout.count == 2);
  CHECK(rig.layout.position_m[1].y() == 0.02F);
  REQUIRE(rig.filter);
  CHECK(rig.filter->order == 15);
  CHECK(rig.filter->cutoff_of_nyquist == 0.15F);
}

TEST_CASE("A board gets the estimator, each sensor's noise and the filter's trust", "[rig_image]") {
  Rig<double> rig = parse_rig(std::string(kRigText), "rig.toml").value().rig;
  rig.noise[1] = {.volts = 0.002, .gap_m = 3e-5};
  rig.trust.acceleration_rad_s15 = 0.07;
  const auto decoded =
      wire::decode_rig(rig_image(rig, wire::OnboardEstimator::kKalman, "rig.toml").value());
  REQUIRE(decoded);
  CHECK(decoded->estimator == wire::OnboardEstimator::kKalman);
  CHECK(decoded->rig.noise[0].volts == 0.0005F);
  CHECK(decoded->rig.noise[1].volts == 0.002F);
  CHECK(decoded->rig.noise[1].gap_m == 3e-5F);
  CHECK(decoded->rig.trust.acceleration_rad_s15 == 0.07F);
  CHECK(decoded->rig.trust.length_share == 0.02F);
}

TEST_CASE("Each response model reads on the board as on the host, to a micrometre", "[rig_image]") {
  const std::string table = GENERATE(
      as<std::string>{}, "{ model = \"linear\", gap_at_zero_m = 0.031, slope_m_per_v = -0.006 }",
      "{ model = \"table\", volts = [0.31, 0.42, 0.55, 0.9], gap_m = [0.026, 0.020, 0.016, 0.011] "
      "}",
      "{ model = \"inverse_square\", a_v_m2 = 2e-4, b_m = 0.004, c_v = 0.05 }",
      "{ model = \"polynomial\", coefficients = [0.03, -0.012, 0.0025, -0.0003], range_v = [0, 2] "
      "}");
  const std::string text = rig_with_response(table);
  const Response<double> host = parse_rig(text, "rig.toml").value().rig.responses[0];
  const Response<float> board = on_board(text).responses[0];
  for (const double volts : {0.35, 0.5, 0.8}) {
    CAPTURE(table, volts);
    CHECK(std::abs(double{board.read(static_cast<float>(volts)).gap_m.value()} -
                   host.read(volts).gap_m.value()) <= 1e-6);
  }
}

TEST_CASE("A rig that is none in single precision is refused by name", "[rig_image]") {
  // Two volts of the table that are one float.
  const auto rig =
      parse_rig(rig_with_response("{ model = \"table\", volts = [0.5, 0.5000000001, 0.9], "
                                  "gap_m = [0.02, 0.018, 0.011] }"),
                "rig.toml")
          .value()
          .rig;
  const auto image = rig_image(rig, kGaussNewton, "rig.toml");
  REQUIRE_FALSE(image);
  CHECK(image.error().message == "rig.toml: the rig does not work in the board's single precision");
}

}  // namespace
