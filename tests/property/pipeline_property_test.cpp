// SPDX-License-Identifier: Apache-2.0
// Properties of the pipeline: for any samples, an answer is finite and whole, or absent and
// flagged.
#include <rapidcheck/catch.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "common/pipeline.hpp"
#include "tests/property/generators.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

template <class Scalar>
typename Response<Scalar>::Model any_model() {
  constexpr std::array<Scalar, 4> kVolts = {Scalar(0.31), Scalar(0.42), Scalar(0.55), Scalar(2.1)};
  constexpr std::array<Scalar, 4> kGaps = {Scalar(0.026), Scalar(0.02), Scalar(0.016),
                                           Scalar(0.003)};
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return LinearResponse<Scalar>{Scalar(kGapAtZero), Scalar(kSlope)};
    case 1:
      return TableResponse<Scalar>{MonotoneCubic<Scalar>(kVolts, kGaps)};
    case 2:
      return InverseSquareResponse<Scalar>{Scalar(2e-4), Scalar(0.004), Scalar(0.05)};
    default:
      // As many powers as there may be: extreme readings overflow a float.
      return PolynomialResponse<Scalar>{
          {Scalar(0.03), Scalar(-0.008), 0, 0, 0, 0, 0, Scalar(-1e-5)}, 8, 0, Scalar(3.3)};
  }
}

template <class Scalar>
Rig<Scalar> any_rig() {
  const auto layout = *any_layout();
  Rig<Scalar> rig;
  rig.layout.count = layout.count;
  rig.layout.disc_offset_m = static_cast<Scalar>(layout.disc_offset_m);
  for (std::size_t i = 0; i < layout.count; ++i) {
    rig.layout.position_m[i] = layout.position_m[i].cast<Scalar>();
    rig.responses[i].model = any_model<Scalar>();
    rig.responses[i].nearest_m = Scalar(0.003);
    rig.responses[i].farthest_m = Scalar(0.04);
  }
  // Short filters, so that many rows are answered.
  rig.filter = FilterDesign<Scalar>{*rc::gen::inRange<std::size_t>(0, 6), Scalar(0.5)};
  return rig;
}

/// Runs a pipeline on a stream with faults and shows every estimate to the check.
template <class Scalar, class Check>
void for_any_stream(const Check& check) {
  const Rig<Scalar> rig = any_rig<Scalar>();
  Pipeline<Scalar> pipeline(rig, Acquisition<Scalar>{.sensor_count = rig.layout.count});
  Sample sample;
  for (int i = 0; i < 60; ++i) {
    sample = sample_after(sample);
    check(rig, sample, pipeline.update(sample));
  }
}

TEMPLATE_TEST_CASE("An attitude is never given together with no_solution", "[property]", float,
                   double) {
  rc::prop("attitude or no_solution", [] {
    for_any_stream<TestType>([](const auto&, const Sample&, const Estimate<TestType>& estimate) {
      RC_ASSERT(!(estimate.attitude && (estimate.flags & flag::kNoSolution) != 0));
    });
  });
}

TEMPLATE_TEST_CASE("An absent attitude always has a flag that says why", "[property]", float,
                   double) {
  rc::prop("attitude or a reason", [] {
    constexpr Flags kReasons =
        flag::kMissing | flag::kFilling | flag::kOutOfRange | flag::kNoSolution;
    for_any_stream<TestType>([](const auto&, const Sample&, const Estimate<TestType>& estimate) {
      RC_ASSERT(estimate.attitude || (estimate.flags & kReasons) != 0);
    });
  });
}

TEMPLATE_TEST_CASE("A missing answer is absent whole, never zeros", "[property]", float, double) {
  rc::prop("attitude and residual come and go together", [] {
    for_any_stream<TestType>([](const auto&, const Sample&, const Estimate<TestType>& estimate) {
      RC_ASSERT(estimate.attitude.has_value() == estimate.residual_m.has_value());
    });
  });
}

TEMPLATE_TEST_CASE("Any answer is finite, whatever the readings", "[property]", float, double) {
  rc::prop("angles, position and residual are finite", [] {
    for_any_stream<TestType>([](const auto&, const Sample&, const Estimate<TestType>& estimate) {
      if (estimate.attitude) {
        RC_ASSERT(std::isfinite(estimate.attitude->angles.theta1_rad));
        RC_ASSERT(std::isfinite(estimate.attitude->angles.theta2_rad));
        RC_ASSERT(estimate.attitude->mass_m.allFinite());
        RC_ASSERT(std::isfinite(*estimate.residual_m));
      }
    });
  });
}

TEMPLATE_TEST_CASE("The mass of any answer is as far from the pivot as the rod is long",
                   "[property]", float, double) {
  rc::prop("position is on the sphere", [] {
    for_any_stream<TestType>(
        [](const Rig<TestType>& rig, const Sample&, const Estimate<TestType>& estimate) {
          if (estimate.attitude) {
            const double length_m = estimate.attitude->mass_m.norm();
            RC_ASSERT(std::abs(length_m / double{rig.pendulum.length_m} - 1) <=
                      tolerance<TestType>(1e-15, 5e-7));
          }
        });
  });
}

TEMPLATE_TEST_CASE("Every row has its sample's number and flags", "[property]", float, double) {
  rc::prop("seq and the device's flags go through", [] {
    for_any_stream<TestType>(
        [](const auto&, const Sample& sample, const Estimate<TestType>& estimate) {
          RC_ASSERT(estimate.seq == sample.seq);
          RC_ASSERT((estimate.flags & sample.flags) == sample.flags);
        });
  });
}

TEST_CASE("The same samples give the same estimates to the last bit", "[property]") {
  rc::prop("two pipelines of one rig agree", [] {
    const auto rig = any_rig<double>();
    const Acquisition<double> acquisition{.sensor_count = rig.layout.count};
    Pipeline<double> first(rig, acquisition);
    Pipeline<double> second(rig, acquisition);
    Sample sample;
    for (int i = 0; i < 60; ++i) {
      sample = sample_after(sample);
      const auto one = first.update(sample);
      const auto other = second.update(sample);
      RC_ASSERT(one.flags == other.flags);
      RC_ASSERT(one.t_us == other.t_us);
      RC_ASSERT(one.attitude.has_value() == other.attitude.has_value());
      if (one.attitude) {
        RC_ASSERT(one.attitude->mass_m == other.attitude->mass_m);
      }
    }
  });
}

}  // namespace
}  // namespace penduline::test
