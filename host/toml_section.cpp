// SPDX-License-Identifier: Apache-2.0
// Reading TOML with messages that name the place.
#include "host/toml_section.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "hal/replay/toml_text.hpp"

namespace penduline {
namespace {

bool within(double value, const NumberBounds& bounds) {
  return std::isfinite(value) && value <= bounds.most &&
         (bounds.open ? value > bounds.least : value >= bounds.least);
}

}  // namespace

void TomlFindings::fail(const toml::node& node, std::string_view message) {
  if (!error) {
    error = Error{one_line(fmt::format("{}:{}: {}", file, node.source().begin.line, message))};
  }
}

const toml::node* TomlSection::find(std::string_view key) {
  known_.emplace(key);
  return table_.get(key);
}

void TomlSection::fail(std::string_view key, std::string_view message) {
  const toml::node* node = table_.get(key);
  findings_.fail(node != nullptr ? *node : static_cast<const toml::node&>(table_),
                 fmt::format("{} {}: {}", path_, key, message));
}

void TomlSection::wrong(std::string_view key, std::string_view words) {
  const toml::node* node = table_.get(key);
  fail(key, node != nullptr ? fmt::format("found {}, expected {}", toml_text(*node), words)
                            : fmt::format("missing, expected {}", words));
}

double TomlSection::number(std::string_view key, const NumberBounds& bounds) {
  const toml::node* node = find(key);
  const auto value = node != nullptr ? node->value<double>() : std::nullopt;
  if (!value || !within(*value, bounds)) {
    wrong(key, bounds.words);
    return bounds.most;
  }
  return *value;
}

double TomlSection::number_or(std::string_view key, const NumberBounds& bounds, double otherwise) {
  return find(key) == nullptr ? otherwise : number(key, bounds);
}

std::string TomlSection::text(std::string_view key, std::string_view words) {
  const toml::node* node = find(key);
  const auto value = node != nullptr ? node->value<std::string>() : std::nullopt;
  if (!value) {
    wrong(key, words);
  }
  return value.value_or(std::string());
}

std::string TomlSection::text_or(std::string_view key, std::string_view words,
                                 std::string otherwise) {
  return find(key) == nullptr ? std::move(otherwise) : text(key, words);
}

bool TomlSection::flag_or(std::string_view key, bool otherwise) {
  const toml::node* node = find(key);
  if (node != nullptr && !node->is_boolean()) {
    wrong(key, "true or false");
  }
  return node != nullptr ? node->value_or(otherwise) : otherwise;
}

std::vector<double> TomlSection::numbers(std::string_view key, std::size_t least,
                                         std::size_t most) {
  const toml::node* node = find(key);
  const toml::array* array = node != nullptr ? node->as_array() : nullptr;
  std::vector<double> values;
  bool good = array != nullptr && array->size() >= least && array->size() <= most;
  if (good) {
    for (const toml::node& element : *array) {
      const auto value = element.value<double>();
      good = good && value && std::isfinite(*value);
      values.push_back(value.value_or(0));
    }
  }
  if (!good) {
    wrong(key, least == most ? fmt::format("an array of {} numbers", least)
                             : fmt::format("an array of {} to {} numbers", least, most));
    values.assign(least, 0);
  }
  return values;
}

const toml::table* TomlSection::section(std::string_view key) {
  const toml::node* node = find(key);
  if (node != nullptr && !node->is_table()) {
    wrong(key, "a table");
  }
  return node != nullptr ? node->as_table() : nullptr;
}

const toml::array* TomlSection::array(std::string_view key) {
  const toml::node* node = find(key);
  if (node != nullptr && !node->is_array_of_tables()) {
    wrong(key, fmt::format("tables [[{}]]", key));
    return nullptr;
  }
  return node != nullptr ? node->as_array() : nullptr;
}

void TomlSection::complain_of_unknown_keys() {
  for (const auto& [key, node] : table_) {
    if (known_.find(key.str()) == known_.end()) {
      findings_.complaints.push_back(one_line(
          fmt::format("{}:{}: {} {}: unknown key, ignored; known are {}", findings_.file,
                      node.source().begin.line, path_, key.str(), fmt::join(known_, ", "))));
    }
  }
}

}  // namespace penduline
