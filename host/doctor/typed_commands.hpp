// SPDX-License-Identifier: Apache-2.0
// Commands in advice, such that they can be typed as they stand.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace penduline {

/// What the user calls the board and the rig file.
struct TypedNames {
  std::string source = "auto";
  std::string rig{};                ///< "": not given; where a command needs one, it says rig.toml
  bool recorded = false;            ///< `source` is a recording, not a board
  std::optional<double> seconds{};  ///< how long to listen, where given
  /// Where the user types: files that commands write get names that no file has there.
  std::filesystem::path folder = ".";

  /// A run of the board: "'penduline run auto --rig rig.toml --rate 10'".
  [[nodiscard]] std::string run(std::string_view options) const;
  /// The same at half the rate, or the least that a board has.
  [[nodiscard]] std::string run_slower(double rate_hz) const;
  /// This check again, of a board or a new recording, for as long as this one.
  [[nodiscard]] std::string again() const { return again_for(seconds); }
  /// The same for so many seconds.
  [[nodiscard]] std::string again_for(std::optional<double> for_s) const;
  /// Recording, and calibrating by it: "'penduline run auto ...' for 20 s (Ctrl-C ends it), then
  /// 'penduline calibrate rest ...'".
  [[nodiscard]] std::string calibrate(std::string_view method, std::string_view duration) const;
  [[nodiscard]] std::string needed_rig() const { return rig.empty() ? "rig.toml" : rig; }

 private:
  [[nodiscard]] std::string record(std::string_view recording, std::string_view duration) const;
};

/// A word as a shell takes it: in double quotes where it must be.
[[nodiscard]] std::string shell_word(std::string_view word);

}  // namespace penduline
