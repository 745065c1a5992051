// SPDX-License-Identifier: Apache-2.0
#include "host/plot/spectrum.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace penduline;

namespace {

constexpr double kStepS = 0.05;

/// A pendulum's swing, something weaker and faster, and a zero that is off.
std::vector<double> two_sines(std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double t_s = kStepS * static_cast<double>(i);
    values[i] = 0.12 * std::sin(2 * std::numbers::pi * 0.9096 * t_s) +
                0.03 * std::cos(2 * std::numbers::pi * 3.3 * t_s) + 0.05;
  }
  return values;
}

}  // namespace

TEST_CASE("A spectrum's amplitudes are those of NumPy's transform") {
  // numpy: x -= x.mean(); w = scipy.signal.windows.hann(200, sym=False);
  // 2 * abs(rfft(w * x, 2048)) / w.sum()
  const AmplitudeSpectrum spectrum = amplitude_spectrum(two_sines(200), kStepS);
  REQUIRE(spectrum.amplitude.size() == 1025);
  CHECK(spectrum.frequency_hz[1] == Approx(0.009765625).epsilon(1e-12));
  CHECK(spectrum.frequency_hz.back() == Approx(10).epsilon(1e-12));
  CHECK(spectrum.amplitude[93] == Approx(0.119987741565).epsilon(1e-10));
  CHECK(spectrum.amplitude[100] == Approx(0.0890756889269).epsilon(1e-10));
  CHECK(spectrum.amplitude[338] == Approx(0.0299989975362).epsilon(1e-10));
  CHECK(spectrum.amplitude[500] == Approx(1.44735315342e-06).epsilon(1e-6));
}

TEST_CASE("A sine's peak has its amplitude and frequency, wherever it falls between two lines") {
  for (const double hz : {0.9, 0.9096, 0.913, 0.92, 3.3333}) {
    std::vector<double> values(400);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = 0.17 * std::sin(2 * std::numbers::pi * hz * kStepS * static_cast<double>(i) + 1);
    }
    const AmplitudeSpectrum spectrum = amplitude_spectrum(values, kStepS);
    CHECK(spectrum.amplitude[spectrum.peak()] == Approx(0.17).epsilon(0.0026));
    // Half a line of 1 / (4096 steps).
    CHECK(std::abs(spectrum.frequency_hz[spectrum.peak()] - hz) < 0.5001 / (4096 * kStepS));
  }
}

TEST_CASE("A mean is no peak, however large") {
  std::vector<double> values = two_sines(200);
  for (double& value : values) {
    value += 100;
  }
  const AmplitudeSpectrum spectrum = amplitude_spectrum(values, kStepS);
  CHECK(spectrum.frequency_hz[spectrum.peak()] == Approx(0.908203125));
}

TEST_CASE("Too few values have no spectrum") {
  CHECK(amplitude_spectrum(two_sines(7), kStepS).amplitude.empty());
  CHECK(amplitude_spectrum(two_sines(8), kStepS).amplitude.size() == 33);
}

TEST_CASE("The longest span is found at the start, in the middle and at the end") {
  const auto span_of = [](const std::vector<bool>& joined) {
    const RowSpan span = longest_span(joined);
    return std::pair(span.begin, span.end);
  };
  CHECK(span_of({}) == std::pair<std::size_t, std::size_t>(0, 0));
  CHECK(span_of({false}) == std::pair<std::size_t, std::size_t>(0, 1));
  CHECK(span_of({false, true, true, false, true}) == std::pair<std::size_t, std::size_t>(0, 3));
  CHECK(span_of({false, false, true, true, false}) == std::pair<std::size_t, std::size_t>(1, 4));
  CHECK(span_of({false, true, false, true, true}) == std::pair<std::size_t, std::size_t>(2, 5));
}
