// SPDX-License-Identifier: Apache-2.0
// Reads the keys of one TOML table, collecting the first error and every unknown key.
#pragma once

#include <toml++/toml.h>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "hal/error.hpp"

namespace penduline {

/// What reading a TOML file found wrong.
struct TomlFindings {
  std::string file;
  std::optional<Error> error;  ///< the first one; what is read after it does not count
  std::vector<std::string> complaints;

  /// Notes an error at a node: "FILE:LINE: MESSAGE".
  void fail(const toml::node& node, std::string_view message);
};

/// Numbers allowed: from `least` to `most`, without `least` itself where `open` is set.
struct NumberBounds {
  double least;
  double most;
  bool open;
  std::string_view words;  ///< "a number above 0"
};

inline constexpr double kLargestNumber = std::numeric_limits<double>::max();
inline constexpr NumberBounds kAnyNumber{-kLargestNumber, kLargestNumber, false, "a number"};
inline constexpr NumberBounds kAboveZero{0, kLargestNumber, true, "a number above 0"};
inline constexpr NumberBounds kNotNegative{0, kLargestNumber, false, "a number not below 0"};

/// One table of the file. Values of the wrong type or outside their bounds become the error.
class TomlSection {
 public:
  TomlSection(const toml::table& table, std::string path, TomlFindings& findings)
      : table_(table), path_(std::move(path)), findings_(findings) {}

  double number(std::string_view key, const NumberBounds& bounds);
  double number_or(std::string_view key, const NumberBounds& bounds, double otherwise);
  std::string text(std::string_view key, std::string_view words);
  std::string text_or(std::string_view key, std::string_view words, std::string otherwise);
  bool flag_or(std::string_view key, bool otherwise);
  /// An array of `least` to `most` numbers.
  std::vector<double> numbers(std::string_view key, std::size_t least, std::size_t most);
  /// Whether an optional key is there; it counts as known either way.
  bool has(std::string_view key) { return find(key) != nullptr; }

  /// The table under a key, which then counts as known; nothing where it is absent.
  const toml::table* section(std::string_view key);
  const toml::array* array(std::string_view key);

  /// Notes an error about one key.
  void fail(std::string_view key, std::string_view message);
  /// Complains of every key that nobody asked for.
  void complain_of_unknown_keys();

 private:
  const toml::node* find(std::string_view key);
  void wrong(std::string_view key, std::string_view words);

  const toml::table& table_;
  std::string path_;  ///< "[pendulum]", for messages
  TomlFindings& findings_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace penduline
