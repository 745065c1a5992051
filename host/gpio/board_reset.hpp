// SPDX-License-Identifier: Apache-2.0
// The board's reset line: pulsed when asked to, and when the board does not talk any more.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "hal/linux/gpio.hpp"

namespace penduline {

class BoardReset {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kPulse{100};
  /// How long a board whose port is there may be silent.
  static constexpr std::chrono::seconds kPatience{10};
  static constexpr std::chrono::seconds kLongestPatience{320};

  /// `say` takes news for a person.
  BoardReset(std::unique_ptr<GpioOutput> line, std::function<void(const std::string&)> say);

  /// Holds the board in reset for a tenth of a second, and waits meanwhile.
  tl::expected<void, Error> pulse();

  /// The port was opened and the board did not answer: resets it after 10 s of that, then after
  /// 20 s more, and so on up to 320 s, and says so once.
  void not_answered(Clock::time_point now);
  /// There was no port: a board that comes back has its 10 s again.
  void not_there(Clock::time_point now);
  void answered();

 private:
  std::unique_ptr<GpioOutput> line_;
  std::function<void(const std::string&)> say_;
  std::chrono::seconds patience_ = kPatience;
  std::optional<Clock::time_point> due_;  ///< of the next pulse, while the board is silent
};

}  // namespace penduline
