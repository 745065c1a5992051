// SPDX-License-Identifier: Apache-2.0
// Tests of the estimators: what they refuse, their rows, Appendix A against SciPy.
#include "host/estimator/estimator.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "common/pipeline.hpp"
#include "host/output/estimate_writer.hpp"
#include "tests/unit/hal/simulated_rigs.hpp"
#include "tests/unit/host/scripted_source.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

constexpr EstimatorOptions kPaper{.kind = EstimatorKind::kPaper};
constexpr EstimatorOptions kAlignedPaper{.kind = EstimatorKind::kPaper, .align = true};
constexpr EstimatorOptions kGn{.kind = EstimatorKind::kGaussNewton};

std::unique_ptr<Estimator> estimator(const EstimatorOptions& options) {
  return make_estimator(options, paper_rig(), {}).value();
}

std::string refusal(const EstimatorOptions& options, const Rig<double>& rig) {
  const auto made = make_estimator(options, rig, {.sensor_count = rig.layout.count});
  return made ? "" : made.error().message;
}

/// All estimates of some samples.
std::vector<Estimate<double>> estimates(const EstimatorOptions& options,
                                        const std::vector<Sample>& samples) {
  KeepingSink sink;
  const auto used = estimator(options);
  for (const Sample& sample : samples) {
    REQUIRE(used->take(sample, sink));
  }
  REQUIRE(used->finish(sink));
  return sink.estimates;
}

std::string finishing_error(std::size_t samples) {
  KeepingSink sink;
  const auto paper = estimator(kPaper);
  for (const Sample& sample : rest_samples(samples)) {
    REQUIRE(paper->take(sample, sink));
  }
  const auto finished = paper->finish(sink);
  return finished ? "" : finished.error().message;
}

std::string row_of(const Estimate<double>& estimate) {
  std::string text;
  append_estimate_row(text, estimate, {});
  return text;
}

/// Counts that a test and a Python script can both make up: floor(x + 0.5) of two sines.
std::vector<Sample> sines(int count) {
  std::vector<Sample> samples = rest_samples(static_cast<std::uint64_t>(count));
  for (int i = 0; i < count; ++i) {
    auto& readings = samples[static_cast<std::size_t>(i)].readings;
    readings[0].on = static_cast<std::int32_t>(std::floor(33000.5 + 4000 * std::sin(0.3 * i)));
    readings[1].on = static_cast<std::int32_t>(std::floor(33100.5 + 3000 * std::sin(0.3 * i + 1)));
  }
  return samples;
}

TEST_CASE("An estimator wants as many sensors as its rig has", "[estimator]") {
  for (const EstimatorOptions& options : {kPaper, kGn}) {
    const auto made = make_estimator(options, paper_rig(), {.sensor_count = 3});
    REQUIRE_FALSE(made);
    CHECK(made.error().message == "the rig has 2 sensors, the samples have 3");
  }
}

TEST_CASE("The paper's estimator refuses a third sensor", "[estimator]") {
  CHECK(refusal(kPaper, rig_with_sensors({{0.02, 0, 0}, {0, 0.02, 0}, {-0.02, 0, 0}})) ==
        "--estimator paper needs two sensors, the rig has 3");
}

TEST_CASE("The paper's estimator refuses a response that is not linear", "[estimator]") {
  Rig<double> rig = paper_rig();
  rig.responses[1].model = InverseSquareResponse<double>{.a_v_m2 = 1e-4, .b_m = 0, .c_v = 0};
  CHECK(refusal(kPaper, rig) ==
        "--estimator paper needs linear responses, that of sensor 2 is another; --estimator gn "
        "takes any");
}

TEST_CASE("gn takes three sensors and any response", "[estimator]") {
  Rig<double> rig = rig_with_sensors({{0.02, 0, 0}, {0, 0.02, 0}, {-0.02, 0, 0}});
  rig.responses[1].model = InverseSquareResponse<double>{.a_v_m2 = 1e-4, .b_m = 0, .c_v = 0};
  CHECK(refusal(kGn, rig).empty());
}

TEST_CASE("The paper's estimator refuses a missing reading", "[estimator]") {
  KeepingSink sink;
  Sample sample = rest_sample(5);
  sample.missing = 0b10;
  const auto taken = estimator(kPaper)->take(sample, sink);
  REQUIRE_FALSE(taken);
  CHECK(taken.error().message ==
        "seq 5: a reading is missing, and --estimator paper needs them all; --estimator gn does "
        "not");
}

TEST_CASE("The paper's estimator needs more samples than it drops", "[estimator]") {
  CHECK(finishing_error(0) ==
        "found 0 samples, --estimator paper needs more than the 28 that it drops");
  CHECK(finishing_error(28) ==
        "found 28 samples, --estimator paper needs more than the 28 that it drops");
  CHECK(finishing_error(29).empty());
}

TEST_CASE("The paper's estimator hands all rows on at the end, one a sample", "[estimator]") {
  KeepingSink sink;
  const auto paper = estimator(kPaper);
  for (const Sample& sample : rest_samples(40)) {
    REQUIRE(paper->take(sample, sink));
  }
  CHECK(sink.estimates.empty());
  REQUIRE(paper->finish(sink));
  REQUIRE(sink.estimates.size() == 40);
  for (std::size_t i = 0; i < 40; ++i) {
    CHECK(sink.estimates[i].seq == i);
    CHECK(sink.estimates[i].t_us == static_cast<std::int64_t>(i) * 50'000);
  }
}

TEST_CASE("The paper's first 28 rows are empty and say that the filter fills", "[estimator]") {
  const auto rows = estimates(kPaper, rest_samples(40));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CAPTURE(i);
    CHECK(rows[i].attitude.has_value() == (i >= 28));
    CHECK(rows[i].flags == (i >= 28 ? 0 : flag::kFilling));
  }
}

