// SPDX-License-Identifier: Apache-2.0
// Drawing the progress bar.
#include "host/session/progress_bar.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>

namespace penduline {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(500);
constexpr auto kInterval = std::chrono::milliseconds(100);
constexpr std::size_t kWidth = 40;

}  // namespace

ProgressBar::ProgressBar(bool rows_on_stdout)
    : visible_(::isatty(STDERR_FILENO) != 0 && !(rows_on_stdout && ::isatty(STDOUT_FILENO) != 0)),
      next_(std::chrono::steady_clock::now() + kPatience) {}

ProgressBar::~ProgressBar() {
  if (drawn_) {
    fmt::print(stderr, "\r{:{}}\r", "", kWidth + 8);
  }
}

bool ProgressBar::due() {
  return visible_ && std::chrono::steady_clock::now() >= next_;
}

void ProgressBar::draw(double done) {
  next_ = std::chrono::steady_clock::now() + kInterval;
  drawn_ = true;
  const auto full = static_cast<std::size_t>(done * static_cast<double>(kWidth));
  fmt::print(stderr, "\r[{:#<{}}{:{}}] {:3.0f} %", "", full, "", kWidth - full, done * 100);
  std::fflush(stderr);
}

}  // namespace penduline
