// SPDX-License-Identifier: Apache-2.0
// Reading and writing the file that stands for a flash sector.
#include "hal/sim/flash_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace penduline::sim {

tl::expected<FlashFile, Error> FlashFile::open(const std::string& path) {
  FlashFile flash;
  flash.path_ = path;
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file && errno != ENOENT) {
    return failure(fmt::format("{}: {}", path, std::strerror(errno)));
  }
  std::array<char, kSectorBytes + 1> bytes{};
  file.read(bytes.data(), bytes.size());
  if (file.bad()) {
    return failure(fmt::format("{}: {}", path, std::strerror(errno)));
  }
  const auto size = static_cast<std::size_t>(file.gcount());
  if (size > kSectorBytes) {
    return failure(fmt::format("{}: found a longer file, expected a store of {} bytes at most",
                               path, kSectorBytes));
  }
  std::transform(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size),
                 flash.sector_.begin(), [](char byte) { return static_cast<std::uint8_t>(byte); });
  return flash;
}

bool FlashFile::replace(std::span<const std::uint8_t> block) {
  if (worn_out_ || block.size() > sector_.size()) {
    return false;
  }
  sector_.fill(kErased);
  std::ranges::copy(block, sector_.begin());
  if (path_.empty()) {
    return true;
  }
  std::ofstream file(path_, std::ios::binary | std::ios::trunc);
  for (const std::uint8_t byte : sector_) {
    file.put(static_cast<char>(byte));
  }
  file.close();
  return !file.fail();
}

}  // namespace penduline::sim
