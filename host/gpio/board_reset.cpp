// SPDX-License-Identifier: Apache-2.0
// Pulses with longer and longer patience between them.
#include "host/gpio/board_reset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

namespace penduline {

BoardReset::BoardReset(std::unique_ptr<GpioOutput> line,
                       std::function<void(const std::string&)> say)
    : line_(std::move(line)), say_(std::move(say)) {}

tl::expected<void, Error> BoardReset::pulse() {
  if (auto begun = line_->set(true); !begun) {
    return begun;
  }
  std::this_thread::sleep_for(kPulse);
  return line_->set(false);
}

void BoardReset::not_answered(Clock::time_point now) {
  if (!due_) {
    due_ = now + patience_;
  }
  if (now < *due_) {
    return;
  }
  const auto pulsed = pulse();
  if (patience_ == kPatience) {
    say_(pulsed ? fmt::format("reset the board, which has not talked for {} s; while it stays so "
                              "again after {} s, {} s and so on",
                              kPatience.count(), 2 * kPatience.count(), 4 * kPatience.count())
                : fmt::format("the board could not be reset: {}", pulsed.error().message));
  }
  patience_ = std::min(2 * patience_, kLongestPatience);
  due_ = now + patience_;
}

void BoardReset::not_there(Clock::time_point now) {
  if (due_) {
    due_ = std::max(*due_, now + kPatience);
  }
}

void BoardReset::answered() {
  due_.reset();
  patience_ = kPatience;
}

}  // namespace penduline
