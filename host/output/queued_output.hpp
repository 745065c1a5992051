// SPDX-License-Identifier: Apache-2.0
// An output that may block, written by a thread of its own, so that sampling never waits for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <tl/expected.hpp>
#include <utility>

#include "host/output/estimate_queue.hpp"
#include "host/output/output.hpp"

namespace penduline {

/// What the thread of a QueuedOutput does.
class QueueWriter {
 public:
  QueueWriter() = default;
  QueueWriter(const QueueWriter&) = delete;
  QueueWriter& operator=(const QueueWriter&) = delete;
  virtual ~QueueWriter() = default;

  [[nodiscard]] virtual std::string name() const = 0;

  /// Writes what the queue gives until it is closed and empty, or its deadline has passed. Fails
  /// where nothing can be written any more. Should it block for longer than the deadline, the
  /// program ends without it; so once the queue is closed it must touch nothing but itself.
  virtual tl::expected<void, Error> run(EstimateQueue& queue) = 0;
};

class QueuedOutput final : public Output {
 public:
  /// Starts the thread, in which all signals are blocked: they are the session's.
  explicit QueuedOutput(std::unique_ptr<QueueWriter> writer,
                        std::size_t capacity = EstimateQueue::kCapacity);
  QueuedOutput(const QueuedOutput&) = delete;
  QueuedOutput& operator=(const QueuedOutput&) = delete;
  ~QueuedOutput() override;

  [[nodiscard]] std::string name() const override { return name_; }
  /// Never waits. Fails where the writer has; the estimate is counted as dropped.
  tl::expected<void, Error> take(const Estimate<double>& estimate) override;
  void close(Clock::time_point deadline) override;
  tl::expected<void, Error> finish() override;
  [[nodiscard]] std::uint64_t dropped() const override;

 private:
  using Outcome = tl::expected<void, Error>;

  /// What the thread uses; it lives as long as the longer of both.
  struct Shared {
    Shared(std::unique_ptr<QueueWriter> its_writer, std::size_t capacity)
        : writer(std::move(its_writer)), queue(capacity) {}
    std::unique_ptr<QueueWriter> writer;
    EstimateQueue queue;
  };

  bool end();

  std::string name_;
  std::shared_ptr<Shared> shared_;
  std::shared_future<Outcome> ended_;
  Clock::time_point deadline_;
  std::thread thread_;
};

}  // namespace penduline
