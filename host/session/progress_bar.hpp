// SPDX-License-Identifier: Apache-2.0
// A progress bar on the terminal, for work that takes its time.
#pragma once

#include <chrono>

namespace penduline {

/// Draws on stderr while that is a terminal, unless rows on the same terminal show the progress;
/// nothing for work that is done within half a second.
class ProgressBar {
 public:
  explicit ProgressBar(bool rows_on_stdout);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  /// Whether it is worth working out the progress now: ten times a second.
  [[nodiscard]] bool due();
  /// Draws `done` in 0..1.
  void draw(double done);

 private:
  bool visible_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace penduline
