// SPDX-License-Identifier: Apache-2.0
// What may stand next on a command line, by the definition of the commands: for shells.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "hal/linux/serial_devices.hpp"

namespace penduline {

/// What a word may become.
struct Completion {
  std::string word;
  std::string help;    ///< one line; may be empty
  bool files = false;  ///< `word` is followed by the name of a file
};

/// What the last of `words`, which follow on the program's name, may become; it may be empty.
/// Sources name the boards among the `devices`.
[[nodiscard]] std::vector<Completion> complete(const CLI::App& program,
                                               const std::vector<std::string>& words,
                                               const std::vector<SerialDevice>& devices);

/// One a line, as the shells' scripts (host/packaging/completion) read them: the word, a tab, the
/// help; where a file's name follows, a tab and the word.
[[nodiscard]] std::string text_of(const std::vector<Completion>& completions);

}  // namespace penduline
