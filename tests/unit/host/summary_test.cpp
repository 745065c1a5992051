// SPDX-License-Identifier: Apache-2.0
// Tests of what a session counts and how it says so.
#include "host/session/summary.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <utility>

#include "tests/unit/host/scripted_source.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

Summary at_20_hz() {
  return Summary(Acquisition<double>{.rate_hz = 20});
}

/// Counts samples with these numbers, 20 a second.
Summary counted(std::initializer_list<std::uint64_t> seqs) {
  Summary summary = at_20_hz();
  for (const std::uint64_t seq : seqs) {
    summary.count(rest_sample(seq));
  }
  return summary;
}

Estimate<double> flagged(Flags flags) {
  return {.flags = flags};
}

TEST_CASE("Nothing counted is said so", "[session]") {
  CHECK(at_20_hz().text() == "0 samples, 0 lost, 0 with angles");
}

TEST_CASE("One sample has no rate", "[session]") {
  CHECK(counted({0}).text() == "1 samples, 0 lost, 0 with angles");
}

TEST_CASE("The rate is that of the samples' own times", "[session]") {
  CHECK(counted({0, 1, 2}).text() == "3 samples at 20.000 Hz, 0 lost, 0 with angles");
}

TEST_CASE("A rate that was not held is said to the millihertz", "[session]") {
  Summary summary = at_20_hz();
  for (std::uint64_t seq = 0; seq < 101; ++seq) {
    Sample sample = rest_sample(seq);
    sample.t_us = static_cast<std::int64_t>(seq) * 50'010;
    summary.count(sample);
  }
  // 1e6 / 50010
  CHECK(summary.text() == "101 samples at 19.996 Hz, 0 lost, 0 with angles");
}

TEST_CASE("A rate more than a tenth off the nominal one is complained of", "[session]") {
  CHECK_FALSE(counted({0}).rate_complaint());
  for (const auto& [nominal_hz, complaint] : {std::pair{17.9, true}, {18.5, false}, {22.5, true}}) {
    Summary summary(Acquisition<double>{.rate_hz = nominal_hz});
    summary.count(rest_sample(0));
    summary.count(rest_sample(1));
    CAPTURE(nominal_hz);
    CHECK(summary.rate_complaint().has_value() == complaint);
  }
}

TEST_CASE("Lost samples are counted and do not lower the rate", "[session]") {
  CHECK(counted({0, 1, 2, 10, 11, 13}).text() == "6 samples at 20.000 Hz, 8 lost, 0 with angles");
}

TEST_CASE("Only dropouts leave no rate", "[session]") {
  CHECK(counted({0, 2, 4}).text() == "3 samples, 2 lost, 0 with angles");
}

TEST_CASE("A stream that restarts loses no countable samples", "[session]") {
  Summary summary = counted({100, 101});
  Sample sample = rest_sample(0);
  sample.flags = flag::kRestarted;
  summary.count(sample);
  summary.count(rest_sample(1));
  CHECK(summary.text() == "4 samples at 20.000 Hz, 0 lost, 0 with angles");
}

TEST_CASE("Estimates with angles are counted", "[session]") {
  Summary summary = at_20_hz();
  summary.count(Estimate<double>{.attitude = Estimate<double>::Attitude{}});
  summary.count(Estimate<double>{});
  CHECK(summary.text() == "0 samples, 0 lost, 1 with angles");
}

TEST_CASE("Flags are counted in the order of their bits", "[session]") {
  Summary summary = at_20_hz();
  summary.count(flagged(flag::kFilling));
  summary.count(flagged(flag::kFilling | flag::kSaturated));
  summary.count(flagged(flag::kNoSolution));
  CHECK(summary.text() ==
        "0 samples, 0 lost, 0 with angles; flagged: 1 saturated, 2 filling, 1 no_solution");
}

TEST_CASE("Rows that an output dropped are said behind the flags", "[session]") {
  Summary summary = at_20_hz();
  summary.count(flagged(flag::kFilling));
  summary.count_dropped("standard output", 12);
  summary.count_dropped("udp:localhost:9870", 1);
  CHECK(summary.text() ==
        "0 samples, 0 lost, 0 with angles; flagged: 1 filling; dropped: 12 rows by standard "
        "output, 1 rows by udp:localhost:9870");
  CHECK_FALSE(summary.has_problems());
}

TEST_CASE("More than a tenth of disturbed estimates may be the rig's noise, and that is said",
          "[session]") {
  Summary summary = at_20_hz();
  for (int i = 0; i < 200; ++i) {
    summary.count(flagged(i < 20 ? flag::kDisturbed : 0));
  }
  CHECK_FALSE(summary.noise_complaint());
  summary.count(flagged(flag::kDisturbed));
  CHECK(
      summary.noise_complaint() ==
      "21 of 201 estimates are disturbed: unless something moves the pendulum, noise_v or noise_m "
      "of the rig's sensors is too small; 'penduline calibrate rest' measures the noise");
}

TEST_CASE("A moment's hand in a short run says nothing of the rig's noise", "[session]") {
  Summary summary = at_20_hz();
  for (int i = 0; i < 19; ++i) {
    summary.count(flagged(flag::kDisturbed));
  }
  CHECK_FALSE(summary.noise_complaint());
}

TEST_CASE("A flag is fresh once", "[session]") {
  Summary summary = at_20_hz();
  CHECK(summary.count(flagged(flag::kMissing)) == flag::kMissing);
  CHECK(summary.count(flagged(flag::kMissing | flag::kDropout)) == flag::kDropout);
  CHECK(summary.count(flagged(flag::kMissing | flag::kDropout)) == 0);
}

TEST_CASE("A filter that fills and a board that starts are no problems", "[session]") {
  Summary summary = at_20_hz();
  summary.count(flagged(flag::kFilling | flag::kRestarted));
  CHECK_FALSE(summary.has_problems());
}

TEST_CASE("Any other flag is a problem, for good", "[session]") {
  for (const FlagDescription& description : kFlagDescriptions) {
    if ((description.bit & flag::kOrdinary) == 0) {
      Summary summary = at_20_hz();
      summary.count(flagged(description.bit));
      summary.count(flagged(0));
      CAPTURE(std::string(description.name));
      CHECK(summary.has_problems());
    }
  }
}

TEST_CASE("A flag that nobody knows yet is a problem", "[session]") {
  // A newer board's, from bits 3 to 7 of a recording.
  Summary summary = at_20_hz();
  summary.count(flagged(1U << 7U));
  CHECK(summary.has_problems());
}

}  // namespace
