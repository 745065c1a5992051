// SPDX-License-Identifier: Apache-2.0
// A queue with two bounds.
#include "host/web/live_events.hpp"

#include <fmt/format.h>

#include <utility>

namespace penduline {

std::string event_text(std::string_view name, std::string_view json) {
  return fmt::format("event: {}\ndata: {}\n\n", name, json);
}

void LiveEvents::add(std::string text) {
  bytes_ += text.size();
  texts_.push_back(std::make_shared<const std::string>(std::move(text)));
  ++end_;
  // The newest one stays, however large.
  while (texts_.size() > 1 && (texts_.size() > most_events_ || bytes_ > most_bytes_)) {
    bytes_ -= texts_.front()->size();
    texts_.pop_front();
  }
}

std::vector<LiveEvents::Text> LiveEvents::from(std::uint64_t position) const {
  return {texts_.end() - static_cast<std::ptrdiff_t>(end_ - position), texts_.end()};
}

}  // namespace penduline
