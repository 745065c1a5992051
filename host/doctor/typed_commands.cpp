// SPDX-License-Identifier: Apache-2.0
// Putting commands together.
#include "host/doctor/typed_commands.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/wire/commands.hpp"

namespace penduline {
namespace {

constexpr std::string_view kRecording = ".csv";

std::string spaced(std::string_view options) {
  return options.empty() ? "" : fmt::format(" {}", options);
}

/// "still.csv", else "still-2.csv" and so on: what is there is never written over, so a command
/// that writes it would fail, and one that reads it afterwards would read what is old.
std::string free_name(const std::filesystem::path& folder, std::string_view stem,
                      std::string_view extension) {
  std::string name = fmt::format("{}{}", stem, extension);
  std::error_code not_there;
  for (int number = 2; std::filesystem::exists(folder / name, not_there); ++number) {
    name = fmt::format("{}-{}{}", stem, number, extension);
  }
  return name;
}

}  // namespace

std::string shell_word(std::string_view word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
      "0123456789_-./:,+@%=";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) {
    return std::string(word);
  }
  std::string quoted = "\"";
  for (const char c : word) {
    quoted += std::string_view("\"\\$`").find(c) != std::string_view::npos ? "\\" : "";
    quoted += c;
  }
  return quoted + '"';
}

std::string TypedNames::run(std::string_view options) const {
  return fmt::format("'penduline run {} --rig {}{}'", recorded ? "auto" : shell_word(source),
                     shell_word(needed_rig()), spaced(options));
}

std::string TypedNames::run_slower(double rate_hz) const {
  constexpr double kLeastHz = wire::kLeastRateMillihz / 1e3;
  return run(fmt::format("--rate {:g}", std::max(rate_hz / 2, kLeastHz)));
}

std::string TypedNames::again_for(std::optional<double> for_s) const {
  constexpr double kEnoughS = 10;
  const std::string options = (rig.empty() ? "" : " --rig " + shell_word(rig)) +
                              (for_s ? fmt::format(" --seconds {:g}", *for_s) : "");
  if (!recorded) {
    return fmt::format("'penduline doctor {}{}'", shell_word(source), options);
  }
  const std::string recording = free_name(folder, "still", kRecording);
  return fmt::format("{}, then 'penduline doctor file:{}{}'",
                     record(recording, fmt::format("{:g} s", for_s.value_or(kEnoughS))), recording,
                     options);
}

std::string TypedNames::calibrate(std::string_view method, std::string_view duration) const {
  const std::string recording = free_name(folder, method == "rest" ? "still" : method, kRecording);
  return fmt::format("{}, then 'penduline calibrate {} {} --rig {} -o {}'",
                     record(recording, duration), method, recording, shell_word(needed_rig()),
                     free_name(folder, "new", ".toml"));
}

std::string TypedNames::record(std::string_view recording, std::string_view duration) const {
  return fmt::format("{} for {} (Ctrl-C ends it)",
                     run(fmt::format("--record {} -o /dev/null", recording)), duration);
}

}  // namespace penduline
