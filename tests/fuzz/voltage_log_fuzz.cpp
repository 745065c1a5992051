// SPDX-License-Identifier: Apache-2.0
// Any bytes as a foreign log of voltages: samples in their ranges or one clear message.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "common/pipeline.hpp"
#include "hal/replay/voltage_log_reader.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace {

using namespace penduline;
using namespace penduline::fuzz;

void read_and_check(const std::string& path, const char* columns, std::optional<double> rate_hz) {
  auto layout = parse_log_layout(columns).value();
  layout.rate_hz = rate_hz;
  auto reader = VoltageLogReader::open(path, layout);
  if (!reader) {
    check_message(reader.error().message, path);
    return;
  }
  const Acquisition<double>& acquisition = reader->acquisition();
  require(std::isfinite(acquisition.rate_hz) && acquisition.rate_hz > 0, "a rate is above 0");
  const Rig<double> rig = rig_with(acquisition.sensor_count);
  Pipeline<double> pipeline(rig, acquisition);
  std::uint64_t least_seq = 0;
  for (Sample sample;;) {
    const auto more = reader->read(sample);
    if (!more) {
      check_message(more.error().message, path);
      return;
    }
    if (!*more) {
      return;
    }
    require(sample.seq >= least_seq, "samples are counted upwards");
    least_seq = sample.seq + 1;
    check_estimate(pipeline.update(sample), sample, rig.pendulum.length_m);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const InputFile input(data, size);
  read_and_check(input.path(), "x,y", 20);
  read_and_check(input.path(), "t_s,x,y", std::nullopt);
  read_and_check(input.path(), "-,t_us,s3,y,x", 200);
  return 0;
}
