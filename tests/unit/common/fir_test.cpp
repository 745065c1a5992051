// SPDX-License-Identifier: Apache-2.0
// Tests of the FIR filters: design against SciPy, streaming against lfilter, start and restart.
#include "common/fir.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>

#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

/// The largest difference from a filter whose first half, and middle if there is one, is given.
template <class Scalar>
double worst_tap(const FirTaps<Scalar>& taps, std::span<const double> first_half) {
  Worst worst;
  for (std::size_t i = 0; i < first_half.size(); ++i) {
    worst.note(double{taps.values[i]} - first_half[i]);
    worst.note(double{taps.values[taps.count - 1 - i]} - first_half[i]);
  }
  return worst.value();
}

// float: a tap is a product of a sine and a cosine, each good to a few units of 6e-8.
template <class Scalar>
constexpr double kTapTolerance = tolerance<Scalar>(1e-12, 2e-7);

template <class Scalar>
FirTaps<Scalar> paper_taps() {
  return design_lowpass(FilterDesign<Scalar>{.order = 15, .cutoff_of_nyquist = Scalar(0.15)});
}

TEMPLATE_TEST_CASE("The paper's filter has SciPy's taps", "[fir]", float, double) {
  // scipy.signal.firwin(16, 0.15), mirrored; Octave's fir1(15, 0.15) gives the same
  constexpr std::array kExpected = {
      -0.0014536959924780313, 0.000514849029842172, 0.007855786810225586, 0.0268460396171738,
      0.059653373104677596,   0.10133775326505247,  0.140644770676549,    0.16460112348895725};
  const FirTaps<TestType> taps = paper_taps<TestType>();
  REQUIRE(taps.count == 16);
  CHECK(worst_tap(taps, kExpected) <= kTapTolerance<TestType>);
}

TEMPLATE_TEST_CASE("A filter of odd order and wider band has SciPy's taps", "[fir]", float,
                   double) {
  // scipy.signal.firwin(22, 0.35), mirrored
  constexpr std::array kExpected = {
      -0.002074482685628727, -0.002878572231694991, 0.00047140924418761745, 0.00995983211160145,
      0.013894791638764819,  -0.00685320492996299,  -0.044324166835938435,  -0.04562579414828429,
      0.042878889214576464,  0.20256408394817746,   0.33198721467420156};
  const auto taps =
      design_lowpass(FilterDesign<TestType>{.order = 21, .cutoff_of_nyquist = TestType(0.35)});
  REQUIRE(taps.count == 22);
  CHECK(worst_tap(taps, kExpected) <= kTapTolerance<TestType>);
}

TEMPLATE_TEST_CASE("A filter of even order has SciPy's taps", "[fir]", float, double) {
  // scipy.signal.firwin(9, 0.3), mirrored about the fifth
  constexpr std::array kExpected = {-0.004086370034955041, 0.007688553214683218,
                                    0.08926045569674573, 0.2433312342481741, 0.3276122537507039};
  const auto taps =
      design_lowpass(FilterDesign<TestType>{.order = 8, .cutoff_of_nyquist = TestType(0.3)});
  REQUIRE(taps.count == 9);
  CHECK(worst_tap(taps, kExpected) <= kTapTolerance<TestType>);
}

TEMPLATE_TEST_CASE("The longest filter has SciPy's taps", "[fir]", float, double) {
  // scipy.signal.firwin(64, 0.1), the first eight, mirrored
  constexpr std::array kExpected = {-0.0003665378844056722, -0.0001341684483773098,
                                    0.00015023857952374152, 0.0005086115122694398,
                                    0.000949195195761419,   0.0014538657616919816,
                                    0.0019692588210439726,  0.0024044990938897593};
  const auto taps = design_lowpass(
      FilterDesign<TestType>{.order = kMaxTaps - 1, .cutoff_of_nyquist = TestType(0.1)});
  REQUIRE(taps.count == kMaxTaps);
  CHECK(worst_tap(taps, kExpected) <= kTapTolerance<TestType>);
}

TEMPLATE_TEST_CASE("Order 0 is one tap of 1", "[fir]", float, double) {
  const auto taps = design_lowpass(FilterDesign<TestType>{});
  REQUIRE(taps.count == 1);
  CHECK(taps.values[0] == 1);
}

TEMPLATE_TEST_CASE("An even filter with its cutoff at Nyquist is a pure delay", "[fir]", float,
                   double) {
  const auto taps = design_lowpass(FilterDesign<TestType>{.order = 8, .cutoff_of_nyquist = 1});
  constexpr std::array kExpected = {0.0, 0.0, 0.0, 0.0, 1.0};
  CHECK(worst_tap(taps, kExpected) <= kTapTolerance<TestType>);
}

TEMPLATE_TEST_CASE("Filters of every order let a constant through unchanged", "[fir]", float,
                   double) {
  Worst worst;
  for (std::size_t order = 0; order < kMaxTaps; ++order) {
    for (const double cutoff : {0.01, 0.15, 0.5, 0.99}) {
      const auto taps =
          design_lowpass(FilterDesign<TestType>{order, static_cast<TestType>(cutoff)});
      worst.note(double{gain_at(taps, TestType(0))} - 1);
    }
  }
  // Up to 64 roundings of the sum: 64 * 1.1e-16 and 64 * 6e-8.
  CHECK(worst.value() <= tolerance<TestType>(1e-14, 4e-6));
}

TEMPLATE_TEST_CASE("The paper's filter takes 18 % from the pendulum's own frequency", "[fir]",
                   float, double) {
  // scipy.signal.freqz(firwin(16, 0.15), worN=[w]): w = 2 pi f / 20 Hz, f = sqrt(9.8/0.3)/(2 pi)
  const TestType gain = gain_at(paper_taps<TestType>(), TestType(0.09096462681059556));
  CHECK_THAT(gain, Catch::WithinAbs(0.8155966614860342, tolerance<TestType>(1e-12, 1e-6)));
}

