// SPDX-License-Identifier: Apache-2.0
// Properties of the FIR filter: linear, the same at any time, symmetric, never above its input.
#include <rapidcheck/catch.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "common/fir.hpp"
#include "tests/property/generators.hpp"

namespace penduline::test {
namespace {

FirTaps<double> any_taps() {
  return design_lowpass(FilterDesign<double>{.order = *rc::gen::inRange<std::size_t>(0, kMaxTaps),
                                             .cutoff_of_nyquist = *in_steps(0.01, 1)});
}

std::vector<double> any_signal(std::size_t length) {
  return *rc::gen::container<std::vector<double>>(length, in_steps(-5, 5));
}

std::vector<double> filtered(const FirTaps<double>& taps, const std::vector<double>& signal) {
  FirFilter<double> filter(taps);
  std::vector<double> result(signal.size());
  std::ranges::transform(signal, result.begin(), [&](double value) { return filter.push(value); });
  return result;
}

// 64 products of numbers up to 15, each rounded.
constexpr double kSlack = 64 * 15 * 2.3e-16;

TEST_CASE("Filtering is linear", "[property]") {
  rc::prop("filtered(a x + y) == a filtered(x) + filtered(y)", [] {
    const auto taps = any_taps();
    const auto x = any_signal(150);
    const auto y = any_signal(150);
    const double factor = *in_steps(-2, 2);
    std::vector<double> sum(150);
    std::ranges::transform(x, y, sum.begin(), [=](double a, double b) { return factor * a + b; });
    const auto of_x = filtered(taps, x);
    const auto of_y = filtered(taps, y);
    const auto of_sum = filtered(taps, sum);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      RC_ASSERT(std::abs(of_sum[i] - (factor * of_x[i] + of_y[i])) <= kSlack);
    }
  });
}

TEST_CASE("Filtering is the same at any time", "[property]") {
  rc::prop("a signal that comes later is filtered to the same bits, later", [] {
    const auto taps = any_taps();
    const auto signal = any_signal(100);
    const auto delay = *rc::gen::inRange<std::ptrdiff_t>(0, 150);
    std::vector<double> later(static_cast<std::size_t>(delay));
    later.insert(later.end(), signal.begin(), signal.end());
    const auto now = filtered(taps, signal);
    const auto then = filtered(taps, later);
    RC_ASSERT(std::equal(now.begin(), now.end(), then.begin() + delay));
  });
}

TEST_CASE("A value is forgotten after as many others as the filter has taps", "[property]") {
  rc::prop("what went in before the window does not matter", [] {
    const auto taps = any_taps();
    auto signal = any_signal(kMaxTaps + 40);
    const auto before = filtered(taps, signal);
    signal[39] += *in_steps(1, 1000);
    const auto after = filtered(taps, signal);
    RC_ASSERT(std::equal(before.begin() + 39 + static_cast<std::ptrdiff_t>(taps.count),
                         before.end(),
                         after.begin() + 39 + static_cast<std::ptrdiff_t>(taps.count)));
    RC_ASSERT(std::equal(before.begin(), before.begin() + 39, after.begin()));
  });
}

TEST_CASE("Every designed filter reads the same both ways, so that its delay is half its order",
          "[property]") {
  rc::prop("taps are symmetric", [] {
    const auto taps = any_taps();
    for (std::size_t i = 0; i < taps.count; ++i) {
      RC_ASSERT(std::abs(taps.values[i] - taps.values[taps.count - 1 - i]) <= 1e-14);
    }
  });
}

}  // namespace
}  // namespace penduline::test
