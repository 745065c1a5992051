// SPDX-License-Identifier: Apache-2.0
// The simulated board's flash: one sector in memory, kept in a file where one is named.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tl/expected.hpp>

#include "hal/concepts.hpp"
#include "hal/error.hpp"

namespace penduline::sim {

class FlashFile {
 public:
  static constexpr std::size_t kSectorBytes = 4096;

  /// Erased, and forgotten with the process.
  FlashFile() { sector_.fill(kErased); }

  /// The sector in the file; one that is not there yet is erased. Fails where it cannot be read or
  /// is longer than a sector.
  [[nodiscard]] static tl::expected<FlashFile, Error> open(const std::string& path);

  [[nodiscard]] std::span<const std::uint8_t> contents() const { return sector_; }
  bool replace(std::span<const std::uint8_t> block);

  /// A fault for tests: nothing can be written any more.
  void wear_out() { worn_out_ = true; }

 private:
  static constexpr std::uint8_t kErased = 0xff;

  std::array<std::uint8_t, kSectorBytes> sector_{};
  std::string path_;  ///< "": in memory only
  bool worn_out_ = false;
};

static_assert(Store<FlashFile>);

}  // namespace penduline::sim
