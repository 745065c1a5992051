// SPDX-License-Identifier: Apache-2.0
// Tests of the simulated sensors and ADC: signals, ambient light, noise, quantization, saturation.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "common/disc_plane.hpp"
#include "hal/sim/sampled_rig.hpp"
#include "tests/unit/hal/recording_text.hpp"
#include "tests/unit/hal/simulated_rigs.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

constexpr double kCount_v = 3.3 / 65535;

std::vector<std::string> first_rows(const SimulationSettings& settings) {
  SampledRig rig(paper_rig(), settings);
  std::vector<std::string> rows;
  for (int i = 0; i < 50; ++i) {
    rows.push_back(shown(next_sample(rig), 2));
  }
  return rows;
}

/// The first sample of a pendulum at rest.
Sample at_rest(const SimulationSettings& settings) {
  SampledRig rig(paper_rig(), settings);
  return next_sample(rig);
}

double signal_at_rest_v(const SimulationSettings& settings) {
  const Reading reading = at_rest(settings).readings[0];
  return (reading.on - reading.off) * kCount_v;
}

TEST_CASE("One seed gives one result", "[sim]") {
  const SimulationSettings settings{.start = kCaseOne, .gap_noise_m = 5e-5, .seed = 7};
  CHECK(first_rows(settings) == first_rows(settings));
}

TEST_CASE("Another seed gives another result", "[sim]") {
  CHECK(first_rows({.start = kCaseOne, .seed = 7}) != first_rows({.start = kCaseOne, .seed = 8}));
}

TEST_CASE("Without noise the seed does not matter", "[sim]") {
  SimulationSettings other = ideal(kCaseOne);
  other.seed = 99;
  CHECK(first_rows(ideal(kCaseOne)) == first_rows(other));
}

TEST_CASE("Without disturbance the signal is the response's, to half a count", "[sim]") {
  SampledRig rig(paper_rig(), ideal({.theta_rad = 0.2, .phi_rad = 0.4, .psi_rad_s = 3}));
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    const Sample sample = next_sample(rig);
    const SwingState<double> truth = rig.truth();
    // The plane through lp n across n = (-s2, s1 c2, -c1 c2): gap = (lp + n . place) / (c1 c2).
    const double s1 = std::sin(truth.theta1_rad);
    const double c1 = std::cos(truth.theta1_rad);
    const double s2 = std::sin(truth.theta2_rad);
    const double c2 = std::cos(truth.theta2_rad);
    const std::array gaps_m = {(0.02 + s2 * 0.02) / (c1 * c2), (0.02 - s1 * c2 * 0.02) / (c1 * c2)};
    for (std::size_t sensor = 0; sensor < 2; ++sensor) {
      const double volts = (gaps_m[sensor] - 0.01) / 0.006;
      worst = std::max(worst, std::abs(sample.readings[sensor].on * kCount_v - volts));
    }
  }
  CHECK(worst <= 0.5 * kCount_v + 1e-12);
}

TEST_CASE("The dark reading takes ambient light out", "[sim]") {
  SimulationSettings settings = ideal({});
  const double dark_v = signal_at_rest_v(settings);
  settings.ambient_v = 0.7;
  // Each of the two readings is rounded.
  CHECK_THAT(signal_at_rest_v(settings), Catch::WithinAbs(dark_v, 1.001 * kCount_v));
}

TEST_CASE("The dark reading is the ambient light", "[sim]") {
  SimulationSettings settings = ideal({});
  settings.ambient_v = 0.7;
  CHECK(at_rest(settings).readings[0].off == std::lround(0.7 / kCount_v));
}

TEST_CASE("Emitters that cannot be switched leave ambient light in the signal", "[sim]") {
  SimulationSettings settings = ideal({});
  const double dark_v = signal_at_rest_v(settings);
  settings.ambient_v = 0.7;
  settings.emitter_switched = false;
  CHECK(at_rest(settings).readings[0].off == 0);
  CHECK_THAT(signal_at_rest_v(settings), Catch::WithinAbs(dark_v + 0.7, 1.001 * kCount_v));
}

