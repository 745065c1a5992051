// SPDX-License-Identifier: Apache-2.0
// Our FIR filter against liquid-dsp's, for each pushed sample.
#include <benchmark/benchmark.h>
#include <liquid/liquid.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include "common/fir.hpp"

namespace penduline::bench {
namespace {

template <class Scalar>
FirTaps<Scalar> taps_of(const benchmark::State& state) {
  return design_lowpass(FilterDesign<Scalar>{.order = static_cast<std::size_t>(state.range(0)) - 1,
                                             .cutoff_of_nyquist = Scalar(0.15)});
}

template <class Scalar>
class OurFilter {
 public:
  explicit OurFilter(const FirTaps<Scalar>& taps) : filter_(taps) {}
  Scalar push(Scalar value) { return filter_.push(value); }

 private:
  FirFilter<Scalar> filter_;
};

class LiquidFilter {
 public:
  explicit LiquidFilter(FirTaps<float> taps)
      : filter_(firfilt_rrrf_create(taps.values.data(), static_cast<unsigned>(taps.count))) {}

  float push(float value) {
    float filtered = 0;
    firfilt_rrrf_push(filter_.get(), value);
    firfilt_rrrf_execute(filter_.get(), &filtered);
    return filtered;
  }

 private:
  struct Destroy {
    void operator()(firfilt_rrrf filter) const { firfilt_rrrf_destroy(filter); }
  };
  std::unique_ptr<std::remove_pointer_t<firfilt_rrrf>, Destroy> filter_;
};

/// Two tones, one that passes and one that does not.
template <class Scalar>
std::vector<Scalar> tones() {
  std::vector<Scalar> values(1000);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto time = static_cast<double>(i);
    values[i] = static_cast<Scalar>(std::sin(0.1 * time) + 0.3 * std::sin(2 * time));
  }
  return values;
}

/// The largest difference from the sum that the filter is defined by, in double.
template <class Scalar, class Filter>
double worst_error(const FirTaps<Scalar>& taps, const std::vector<Scalar>& values) {
  Filter filter(taps);
  double worst = 0;
  for (std::size_t newest = 0; newest < values.size(); ++newest) {
    double expected = 0;
    for (std::size_t i = 0; i < taps.count && i <= newest; ++i) {
      expected += double{taps.values[i]} * double{values[newest - i]};
    }
    worst = std::max(worst, std::abs(double{filter.push(values[newest])} - expected));
  }
  return worst;
}

template <class Scalar, class Filter>
void push_samples(benchmark::State& state) {
  const FirTaps<Scalar> taps = taps_of<Scalar>(state);
  const std::vector<Scalar> values = tones<Scalar>();
  Filter filter(taps);
  for ([[maybe_unused]] auto _ : state) {
    for (const Scalar value : values) {
      benchmark::DoNotOptimize(filter.push(value));
    }
  }
  state.counters["s_per_sample"] = benchmark::Counter(
      static_cast<double>(values.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["worst_error"] = worst_error<Scalar, Filter>(taps, values);
}

BENCHMARK(push_samples<float, OurFilter<float>>)->Name("ours/float")->Arg(16)->Arg(64);
BENCHMARK(push_samples<double, OurFilter<double>>)->Name("ours/double")->Arg(16)->Arg(64);
BENCHMARK(push_samples<float, LiquidFilter>)->Name("liquid/float")->Arg(16)->Arg(64);

}  // namespace
}  // namespace penduline::bench
