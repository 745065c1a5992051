// SPDX-License-Identifier: Apache-2.0
// The backends of hal as sources.
#include "host/source/source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "hal/replay/recording_reader.hpp"
#include "hal/sim/sampled_rig.hpp"

namespace penduline {
namespace {

RecordingHeader header_of(const RecordingReader& reader) {
  return reader.header();
}

RecordingHeader header_of(const VoltageLogReader& reader) {
  return {.acquisition = reader.acquisition(), .board = "", .firmware = "", .started = ""};
}

/// What the streams of hal say, which always have a sample or none any more.
tl::expected<ReadResult, Error> result_of(const tl::expected<bool, Error>& more) {
  return more.map([](bool sample) { return sample ? ReadResult::kSample : ReadResult::kEnded; });
}

/// A reader of files.
template <class Reader>
class ReaderSource final : public Source {
 public:
  explicit ReaderSource(Reader reader) : reader_(std::move(reader)) {}

  [[nodiscard]] RecordingHeader header() const override { return header_of(reader_); }
  tl::expected<ReadResult, Error> read(Sample& sample) override {
    return result_of(reader_.read(sample));
  }
  [[nodiscard]] std::string place() const override { return reader_.place(); }
  [[nodiscard]] double progress() const override { return reader_.progress(); }
  [[nodiscard]] std::vector<std::string> complaints() const override {
    return reader_.complaints();
  }
  [[nodiscard]] std::span<const RecordingEvent> events() const override {
    if constexpr (requires { reader_.events(); }) {
      return reader_.events();
    } else {
      return {};
    }
  }

 private:
  Reader reader_;
};

/// What opening a reader came to, as a source.
template <class Reader>
tl::expected<std::unique_ptr<Source>, Error> source_of(tl::expected<Reader, Error> reader) {
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  return std::make_unique<ReaderSource<Reader>>(std::move(*reader));
}

class SimulatedSource final : public Source {
 public:
  SimulatedSource(const Rig<double>& rig, const SimulationSettings& settings)
      : rig_(rig, settings) {}

  [[nodiscard]] RecordingHeader header() const override { return simulated_header(rig_); }
  tl::expected<ReadResult, Error> read(Sample& sample) override {
    return result_of(rig_.read(sample));
  }
  [[nodiscard]] std::string place() const override { return rig_.place(); }
  [[nodiscard]] double progress() const override { return rig_.progress(); }
  [[nodiscard]] std::vector<std::string> complaints() const override {
    return simulation_complaints(rig_);
  }

 private:
  SampledRig rig_;
};

}  // namespace

RecordingHeader simulated_header(const SampledRig& rig) {
  return {.acquisition = rig.acquisition(),
          .board = "sim",
          .firmware = PENDULINE_VERSION,
          .started = ""};
}

std::vector<std::string> simulation_complaints(const SampledRig& rig) {
  if (std::isinf(rig.blown_up_at_s())) {
    return {};
  }
  return {
      fmt::format("sim: the integrator has blown up: by t = {:.3f} s the energy has doubled, "
                  "though nothing drives the pendulum",
                  rig.blown_up_at_s())};
}

tl::expected<std::unique_ptr<Source>, Error> open_recording(const std::string& path) {
  return source_of(RecordingReader::open(path));
}

tl::expected<std::unique_ptr<Source>, Error> open_voltage_log(const std::string& path,
                                                              const VoltageLogLayout& layout) {
  return source_of(VoltageLogReader::open(path, layout));
}

std::unique_ptr<Source> simulate(const Rig<double>& rig, const SimulationSettings& settings) {
  return std::make_unique<SimulatedSource>(rig, settings);
}

}  // namespace penduline
