// SPDX-License-Identifier: Apache-2.0
// Waiting for room before each write, which is of whole lines that a pipe takes at once.
#include "host/output/line_writer.hpp"

#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include <chrono>
#include <climits>
#include <csignal>
#include <utility>

namespace penduline {
namespace {

using namespace std::chrono_literals;

constexpr auto kLongWait = 60s;

void let_broken_pipe_end_program() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGPIPE);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

}  // namespace

LineWriter::LineWriter(TextFile file, EstimateLayout layout, bool ends_with_reader)
    : file_(std::move(file)), layout_(layout), ends_with_reader_(ends_with_reader) {
  append_estimate_head(file_.text(), layout_);
}

/// Moves rows from the queue to the text, as many as go with one write.
void LineWriter::fill(EstimateQueue& queue) {
  while (true) {
    if (next_row_.empty()) {
      const auto oldest = queue.pop();
      if (!oldest) {
        return;
      }
      append_estimate_row(next_row_, oldest->estimate, layout_);
    }
    if (rows_ > 0 && file_.text().size() + next_row_.size() > PIPE_BUF) {
      return;
    }
    file_.text() += next_row_;
    next_row_.clear();
    ++rows_;
  }
}

tl::expected<void, Error> LineWriter::run(EstimateQueue& queue) {
  if (ends_with_reader_ && file_.descriptor() == STDOUT_FILENO) {
    let_broken_pipe_end_program();
  }
  while (!queue.expired()) {
    const bool last = queue.closed();
    if (file_.text().empty()) {
      queue.count_written(rows_);
      rows_ = 0;
      fill(queue);
    }
    const bool waits = !file_.text().empty();
    if (last && !waits) {
      break;
    }
    if (queue.wait(waits ? file_.descriptor() : EstimateQueue::kNoFile, POLLOUT, kLongWait) != 0) {
      if (auto written = file_.write_piece(); !written) {
        return written;
      }
    }
  }
  return {};
}

}  // namespace penduline