TEMPLATE_TEST_CASE("The paper's filter halves a signal near its cutoff and stops one far above",
                   "[fir]", float, double) {
  const FirTaps<TestType> taps = paper_taps<TestType>();
  // scipy.signal.freqz(firwin(16, 0.15), worN=[0.15 pi, 0.5 pi])
  const double bar = tolerance<TestType>(1e-12, 1e-6);
  CHECK_THAT(gain_at(taps, TestType(0.15)), Catch::WithinAbs(0.5624096701210128, bar));
  CHECK_THAT(gain_at(taps, TestType(0.5)), Catch::WithinAbs(0.000998886705842949, bar));
}

TEMPLATE_TEST_CASE("The streaming filter from zero gives what SciPy's lfilter gives", "[fir]",
                   float, double) {
  constexpr std::array kSignal = {1.0, -2.0, 0.5,   3.0,  0.0, 0.0, 1.5, -1.0, 2.0, 2.0,
                                  2.0, -.25, 0.750, 1.00, 1.0, 1.0, 1.0, 1.00, 1.0, 1.0};
  // scipy.signal.lfilter(firwin(16, 0.15), 1, signal)
  constexpr std::array kExpected = {
      -0.0014536959924780313, 0.0034222410147982346, 0.006099240754302226, 0.00703080253420962,
      0.011433734364969302,   0.01902138729496094,   0.04615352556158723,  0.11516654761965951,
      0.2180959608450148,     0.3462129761630236,    0.4726200438583269,   0.5842536540852227,
      0.6772632996320977,     0.7669033945314161,    0.8610002536097874,   0.9536540718757562,
      1.0309566424375192,     1.0629125156432717,    1.0485092961744324,   1.005908872946244};
  FirFilter<TestType> filter(paper_taps<TestType>());
  Worst worst;
  for (std::size_t i = 0; i < kSignal.size(); ++i) {
    worst.note(double{filter.push(static_cast<TestType>(kSignal[i]))} - kExpected[i]);
  }
  CHECK(worst.value() <= tolerance<TestType>(1e-15, 1e-6));
}

TEMPLATE_TEST_CASE("A pulse comes out as the taps in their order, for every length", "[fir]", float,
                   double) {
  for (std::size_t count = 1; count <= kMaxTaps; ++count) {
    FirTaps<TestType> taps{.count = count};
    std::iota(taps.values.begin(), taps.values.begin() + count, TestType(1));
    FirFilter<TestType> filter(taps);
    // A second pulse after the first has gone round the history once.
    for (int pulse = 0; pulse < 2; ++pulse) {
      for (std::size_t i = 0; i < count; ++i) {
        CAPTURE(count, pulse, i);
        REQUIRE(filter.push(i == 0 ? 1 : 0) == static_cast<TestType>(i + 1));
      }
      REQUIRE(filter.push(0) == 0);
    }
  }
}

TEST_CASE("A filter is full after as many values as it has taps, not one earlier", "[fir]") {
  for (const std::size_t order : {0U, 1U, 15U, 63U}) {
    FirFilter<double> filter(design_lowpass(FilterDesign<double>{order, 0.5}));
    for (std::size_t i = 0; i < order; ++i) {
      filter.push(1);
    }
    CAPTURE(order);
    CHECK_FALSE(filter.full());
    filter.push(1);
    CHECK(filter.full());
  }
}

TEST_CASE("A filter stays full", "[fir]") {
  FirFilter<double> filter(paper_taps<double>());
  for (int i = 0; i < 100; ++i) {
    filter.push(1);
  }
  CHECK(filter.full());
}

TEST_CASE("A cleared filter answers like a new one", "[fir]") {
  FirFilter<double> used(paper_taps<double>());
  for (int i = 0; i < 21; ++i) {
    used.push(1000 + i);
  }
  used.clear();
  FirFilter<double> fresh(paper_taps<double>());
  CHECK_FALSE(used.full());
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    REQUIRE(used.push(i) == fresh.push(i));
  }
}

TEST_CASE("A filter made of nothing passes the signal on", "[fir]") {
  FirFilter<float> filter;
  CHECK(filter.push(0.25F) == 0.25F);
  CHECK(filter.full());
}

TEMPLATE_TEST_CASE("The default filter bends the pendulum's own amplitude by less than 1 %",
                   "[fir]", float, double) {
  Worst worst;
  for (int i = 0; i <= 40; ++i) {
    const double length_m = 0.1 * std::pow(20.0, i / 40.0);
    const double pendulum_hz = std::sqrt(9.8 / length_m) / (2 * std::numbers::pi);
    for (int j = 0; j <= 80; ++j) {
      const double rate_hz = 5 * std::pow(200.0, j / 80.0);
      const auto taps = design_lowpass(
          default_filter(static_cast<TestType>(rate_hz), static_cast<TestType>(pendulum_hz)));
      const double of_nyquist = pendulum_hz / (rate_hz / 2);
      worst.note(double{gain_at(taps, static_cast<TestType>(of_nyquist))} - 1);
    }
  }
  CHECK(worst.value() < 0.01);
}

TEST_CASE("The default filter stands aside where the rate leaves it no room", "[fir]") {
  CHECK(default_filter(5.0, 1.0).order == 0);
}

TEST_CASE("The default filter lessens white noise at 20 Hz", "[fir]") {
  const auto taps = design_lowpass(default_filter(20.0, 0.9096));
  double power = 0;
  for (const double tap : taps.values) {
    power += tap * tap;
  }
  CHECK(power < 0.8);
}

}  // namespace
}  // namespace penduline::test
