// SPDX-License-Identifier: Apache-2.0
// What the fuzz targets share: an input as a file, promises that trap when broken.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>

#include "common/pipeline.hpp"
#include "common/rig.hpp"

namespace penduline::fuzz {

/// Ends the run, and libFuzzer keeps the input, where a promise is broken.
inline void require(bool kept, const char* promise) {
  if (!kept) {
    std::fprintf(stderr, "broken promise: %s\n", promise);
    std::abort();
  }
}

/// Bytes in memory as a file that can be opened by its path.
class InputFile {
 public:
  InputFile(const void* data, std::size_t size)
      : file_(::memfd_create("input", MFD_CLOEXEC)),
        path_("/proc/self/fd/" + std::to_string(file_)) {
    require(file_ >= 0 && ::write(file_, data, size) == static_cast<ssize_t>(size),
            "the input can be written");
  }
  explicit InputFile(const std::string& text) : InputFile(text.data(), text.size()) {}
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile() { ::close(file_); }

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  int file_;
  std::string path_;
};

/// What every message to a user is.
inline void check_message(const std::string& message, const std::string& file) {
  require(message.find(file) == 0, "a message begins with the file");
  require(std::ranges::none_of(message, [](unsigned char c) { return c < ' '; }),
          "a message is one line of printable text");
}

/// A rig like the paper's with any number of linear sensors, on a circle of 2 cm.
inline Rig<double> rig_with(std::size_t sensor_count) {
  Rig<double> rig;
  rig.layout.disc_offset_m = 0.02;
  rig.layout.count = sensor_count;
  for (std::size_t i = 0; i < sensor_count; ++i) {
    const double turn = sensor_count == 2
                            ? std::numbers::pi / 2
                            : 2 * std::numbers::pi / static_cast<double>(sensor_count);
    const double at = turn * static_cast<double>(i);
    rig.layout.position_m[i] = {0.02 * std::cos(at), 0.02 * std::sin(at), 0};
    rig.responses[i].model = LinearResponse<double>{.gap_at_zero_m = 0.01, .slope_m_per_v = 0.006};
  }
  return rig;
}

/// What every estimate keeps, whatever the samples are.
inline void check_estimate(const Estimate<double>& estimate, const Sample& sample,
                           double length_m) {
  constexpr double kQuarterTurn = std::numbers::pi / 2;
  require(estimate.seq == sample.seq, "an estimate belongs to its sample");
  if (!estimate.attitude) {
    require(estimate.flags != 0, "a row without angles says why");
    require(!estimate.residual_m, "a row without angles has no residual");
    return;
  }
  const auto& attitude = *estimate.attitude;
  require(std::abs(attitude.angles.theta1_rad) <= kQuarterTurn &&
              std::abs(attitude.angles.theta2_rad) <= kQuarterTurn,
          "angles are those of a disc below the pivot");
  require(std::abs(attitude.mass_m.norm() / length_m - 1) < 1e-9, "the mass is on its rod's end");
  require(estimate.residual_m && std::isfinite(*estimate.residual_m) && *estimate.residual_m >= 0,
          "a row with angles has a residual");
}

}  // namespace penduline::fuzz
