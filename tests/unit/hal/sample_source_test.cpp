// SPDX-License-Identifier: Apache-2.0
// One suite for every backend that is a stream of samples: a simulation, and its recording.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>

#include "hal/replay/recording_format.hpp"
#include "hal/replay/recording_reader.hpp"
#include "hal/sim/sampled_rig.hpp"
#include "tests/unit/hal/recording_text.hpp"
#include "tests/unit/hal/simulated_rigs.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

constexpr std::uint64_t kSamples = 100;
constexpr double kRateHz = 30;  // its period is no whole number of microseconds

/// Three sensors of which one saturates now and then, with noise.
SampledRig three_sensor_simulation() {
  Rig<double> rig = rig_with_sensors({{0.02, 0, 0}, {-0.01, 0.017, 0}, {-0.01, -0.017, 0}});
  rig.responses[2].model = LinearResponse<double>{.gap_at_zero_m = 0.01, .slope_m_per_v = 0.0032};
  SimulationSettings settings{.start = kCaseTwo, .rate_hz = kRateHz};
  settings.duration_s = static_cast<double>(kSamples) / kRateHz;
  return {rig, settings};
}

/// The simulation itself as the source under test.
class Simulated {
 public:
  using Source = SampledRig;
  Source& source() { return rig_; }

 private:
  SampledRig rig_ = three_sensor_simulation();
};

/// A recording of the same simulation as the source under test.
class Recorded {
 public:
  using Source = RecordingReader;
  Recorded() {
    SampledRig rig = three_sensor_simulation();
    std::string text = recording_head(
        {.acquisition = rig.acquisition(), .board = "sim", .firmware = "", .started = ""});
    for (Sample sample; rig.read(sample).value();) {
      append_recording_row(text, sample, rig.acquisition().sensor_count);
    }
    reader_ = std::make_unique<RecordingReader>(
        RecordingReader::open(folder_.write("rec.csv", text)).value());
  }
  Source& source() { return *reader_; }

 private:
  TemporaryFolder folder_;
  std::unique_ptr<RecordingReader> reader_;
};

TEMPLATE_TEST_CASE("A source says how its samples are taken", "[source]", Simulated, Recorded) {
  TestType backend;
  const Acquisition<double>& acquisition = backend.source().acquisition();
  CHECK(acquisition.rate_hz == kRateHz);
  CHECK(acquisition.full_scale_counts == 65535);
  CHECK(acquisition.reference_v == 3.3);
  CHECK(acquisition.sensor_count == 3);
}

TEMPLATE_TEST_CASE("A source gives its samples in order, each once", "[source]", Simulated,
                   Recorded) {
  TestType backend;
  Sample sample;
  std::uint64_t count = 0;
  for (; backend.source().read(sample).value(); ++count) {
    REQUIRE(sample.seq == count);
  }
  CHECK(count == kSamples);
}

TEMPLATE_TEST_CASE("A source's times are seq over rate", "[source]", Simulated, Recorded) {
  TestType backend;
  for (Sample sample; backend.source().read(sample).value();) {
    CAPTURE(sample.seq);
    REQUIRE(sample.t_us == std::llround(static_cast<double>(sample.seq) * 1e6 / kRateHz));
  }
}

TEMPLATE_TEST_CASE("A source keeps to its full scale", "[source]", Simulated, Recorded) {
  TestType backend;
  for (Sample sample; backend.source().read(sample).value();) {
    for (std::size_t i = 0; i < 3; ++i) {
      REQUIRE(sample.readings[i].on >= 0);
      REQUIRE(sample.readings[i].on <= 65535);
      REQUIRE(sample.readings[i].off >= 0);
      REQUIRE(sample.readings[i].off <= 65535);
    }
  }
}

TEMPLATE_TEST_CASE("A source leaves no trace of an earlier sample in the next", "[source]",
                   Simulated, Recorded) {
  TestType backend;
  Sample sample{.missing = 0xff, .flags = 0xffff};
  sample.readings.fill({.on = -1, .off = -1});
  REQUIRE(backend.source().read(sample).value());
  CHECK(sample.missing == 0);
  CHECK((sample.flags & ~flag::kSaturated) == 0);
  CHECK(sample.readings[3].on == 0);
}

TEMPLATE_TEST_CASE("A source that has ended stays ended", "[source]", Simulated, Recorded) {
  TestType backend;
  Sample sample;
  while (backend.source().read(sample).value()) {
  }
  for (int i = 0; i < 3; ++i) {
    CHECK_FALSE(backend.source().read(sample).value());
  }
}

TEMPLATE_TEST_CASE("A source's progress rises to 1", "[source]", Simulated, Recorded) {
  TestType backend;
  double last = 0;
  for (Sample sample; backend.source().read(sample).value();) {
    REQUIRE(backend.source().progress() > last);
    last = backend.source().progress();
  }
  CHECK(last == 1);
}

TEST_CASE("A simulation and its recording give the same samples", "[source]") {
  Simulated simulated;
  Recorded recorded;
  Sample one;
  Sample other;
  Flags flags = 0;
  while (simulated.source().read(one).value()) {
    REQUIRE(recorded.source().read(other).value());
    REQUIRE(shown(one, 3) == shown(other, 3));
    flags |= one.flags;
  }
  CHECK_FALSE(recorded.source().read(other).value());
  // Else the flags' column would not have been tried.
  CHECK(flags == flag::kSaturated);
}

}  // namespace
