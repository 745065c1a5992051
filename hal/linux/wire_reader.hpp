// SPDX-License-Identifier: Apache-2.0
// A board's stream of frames as a stream of samples.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "common/sample.hpp"
#include "common/wire/decoder.hpp"
#include "common/wire/device_messages.hpp"
#include "hal/linux/byte_stream.hpp"
#include "hal/sample_source.hpp"

namespace penduline {

/// A board behind a serial port, or its recorded bytes, as a SampleSource.
class WireReader {
 public:
  /// Opens the stream, asks the board who it is and waits for the answer. Fails where none comes
  /// within three seconds, or before the stream ends.
  static tl::expected<WireReader, Error> open(const std::string& path);

  [[nodiscard]] const Acquisition<double>& acquisition() const { return acquisition_; }
  [[nodiscard]] const wire::Hello& hello() const { return hello_; }

  /// The next sample; waits for it. False where the stream has ended or a signal ended the wait.
  tl::expected<bool, Error> read(Sample& sample);

  /// "PATH: seq N" of the sample read last.
  [[nodiscard]] std::string place() const;
  /// Nobody knows how much is still to come.
  [[nodiscard]] double progress() const { return 0; }
  /// What is wrong with the stream and cost no sample that came whole; grows while reading.
  [[nodiscard]] std::vector<std::string> complaints() const;

 private:
  explicit WireReader(ByteStream stream) : stream_(std::move(stream)) {}
  tl::expected<void, Error> greet();
  /// The next frame; none where the stream has ended, or where nothing came for so long.
  tl::expected<std::optional<wire::Frame>, Error> next_frame(std::chrono::milliseconds patience);
  void note(const wire::Hello& hello);

  ByteStream stream_;
  wire::Decoder decoder_;
  std::array<std::uint8_t, 4096> bytes_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  wire::Hello hello_;
  Acquisition<double> acquisition_;
  std::uint64_t last_seq_ = 0;
  std::optional<std::uint32_t>
      dropped_before_;                ///< as the first Status counts since the board's start
  std::uint32_t dropped_frames_ = 0;  ///< since then
  bool bytes_seen_ = false;
  bool ended_ = false;
};

static_assert(SampleSource<WireReader>);

}  // namespace penduline
