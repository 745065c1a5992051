// SPDX-License-Identifier: Apache-2.0
// TOML values on one line.
#include "hal/replay/toml_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace penduline {

std::string toml_text(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) {
    // toml++ prints all 17 digits of a double; nobody wrote those.
    const std::string text = fmt::format("{}", number->get());
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
  }
  std::stringstream text;
  node.visit([&](const auto& value) { text << value; });
  std::string line;
  for (std::string word; text >> word;) {
    line += line.empty() ? word : " " + word;
  }
  return line;
}

std::string toml_quoted(const std::string& text) {
  // A string of JSON is one of TOML, too, but for the character DEL.
  constexpr auto kReplaceBadBytes = nlohmann::json::error_handler_t::replace;
  std::string quoted = nlohmann::json(text).dump(-1, ' ', false, kReplaceBadBytes);
  for (auto at = quoted.find('\x7f'); at != std::string::npos; at = quoted.find('\x7f', at)) {
    quoted.replace(at, 1, "\\u007f");
  }
  return quoted;
}

}  // namespace penduline
