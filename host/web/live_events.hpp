// SPDX-License-Identifier: Apache-2.0
// Server-sent events that every viewer reads at its own pace.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace penduline {

/// An event as it goes over the wire; `json` is one line.
[[nodiscard]] std::string event_text(std::string_view name, std::string_view json);

/// The newest events, made once and shared by all viewers. Who falls behind what is kept has
/// missed it: memory is bounded, and nobody is waited for.
class LiveEvents {
 public:
  using Text = std::shared_ptr<const std::string>;

  explicit LiveEvents(std::size_t most_events = 64,
                      std::size_t most_bytes = std::size_t{2} * 1024 * 1024)
      : most_events_(most_events), most_bytes_(most_bytes) {}

  void add(std::string text);

  /// Where a viewer stands that has seen all.
  [[nodiscard]] std::uint64_t end() const { return end_; }
  /// Whether what follows a viewer's position is still there, all of it.
  [[nodiscard]] bool has_all_from(std::uint64_t position) const {
    return position + texts_.size() >= end_;
  }
  /// What follows a position from which all is there.
  [[nodiscard]] std::vector<Text> from(std::uint64_t position) const;
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  std::size_t most_events_;
  std::size_t most_bytes_;
  std::deque<Text> texts_;
  std::size_t bytes_ = 0;
  std::uint64_t end_ = 0;
};

}  // namespace penduline
