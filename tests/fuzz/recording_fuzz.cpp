// SPDX-License-Identifier: Apache-2.0
// Any bytes as a recording: samples in their ranges or one clear message, never wrong angles.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "common/pipeline.hpp"
#include "hal/replay/recording_reader.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace {

using namespace penduline;
using namespace penduline::fuzz;

void check_acquisition(const Acquisition<double>& acquisition) {
  require(std::isfinite(acquisition.rate_hz) && acquisition.rate_hz > 0, "a rate is above 0");
  require(std::isfinite(acquisition.reference_v) && acquisition.reference_v > 0,
          "a reference is above 0");
  require(acquisition.full_scale_counts >= 1 && acquisition.full_scale_counts <= 2147483647,
          "full scale fits the readings");
  require(acquisition.sensor_count >= 2 && acquisition.sensor_count <= kMaxSensors,
          "two to eight sensors");
}

void check_event(const RecordingEvent& event) {
  const std::string line = event_line(event);
  require(line.size() <= kMaxEventBytes && line.find('\n') == line.size() - 1,
          "an event is one line that is not too long");
  const auto again = parse_event(line);
  require(again && event_line(*again) == line, "an event that was read can be written and read");
}

void check_sample(const Sample& sample, const Acquisition<double>& acquisition) {
  require(sample.t_us >= 0, "times do not go below 0");
  require((sample.missing >> acquisition.sensor_count) == 0, "only sensors miss readings");
  for (std::size_t i = 0; i < acquisition.sensor_count; ++i) {
    const Reading& reading = sample.readings[i];
    require(reading.on >= 0 && reading.on <= acquisition.full_scale_counts && reading.off >= 0 &&
                reading.off <= acquisition.full_scale_counts,
            "readings are within full scale");
  }
}

/// Reads a recording to its end or its error; returns what was read, written again.
std::string read_and_check(const std::string& path) {
  auto reader = RecordingReader::open(path);
  if (!reader) {
    check_message(reader.error().message, path);
    return {};
  }
  const Acquisition<double>& acquisition = reader->acquisition();
  check_acquisition(acquisition);
  std::string text = recording_head(reader->header());
  const Rig<double> rig = rig_with(acquisition.sensor_count);
  Pipeline<double> pipeline(rig, acquisition);
  for (Sample sample;;) {
    const auto more = reader->read(sample);
    for (const RecordingEvent& event : reader->events()) {
      check_event(event);
    }
    if (!more) {
      check_message(more.error().message, path);
      break;
    }
    if (!*more) {
      break;
    }
    check_sample(sample, acquisition);
    check_estimate(pipeline.update(sample), sample, rig.pendulum.length_m);
    append_recording_row(text, sample, acquisition.sensor_count);
  }
  for (const std::string& complaint : reader->complaints()) {
    check_message(complaint, path);
  }
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const InputFile input(data, size);
  const std::string written = read_and_check(input.path());
  if (!written.empty()) {
    const InputFile again(written);
    require(read_and_check(again.path()) == written, "what was read can be written and read again");
  }
  return 0;
}
