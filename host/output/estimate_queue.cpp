// SPDX-License-Identifier: Apache-2.0
// The queue: a mutex held for the copy of one estimate, an eventfd to wake the other thread.
#include "host/output/estimate_queue.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

namespace penduline {

using std::chrono::milliseconds;

EstimateQueue::EstimateQueue(std::size_t capacity)
    : wake_up_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), estimates_(capacity) {
  if (wake_up_ < 0) {
    throw std::system_error(errno, std::generic_category(), "eventfd");
  }
}

EstimateQueue::~EstimateQueue() {
  ::close(wake_up_);
}

void EstimateQueue::wake() const {
  const std::uint64_t one = 1;
  // It fails only where the counter is full, and then the other thread is awake.
  [[maybe_unused]] const ssize_t written = ::write(wake_up_, &one, sizeof one);
}

void EstimateQueue::push(const StampedEstimate& estimate) {
  bool was_empty = false;
  {
    const std::lock_guard lock(mutex_);
    was_empty = estimates_.empty();
    estimates_.push_back(estimate);
    ++pushed_;
  }
  // Whoever has left estimates there waits for a file, not for more of them.
  if (was_empty) {
    wake();
  }
}

void EstimateQueue::close(Clock::time_point deadline) {
  {
    const std::lock_guard lock(mutex_);
    deadline_ = deadline;
  }
  wake();
}

std::optional<StampedEstimate> EstimateQueue::pop() {
  const std::lock_guard lock(mutex_);
  if (estimates_.empty()) {
    return std::nullopt;
  }
  const StampedEstimate oldest = estimates_.front();
  estimates_.pop_front();
  return oldest;
}

bool EstimateQueue::closed() const {
  const std::lock_guard lock(mutex_);
  return deadline_.has_value();
}

bool EstimateQueue::expired() const {
  const std::lock_guard lock(mutex_);
  return deadline_ && Clock::now() >= *deadline_;
}

short EstimateQueue::wait(int file, short events, milliseconds longest) {
  {
    const std::lock_guard lock(mutex_);
    if (deadline_) {
      longest = std::min(longest, std::chrono::ceil<milliseconds>(*deadline_ - Clock::now()));
    }
  }
  std::array<pollfd, 2> waited = {pollfd{.fd = wake_up_, .events = POLLIN, .revents = 0},
                                  pollfd{.fd = file, .events = events, .revents = 0}};
  const auto patience = static_cast<int>(std::max(longest, milliseconds(0)).count());
  if (::poll(waited.data(), waited.size(), patience) <= 0) {
    return 0;
  }
  if (waited[0].revents != 0) {
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t got = ::read(wake_up_, &count, sizeof count);
  }
  return waited[1].revents;
}

void EstimateQueue::count_written(std::uint64_t estimates) {
  const std::lock_guard lock(mutex_);
  written_ += estimates;
}

std::uint64_t EstimateQueue::unwritten() const {
  const std::lock_guard lock(mutex_);
  return pushed_ - written_;
}

}  // namespace penduline