/// RMS of the signal's scatter about its mean, at rest.
double scatter_v(const SimulationSettings& settings) {
  constexpr int kSamples = 4000;
  SampledRig rig(paper_rig(), settings);
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Reading reading = next_sample(rig).readings[0];
    const double volts = (reading.on - reading.off) * kCount_v;
    sum += volts;
    squares += volts * volts;
  }
  return std::sqrt(squares / kSamples - sum * sum / kSamples / kSamples);
}

TEST_CASE("Noise falls with the root of the conversions", "[sim]") {
  // The lit and the dark reading each have 10 mV / sqrt(n); 4000 samples tell it to 1.1 %.
  SimulationSettings settings = ideal({});
  settings.duration_s = {};
  settings.ambient_v = 0.5;
  settings.noise_v = 0.01;
  settings.conversions = GENERATE(1, 4, 32);
  CAPTURE(settings.conversions);
  CHECK(scatter_v(settings) == Approx(0.01 * std::sqrt(2.0 / settings.conversions)).epsilon(0.05));
}

TEST_CASE("Gap noise comes through the response", "[sim]") {
  // 50 um at 0.006 m/V
  SimulationSettings settings = ideal({});
  settings.duration_s = {};
  settings.gap_noise_m = 5e-5;
  CHECK(scatter_v(settings) == Approx(5e-5 / 0.006).epsilon(0.05));
}

TEST_CASE("Twelve bits without noise give 4096 different readings, no others", "[sim]") {
  SimulationSettings settings = ideal({.theta_rad = 0.2, .phi_rad = 0.4, .psi_rad_s = 3});
  settings.adc_bits = 12;
  SampledRig rig(paper_rig(), settings);
  std::set<std::int32_t> seen;
  for (int i = 0; i < 200; ++i) {
    const std::int32_t on = next_sample(rig).readings[0].on;
    const double code = std::round(on * 4095 / 65535.0);
    REQUIRE(on == std::lround(code * 65535 / 4095));
    seen.insert(on);
  }
  CHECK(seen.size() > 50);
}

TEST_CASE("Averaging noisy conversions sees between the steps", "[sim]") {
  SimulationSettings settings = ideal({});
  settings.adc_bits = 8;
  settings.ambient_v = 0.5;
  const double coarse_v = signal_at_rest_v(settings);
  settings.noise_v = 0.01;
  settings.conversions = 4096;
  // The gap at rest is 20 mm: 10 mm above zero volts at 6 mm/V.
  CHECK(std::abs(coarse_v - 10.0 / 6) > 0.002);
  CHECK_THAT(signal_at_rest_v(settings), Catch::WithinAbs(10.0 / 6, 0.001));
}

TEST_CASE("A signal at the ADC's end is flagged as saturated", "[sim]") {
  Rig<double> rig = paper_rig();
  rig.responses[0].model = LinearResponse<double>{.gap_at_zero_m = 0, .slope_m_per_v = 0.02 / 3.5};
  SampledRig strong(rig, ideal({}));
  const Sample sample = next_sample(strong);
  CHECK(sample.flags == flag::kSaturated);
  CHECK(sample.readings[0].on == 65535);
}

TEST_CASE("Ambient light at the ADC's end is flagged as saturated", "[sim]") {
  SimulationSettings settings = ideal({});
  settings.ambient_v = 3.5;
  CHECK(at_rest(settings).flags == flag::kSaturated);
}

TEST_CASE("A signal just below the ADC's end is not flagged", "[sim]") {
  SimulationSettings settings = ideal({});
  settings.ambient_v = 3.3 - 10.0 / 6 - 2 * kCount_v;
  const Sample sample = at_rest(settings);
  CHECK(sample.readings[0].on == 65533);
  CHECK(sample.flags == 0);
}

TEST_CASE("Noise below zero volts is cut off, not flagged", "[sim]") {
  SimulationSettings settings = ideal({});
  settings.noise_v = 0.05;
  const Sample sample = at_rest(settings);
  CHECK(sample.readings[0].off >= 0);
  CHECK(sample.flags == 0);
}

TEST_CASE("A simulation without a duration does not end", "[sim]") {
  SimulationSettings settings = ideal({});
  settings.duration_s = {};
  settings.rate_hz = 1e5;
  SampledRig rig(paper_rig(), settings);
  std::uint64_t seq = 0;
  while (seq < 99'999) {
    seq = next_sample(rig).seq;
  }
  CHECK(rig.progress() == Approx(0).margin(1e-12));
}

}  // namespace
