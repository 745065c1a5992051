// SPDX-License-Identifier: Apache-2.0
// The pipeline for each sample, and the parts of a replay around it: reading a row, writing a row.
#include <benchmark/benchmark.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include "common/pipeline.hpp"
#include "common/swing_tracker.hpp"
#include "hal/replay/recording_format.hpp"
#include "hal/replay/recording_reader.hpp"
#include "hal/sim/sampled_rig.hpp"
#include "host/output/estimate_writer.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::bench {
namespace {

constexpr int kRateHz = 1000;

enum class Model {
  kLinear,  ///< as in docs/rigs/paper.toml
  kTable,   ///< as in docs/rigs/tcrt5000.toml, from the curve's peak on
};

template <class Scalar>
Response<Scalar> response_of(Model model) {
  constexpr std::array kVolts = {Scalar(0.243), Scalar(0.378), Scalar(0.515), Scalar(0.675),
                                 Scalar(0.91),  Scalar(1.26),  Scalar(1.48),  Scalar(1.69),
                                 Scalar(1.85),  Scalar(1.90)};
  constexpr std::array kGapsM = {Scalar(0.020), Scalar(0.015), Scalar(0.012), Scalar(0.010),
                                 Scalar(0.008), Scalar(0.006), Scalar(0.005), Scalar(0.004),
                                 Scalar(0.003), Scalar(0.0024)};
  if (model == Model::kTable) {
    return {.model = TableResponse<Scalar>{MonotoneCubic<Scalar>(kVolts, kGapsM)}};
  }
  return {.model = LinearResponse<Scalar>{.gap_at_zero_m = Scalar(0.010),
                                          .slope_m_per_v = Scalar(0.006)}};
}

/// The paper's two sensors; those with a table look from nearer.
template <class Scalar>
Rig<Scalar> rig_with(Model model) {
  const double face_m = model == Model::kTable ? -0.011 : 0;
  Rig<Scalar> rig;
  rig.layout = test::layout_of<Scalar>({{0.02, 0, face_m}, {0, 0.02, face_m}}, 0.02);
  rig.responses.fill(response_of<Scalar>(model));
  rig.filter = {.order = 15, .cutoff_of_nyquist = Scalar(0.15)};
  return rig;
}

/// A swing to 10 degrees at 1000 Hz, noise and all.
std::vector<Sample> simulated(Model model) {
  SimulationSettings settings;
  settings.start = {
      .theta_rad = test::from_degrees(10), .phi_rad = test::from_degrees(30), .psi_rad_s = 3};
  settings.rate_hz = kRateHz;
  SampledRig source(rig_with<double>(model), settings);
  std::vector<Sample> samples;
  for (Sample sample; source.read(sample).value();) {
    samples.push_back(sample);
  }
  return samples;
}

void count_rows(benchmark::State& state, std::size_t rows) {
  state.counters["s_per_row"] =
      benchmark::Counter(static_cast<double>(rows), benchmark::Counter::kIsIterationInvariantRate |
                                                        benchmark::Counter::kInvert);
}

template <template <class> class Core, class Scalar, Model kModel>
void update(benchmark::State& state) {
  const std::vector<Sample> samples = simulated(kModel);
  const Rig<Scalar> rig = rig_with<Scalar>(kModel);
  std::size_t unanswered = 0;
  for ([[maybe_unused]] auto _ : state) {
    Core<Scalar> core(rig, {.rate_hz = kRateHz});
    unanswered = 0;
    for (const Sample& sample : samples) {
      const Estimate<Scalar> estimate = core.update(sample);
      unanswered += estimate.attitude ? 0U : 1U;
    }
    benchmark::DoNotOptimize(unanswered);
  }
  count_rows(state, samples.size());
  state.counters["unanswered"] = static_cast<double>(unanswered);
}

BENCHMARK(update<Pipeline, double, Model::kLinear>)->Name("update/linear/double");
BENCHMARK(update<Pipeline, double, Model::kTable>)->Name("update/table/double");
BENCHMARK(update<Pipeline, float, Model::kLinear>)->Name("update/linear/float");
BENCHMARK(update<Pipeline, float, Model::kTable>)->Name("update/table/float");
BENCHMARK(update<SwingTracker, double, Model::kLinear>)->Name("ekf/linear/double");
BENCHMARK(update<SwingTracker, double, Model::kTable>)->Name("ekf/table/double");
BENCHMARK(update<SwingTracker, float, Model::kLinear>)->Name("ekf/linear/float");

/// A file in memory only, by a path that anyone in this process can open.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text) : file_(::memfd_create("recording", MFD_CLOEXEC)) {
    if (::write(file_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
      std::abort();
    }
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(file_); }

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

void read_row(benchmark::State& state) {
  const std::vector<Sample> samples = simulated(Model::kLinear);
  RecordingHeader header;
  header.acquisition.rate_hz = kRateHz;
  std::string text = recording_head(header);
  for (const Sample& sample : samples) {
    append_recording_row(text, sample, header.acquisition.sensor_count);
  }
  const MemoryFile file(text);
  for ([[maybe_unused]] auto _ : state) {
    auto reader = RecordingReader::open(file.path());
    for (Sample sample; reader->read(sample).value();) {
      benchmark::DoNotOptimize(sample);
    }
  }
  count_rows(state, samples.size());
}
BENCHMARK(read_row);

void write_row(benchmark::State& state) {
  Pipeline<double> pipeline(rig_with<double>(Model::kLinear), {.rate_hz = kRateHz});
  std::vector<Estimate<double>> estimates;
  for (const Sample& sample : simulated(Model::kLinear)) {
    estimates.push_back(pipeline.update(sample));
  }
  std::string text;
  for ([[maybe_unused]] auto _ : state) {
    text.clear();
    for (const Estimate<double>& estimate : estimates) {
      append_estimate_row(text, estimate, {});
    }
    benchmark::DoNotOptimize(text.data());
  }
  count_rows(state, estimates.size());
}
BENCHMARK(write_row);

}  // namespace
}  // namespace penduline::bench
