// SPDX-License-Identifier: Apache-2.0
// The backends of hal as sources.
#include "host/source/source.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "hal/linux/wire_reader.hpp"
#include "hal/replay/recording_reader.hpp"
#include "hal/sim/sampled_rig.hpp"

namespace penduline {
namespace {

class RecordingSource final : public Source {
 public:
  explicit RecordingSource(RecordingReader reader) : reader_(std::move(reader)) {}

  [[nodiscard]] RecordingHeader header() const override { return reader_.header(); }
  tl::expected<bool, Error> read(Sample& sample) override { return reader_.read(sample); }
  [[nodiscard]] std::string place() const override { return reader_.place(); }
  [[nodiscard]] double progress() const override { return reader_.progress(); }
  [[nodiscard]] std::vector<std::string> complaints() const override {
    return reader_.complaints();
  }

 private:
  RecordingReader reader_;
};

class VoltageLogSource final : public Source {
 public:
  explicit VoltageLogSource(VoltageLogReader reader) : reader_(std::move(reader)) {}

  [[nodiscard]] RecordingHeader header() const override {
    return {.acquisition = reader_.acquisition(), .board = "", .firmware = "", .started = ""};
  }
  tl::expected<bool, Error> read(Sample& sample) override { return reader_.read(sample); }
  [[nodiscard]] std::string place() const override { return reader_.place(); }
  [[nodiscard]] double progress() const override { return reader_.progress(); }
  [[nodiscard]] std::vector<std::string> complaints() const override {
    return reader_.complaints();
  }

 private:
  VoltageLogReader reader_;
};

/// A board's stream.
class WireSource final : public Source {
 public:
  explicit WireSource(WireReader reader) : reader_(std::move(reader)) {}

  [[nodiscard]] RecordingHeader header() const override {
    const wire::Hello& hello = reader_.hello();
    return {.acquisition = reader_.acquisition(),
            .board = std::string(wire::characters_of(hello.board)),
            .firmware = std::string(wire::characters_of(hello.firmware)),
            .started = ""};
  }
  tl::expected<bool, Error> read(Sample& sample) override { return reader_.read(sample); }
  [[nodiscard]] std::string place() const override { return reader_.place(); }
  [[nodiscard]] double progress() const override { return 0; }
  [[nodiscard]] std::vector<std::string> complaints() const override {
    return reader_.complaints();
  }

 private:
  WireReader reader_;
};

class SimulatedSource final : public Source {
 public:
  SimulatedSource(const Rig<double>& rig, const SimulationSettings& settings)
      : rig_(rig, settings) {}

  [[nodiscard]] RecordingHeader header() const override { return simulated_header(rig_); }
  tl::expected<bool, Error> read(Sample& sample) override { return rig_.read(sample); }
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
  auto reader = RecordingReader::open(path);
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  return std::make_unique<RecordingSource>(std::move(*reader));
}

tl::expected<std::unique_ptr<Source>, Error> open_voltage_log(const std::string& path,
                                                              const VoltageLogLayout& layout) {
  auto reader = VoltageLogReader::open(path, layout);
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  return std::make_unique<VoltageLogSource>(std::move(*reader));
}

SourceUri parse_uri(std::string_view uri) {
  using Kind = SourceUri::Kind;
  if (uri == "sim:") {
    return {.kind = Kind::kSimulation, .path = ""};
  }
  for (const auto& [prefix, kind] :
       {std::pair{std::string_view("file:"), Kind::kRecording}, {"serial:", Kind::kBoard}}) {
    if (uri.starts_with(prefix) && uri.size() > prefix.size()) {
      return {.kind = kind, .path = std::string(uri.substr(prefix.size()))};
    }
  }
  return {.kind = Kind::kUnknown, .path = ""};
}

tl::expected<std::unique_ptr<Source>, Error> open_board(const std::string& path) {
  auto reader = WireReader::open(path);
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  return std::make_unique<WireSource>(std::move(*reader));
}

tl::expected<std::unique_ptr<Source>, Error> open_source(const SourceUri& uri,
                                                         const Rig<double>& rig,
                                                         const SimulationSettings& settings) {
  switch (uri.kind) {
    case SourceUri::Kind::kSimulation:
      return std::make_unique<SimulatedSource>(rig, settings);
    case SourceUri::Kind::kRecording:
      return open_recording(uri.path);
    case SourceUri::Kind::kBoard:
      return open_board(uri.path);
    default:
      return failure("found no source, expected sim:, file:PATH or serial:PATH");
  }
}

}  // namespace penduline
