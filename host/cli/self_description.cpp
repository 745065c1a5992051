// SPDX-License-Identifier: Apache-2.0
// Answers by the definition of the commands, so that they cannot differ from it.
#include "host/cli/self_description.hpp"

#include <string_view>

#include "hal/linux/serial_devices.hpp"
#include "host/cli/completion.hpp"
#include "host/cli/manual.hpp"

namespace penduline {

std::optional<std::string> describe_itself(const CLI::App& program,
                                           std::span<const char* const> arguments) {
  const std::string_view question = arguments.size() > 1 ? arguments[1] : "";
  if (question == "complete") {
    return text_of(complete(program, {arguments.begin() + 2, arguments.end()}, serial_devices()));
  }
  if (question == "manual") {
    return manual_of_commands(program);
  }
  return std::nullopt;
}

}  // namespace penduline
