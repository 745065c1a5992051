// SPDX-License-Identifier: Apache-2.0
// A bounded queue of estimates between the thread that samples and one that writes.
#pragma once

#include <boost/circular_buffer.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>

#include "common/estimate.hpp"

namespace penduline {

/// An estimate with its time stamp.
struct StampedEstimate {
  Estimate<double> estimate;
  double unix_s = 0;  ///< as timestamp_s() gave it when the host had the estimate
};

/// One thread pushes and closes, one other pops and waits. A full queue loses its oldest estimate.
class EstimateQueue {
 public:
  using Clock = std::chrono::steady_clock;

  /// Some minutes at 20 Hz, seconds at 1 kHz.
  static constexpr std::size_t kCapacity = 4096;
  /// Stands for no file in a wait.
  static constexpr int kNoFile = -1;

  /// Throws std::system_error where the system has no more descriptors.
  explicit EstimateQueue(std::size_t capacity = kCapacity);
  EstimateQueue(const EstimateQueue&) = delete;
  EstimateQueue& operator=(const EstimateQueue&) = delete;
  ~EstimateQueue();

  /// Never waits for the other thread to get on.
  void push(const StampedEstimate& estimate);
  /// Says that no more is pushed, and until when the other thread may write what is there.
  void close(Clock::time_point deadline);

  /// The oldest estimate; none where the queue is empty.
  [[nodiscard]] std::optional<StampedEstimate> pop();
  [[nodiscard]] bool closed() const;
  /// Whether the deadline has passed.
  [[nodiscard]] bool expired() const;
  /// Waits until a file is ready for `events` (those of poll), the empty queue gets an estimate or
  /// is closed, its deadline passes, or for so long; returns what the file is ready for.
  short wait(int file, short events, std::chrono::milliseconds longest);
  /// Notes that estimates which were popped are written.
  void count_written(std::uint64_t estimates);

  /// How many estimates were pushed and not written.
  [[nodiscard]] std::uint64_t unwritten() const;

 private:
  void wake() const;

  int wake_up_;  ///< an eventfd
  mutable std::mutex mutex_;
  boost::circular_buffer<StampedEstimate> estimates_;
  std::uint64_t pushed_ = 0;
  std::uint64_t written_ = 0;
  std::optional<Clock::time_point> deadline_;  ///< of a closed queue
};

}  // namespace penduline