TEST_CASE("The paper's angles are SciPy's", "[estimator]") {
  // scipy.signal.lfilter(firwin(16, 0.15), 1, -volts), less 28 samples and the mean, times 0.006,
  // less 0.02; scipy.optimize.fsolve of reading.md's six equations; less the mean angles. Position
  // as Appendix A prints it: -l sin(theta2), l sin(theta1), -l cos(theta2) cos(theta1).
  struct Expected {
    std::size_t row;
    std::array<double, 5> values;
  };
  const auto rows = estimates(kPaper, sines(120));
  for (const Expected& expected : {
           Expected{28,
                    {-0.025837553575376055, -0.008537458094188561, 0.0025612063143762727,
                     -0.0077504036707647115, -0.299888939181411}},
           Expected{60,
                    {0.03321126736486217, -0.004397794388925285, 0.0013193340638835824,
                     0.009961548728533333, -0.29983166747986995}},
           Expected{119,
                    {-0.0017112760436985637, 0.04057548939785564, -0.012169306980185625,
                     -0.0005133825625389461, -0.29975263942065383}},
       }) {
    CAPTURE(expected.row);
    const auto& attitude = rows[expected.row].attitude.value();
    CHECK_THAT(attitude.angles.theta1_rad, Catch::WithinAbs(expected.values[0], 1e-12));
    CHECK_THAT(attitude.angles.theta2_rad, Catch::WithinAbs(expected.values[1], 1e-12));
    CHECK_THAT(attitude.mass_m.x(), Catch::WithinAbs(expected.values[2], 1e-12));
    CHECK_THAT(attitude.mass_m.y(), Catch::WithinAbs(expected.values[3], 1e-12));
    CHECK_THAT(attitude.mass_m.z(), Catch::WithinAbs(expected.values[4], 1e-12));
  }
}

TEST_CASE("Aligning takes 7.5 periods from the paper's times and changes nothing else",
          "[estimator]") {
  const auto plain = estimates(kPaper, sines(60));
  auto aligned = estimates(kAlignedPaper, sines(60));
  REQUIRE(aligned.size() == plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    CAPTURE(i);
    CHECK(aligned[i].t_us == plain[i].t_us - 375'000);
    aligned[i].t_us = plain[i].t_us;
    CHECK(row_of(aligned[i]) == row_of(plain[i]));
  }
}

TEST_CASE("The paper's rows carry the flags of their samples", "[estimator]") {
  std::vector<Sample> samples = rest_samples(50);
  samples[0].flags = flag::kRestarted;
  samples[40].seq = samples[40].seq + 2;
  samples[40].t_us += 100'000;
  const auto rows = estimates(kPaper, samples);
  CHECK(rows[0].flags == (flag::kRestarted | flag::kFilling));
  CHECK(rows[40].flags == flag::kDropout);
  CHECK(rows[41].flags == flag::kOutOfOrder);
}

TEST_CASE("A saturated sample stays with every row of the paper's that it went into",
          "[estimator]") {
  // docs/formats.md, "Flags"; 16 taps.
  std::vector<Sample> samples = rest_samples(60);
  samples[35].flags = flag::kSaturated;
  const auto rows = estimates(kPaper, samples);
  for (std::size_t i = 28; i < rows.size(); ++i) {
    CAPTURE(i);
    CHECK(rows[i].flags == (i >= 35 && i <= 50 ? flag::kSaturated : 0));
  }
}

TEST_CASE("gn hands a row on for each sample at once", "[estimator]") {
  KeepingSink sink;
  const auto gn = estimator(kGn);
  for (std::uint64_t seq = 0; seq < 40; ++seq) {
    REQUIRE(gn->take(rest_sample(seq), sink));
    REQUIRE(sink.estimates.size() == seq + 1);
  }
  REQUIRE(gn->finish(sink));
  CHECK(sink.estimates.size() == 40);
}

TEST_CASE("gn is the pipeline of common, bit for bit", "[estimator]") {
  SimulationSettings settings{.start = kCaseTwo, .gap_noise_m = 5e-5};
  SampledRig rig(paper_rig(), settings);
  const auto gn = make_estimator(kGn, paper_rig(), rig.acquisition()).value();
  Pipeline<double> pipeline(paper_rig(), rig.acquisition());
  KeepingSink sink;
  for (Sample sample; rig.read(sample).value();) {
    REQUIRE(gn->take(sample, sink));
    const Estimate<double> expected = pipeline.update(sample);
    const Estimate<double>& found = sink.estimates.back();
    REQUIRE(found.t_us == expected.t_us);
    REQUIRE(found.seq == expected.seq);
    REQUIRE(found.flags == expected.flags);
    REQUIRE(found.residual_m == expected.residual_m);
    REQUIRE(found.attitude.has_value() == expected.attitude.has_value());
    if (expected.attitude) {
      REQUIRE(found.attitude->angles.theta1_rad == expected.attitude->angles.theta1_rad);
      REQUIRE(found.attitude->angles.theta2_rad == expected.attitude->angles.theta2_rad);
      REQUIRE(found.attitude->mass_m == expected.attitude->mass_m);
    }
  }
  CHECK(sink.estimates.size() == 200);
}

}  // namespace
