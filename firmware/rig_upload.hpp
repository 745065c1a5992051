// SPDX-License-Identifier: Apache-2.0
// A rig on its way from the host, piece by piece.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/wire/crc32.hpp"
#include "common/wire/messages.hpp"
#include "common/wire/rig_image.hpp"

namespace penduline {

class RigUpload {
 public:
  wire::Result begin(const wire::BeginRig& command) {
    begun_ = command.size_bytes > 0 && command.size_bytes <= image_.size();
    size_ = begun_ ? command.size_bytes : 0;
    crc_ = command.crc;
    received_ = 0;
    return begun_ ? wire::Result::kDone : wire::Result::kOutOfRange;
  }

  /// Pieces come in order; one that is sent again, its reply having been lost, changes nothing.
  wire::Result take(const wire::RigPart& part) {
    if (!begun_) {
      return wire::Result::kNoUpload;
    }
    const std::size_t end = std::size_t{part.offset} + part.count;
    if (part.count == 0 || part.count > part.bytes.size() || end > size_) {
      return wire::Result::kOutOfRange;
    }
    if (part.offset > received_) {
      return wire::Result::kIncomplete;
    }
    std::copy_n(part.bytes.begin(), part.count, image_.begin() + part.offset);
    received_ = std::max(received_, end);
    return wire::Result::kDone;
  }

  /// Whether all has come and is what was announced; the upload is over unless pieces are missing.
  wire::Result finish() {
    if (!begun_) {
      return wire::Result::kNoUpload;
    }
    if (received_ < size_) {
      return wire::Result::kIncomplete;
    }
    begun_ = false;
    return wire::crc32(image()) == crc_ ? wire::Result::kDone : wire::Result::kDamaged;
  }

  /// What has come, once `finish` was done.
  [[nodiscard]] std::span<const std::uint8_t> image() const {
    return std::span<const std::uint8_t>(image_).first(size_);
  }

 private:
  std::array<std::uint8_t, wire::kMaxRigImageBytes> image_{};
  std::size_t size_ = 0;
  std::size_t received_ = 0;
  std::uint32_t crc_ = 0;
  bool begun_ = false;
};

}  // namespace penduline
