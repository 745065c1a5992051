// SPDX-License-Identifier: Apache-2.0
// What a web server serves, and how much of it at once.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "hal/error.hpp"

namespace penduline {

/// What a viewer may ask for. The first three may wait for the disk: they are called by a thread of
/// their own, one after the other.
struct WebActions {
  std::function<tl::expected<void, Error>()> start_recording;
  std::function<tl::expected<void, Error>()> stop_recording;
  std::function<tl::expected<void, Error>(const std::string& text)> mark;
  /// The path of the recording that is to be had; none where there is none.
  std::function<std::optional<std::string>()> download;
};

/// What one server bears, so that nobody can take its memory, its files or its time.
struct WebLimits {
  /// In all. Beyond them the connection that has waited longest without a request is closed.
  std::size_t connections = 128;
  std::size_t viewers = 32;
  std::size_t downloads = 4;
  /// For a whole request; and for the answer to be taken.
  std::chrono::milliseconds request_time{5000};
  /// For a viewer to take anything of what was sent to it.
  std::chrono::milliseconds viewer_time{60000};
  std::uint32_t header_bytes = 8192;
  std::uint64_t body_bytes = 4096;
  /// What the system keeps of what a viewer has not yet taken.
  int send_buffer_bytes = 131072;
};

}  // namespace penduline
