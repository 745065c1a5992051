// SPDX-License-Identifier: Apache-2.0
// Making and reading file names.
#include "host/recorder/recording_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <ctime>
#include <filesystem>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string_view>

namespace penduline {
namespace {

constexpr std::int64_t kUsPerSecond = 1'000'000;

/// The number in a file's name, none where that is not PREFIX-NUMBER.EXTENSION.
std::optional<unsigned> number_in(std::string_view name, std::string_view prefix,
                                  std::string_view extension) {
  constexpr std::size_t kMostDigits = 9;  // which 32 bits hold
  if (name.size() <= prefix.size() + extension.size() || !name.starts_with(prefix) ||
      !name.ends_with(extension)) {
    return std::nullopt;
  }
  const std::string_view digits =
      name.substr(prefix.size(), name.size() - prefix.size() - extension.size());
  unsigned number = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  return error == std::errc{} && stop == end && digits.size() <= kMostDigits ? std::optional(number)
                                                                             : std::nullopt;
}

}  // namespace

std::string dated_name(const std::string& path, std::int64_t utc_us) {
  if (path.find('%') == std::string::npos) {
    return path;
  }
  const std::time_t seconds = utc_us / kUsPerSecond;
  std::tm date{};
  ::gmtime_r(&seconds, &date);
  std::ostringstream name;
  name << std::put_time(&date, path.c_str());
  return name.str();
}

std::string numbered_name(const std::string& path, unsigned number) {
  const std::filesystem::path whole(path);
  return (whole.parent_path() /
          fmt::format("{}-{:04}{}", whole.stem().string(), number, whole.extension().string()))
      .string();
}

unsigned next_number(const std::string& path) {
  const std::filesystem::path whole(path);
  const std::string prefix = whole.stem().string() + "-";
  const std::string extension = whole.extension().string();
  const auto folder = whole.has_parent_path() ? whole.parent_path() : std::filesystem::path(".");
  unsigned largest = 0;
  std::error_code failed;
  for (std::filesystem::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    largest = std::max(largest, number_in(name, prefix, extension).value_or(0));
  }
  return largest + 1;
}

}  // namespace penduline
