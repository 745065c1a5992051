// SPDX-License-Identifier: Apache-2.0
// Starting and ending the thread of an output.
#include "host/output/queued_output.hpp"

#include <chrono>
#include <utility>

#include "host/output/unix_time.hpp"
#include "host/signals_blocked.hpp"

namespace penduline {
namespace {

using namespace std::chrono_literals;

/// What a writer that keeps to its deadline may take beyond it.
constexpr auto kGrace = 500ms;

}  // namespace

QueuedOutput::QueuedOutput(std::unique_ptr<QueueWriter> writer, std::size_t capacity)
    : name_(writer->name()), shared_(std::make_shared<Shared>(std::move(writer), capacity)) {
  std::packaged_task<Outcome()> task(
      [shared = shared_] { return shared->writer->run(shared->queue); });
  ended_ = task.get_future().share();
  const SignalsBlocked blocked;
  thread_ = std::thread(std::move(task));
}

QueuedOutput::~QueuedOutput() {
  if (thread_.joinable()) {
    close(Clock::now());
    end();
  }
}

tl::expected<void, Error> QueuedOutput::take(const Estimate<double>& estimate) {
  shared_->queue.push({.estimate = estimate, .unix_s = timestamp_s(estimate)});
  return ended_.wait_for(0s) == std::future_status::ready ? ended_.get() : Outcome();
}

void QueuedOutput::close(Clock::time_point deadline) {
  deadline_ = deadline;
  shared_->queue.close(deadline);
}

tl::expected<void, Error> QueuedOutput::finish() {
  return end() ? ended_.get() : Outcome();
}

/// Whether the thread has ended. Else it blocks, in a slow write or in looking a name up, which
/// nothing can end, and is left to itself.
bool QueuedOutput::end() {
  const bool ended = ended_.wait_until(deadline_ + kGrace) == std::future_status::ready;
  if (ended) {
    thread_.join();
  } else {
    thread_.detach();
  }
  return ended;
}

std::uint64_t QueuedOutput::dropped() const {
  return shared_->queue.unwritten();
}

}  // namespace penduline
