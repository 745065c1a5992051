// SPDX-License-Identifier: Apache-2.0
// Motion and noise of made-up signals.
#include "host/calibration/signal_motion.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

namespace {

using namespace penduline;

constexpr double kRate_hz = 20;
constexpr double kFastest_hz = 2;

/// White noise of 1 mV RMS about 1 V.
std::vector<double> noise(unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(1, 1e-3);
  std::vector<double> volts(count);
  for (double& value : volts) {
    value = normal(random);
  }
  return volts;
}

void add_swing(std::vector<double>& volts, double amplitude_v, double hz, double rate_hz) {
  for (std::size_t i = 0; i < volts.size(); ++i) {
    volts[i] +=
        amplitude_v * std::sin(2 * std::numbers::pi * hz * static_cast<double>(i) / rate_hz);
  }
}

TEST_CASE("Noise is taken for motion in one recording of some hundred at most", "[calibration]") {
  int moving = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    const std::vector<double> volts = noise(seed, 400);
    const SignalMotion motion = motion_of(volts, kRate_hz, kFastest_hz);
    moving += motion.swing_v > 0 || motion.drift_v != 0 ? 1 : 0;
    REQUIRE(noise_of(volts) == Approx(1e-3).epsilon(0.2));
  }
  CHECK(moving <= 10);
}

TEST_CASE("A swing is found beneath twice as much noise, with its frequency", "[calibration]") {
  std::vector<double> volts = noise(1, 400);
  add_swing(volts, std::numbers::sqrt2 * 0.5e-3, 0.91, kRate_hz);
  const SignalMotion motion = motion_of(volts, kRate_hz, kFastest_hz);
  CHECK(motion.swing_v == Approx(0.5e-3).epsilon(0.15));
  CHECK(motion.swing_hz == Approx(0.91).margin(0.03));
}

TEST_CASE("A swing is found at a fast rate and for hours, in parts", "[calibration]") {
  std::vector<double> volts = noise(1, 600'000);  // ten minutes
  add_swing(volts, std::numbers::sqrt2 * 0.1e-3, 0.91, 1000);
  const SignalMotion motion = motion_of(volts, 1000, kFastest_hz);
  CHECK(motion.swing_v == Approx(0.1e-3).epsilon(0.1));
  CHECK(motion.swing_hz == Approx(0.91).margin(0.01));
  CHECK(noise_of(volts) == Approx(1e-3).epsilon(0.01));
}

TEST_CASE("A line's drift is that between the middles of the outer thirds", "[calibration]") {
  std::vector<double> volts = noise(1, 400);
  for (std::size_t i = 0; i < volts.size(); ++i) {
    volts[i] += 3e-3 * static_cast<double>(i) / 400;
  }
  const SignalMotion motion = motion_of(volts, kRate_hz, kFastest_hz);
  CHECK(motion.drift_v == Approx(2e-3).epsilon(0.1));
  CHECK(motion.swing_v == 0);
}

TEST_CASE("A constant and a few samples have no motion", "[calibration]") {
  const SignalMotion constant = motion_of(std::vector<double>(100, 1.5), kRate_hz, kFastest_hz);
  CHECK(noise_of(std::vector<double>(100, 1.5)) == 0);
  CHECK(constant.swing_v == 0);
  CHECK(constant.drift_v == 0);
  CHECK(motion_of({1, 2, 3}, kRate_hz, kFastest_hz).swing_v == 0);
  CHECK(motion_of({}, kRate_hz, kFastest_hz).swing_v == 0);
  CHECK(noise_of({}) == 0);
}

}  // namespace
