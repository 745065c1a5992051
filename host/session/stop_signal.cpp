// SPDX-License-Identifier: Apache-2.0
// Signal handling: one flag, no more.
#include "host/session/stop_signal.hpp"

#include <csignal>
#include <ctime>

namespace penduline {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

void note_stop(int /*signal*/) {
  stop_requested = 1;
}

/// Has the signal noted, unless the program was started to ignore it; returns what stood there.
struct sigaction note_signal(int signal) {
  struct sigaction before {};
  sigaction(signal, nullptr, &before);
  if (before.sa_handler != SIG_IGN) {
    struct sigaction action {};
    action.sa_handler = note_stop;
    // One time only, so that a second Ctrl-C gets through; and waits for input are interrupted.
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(signal, &action, nullptr);
  }
  return before;
}

}  // namespace

StopSignal::StopSignal() {
  stop_requested = 0;
  interrupt_before_ = note_signal(SIGINT);
  terminate_before_ = note_signal(SIGTERM);
  hang_up_before_ = note_signal(SIGHUP);
}

StopSignal::~StopSignal() {
  sigaction(SIGINT, &interrupt_before_, nullptr);
  sigaction(SIGTERM, &terminate_before_, nullptr);
  sigaction(SIGHUP, &hang_up_before_, nullptr);
}

bool StopSignal::requested() const {
  return stop_requested != 0;
}

void StopSignal::sleep_until(std::chrono::steady_clock::time_point moment) const {
  const auto since_start = moment.time_since_epoch();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(since_start);
  const auto rest = std::chrono::nanoseconds(since_start - seconds);
  const timespec until{.tv_sec = seconds.count(), .tv_nsec = rest.count()};
  // steady_clock is CLOCK_MONOTONIC. A signal ends the sleep early, and then we are to stop.
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

}  // namespace penduline
