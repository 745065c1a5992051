// SPDX-License-Identifier: Apache-2.0
// A rig's TOML tree, changed and printed.
#include "host/rig_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "hal/replay/line_reader.hpp"
#include "hal/replay/toml_text.hpp"
#include "host/rig_file.hpp"

namespace penduline {
namespace {

void put_model(toml::table& table, const LinearResponse<double>& model) {
  table.insert("model", "linear");
  table.insert("gap_at_zero_m", rounded(model.gap_at_zero_m));
  table.insert("slope_m_per_v", rounded(model.slope_m_per_v));
}

void put_model(toml::table& table, const TableResponse<double>& model) {
  table.insert("model", "table");
  table.insert("volts", rounded_numbers(model.gap_over_volts.x()));
  table.insert("gap_m", rounded_numbers(model.gap_over_volts.y()));
}

void put_model(toml::table& table, const InverseSquareResponse<double>& model) {
  table.insert("model", "inverse_square");
  table.insert("a_v_m2", rounded(model.a_v_m2));
  table.insert("b_m", rounded(model.b_m));
  table.insert("c_v", rounded(model.c_v));
}

void put_model(toml::table& table, const PolynomialResponse<double>& model) {
  constexpr int kDigits = 12;  // of terms that cancel
  toml::array coefficients;
  for (std::size_t i = 0; i < model.count; ++i) {
    coefficients.push_back(rounded(model.coefficient[i], kDigits));
  }
  table.insert("model", "polynomial");
  table.insert("coefficients", std::move(coefficients));
  table.insert("range_v", toml::array(rounded(model.volts_min), rounded(model.volts_max)));
}

toml::table response_table(const Response<double>& response) {
  toml::table table;
  std::visit([&](const auto& model) { put_model(table, model); }, response.model);
  if (std::isfinite(response.farthest_m)) {
    table.insert("range_m", toml::array(rounded(response.nearest_m), rounded(response.farthest_m)));
  }
  if (response.peak_m > 0) {
    table.insert("peak_m", rounded(response.peak_m));
  }
  return table;
}

/// Keys in the order in which one reads them, then all others.
std::vector<std::string> ordered_keys(const toml::table& table,
                                      std::span<const std::string_view> first) {
  std::vector<std::string> keys;
  for (const std::string_view key : first) {
    if (table.contains(key)) {
      keys.emplace_back(key);
    }
  }
  for (const auto& [key, node] : table) {
    if (std::ranges::find(first, key.str()) == first.end()) {
      keys.emplace_back(key.str());
    }
  }
  return keys;
}

constexpr std::array<std::string_view, 11> kFirstKeys = {
    "name",       "position_m", "response",   "model",  "method", "date",
    "recordings", "residual_m", "parameters", "values", "sigmas"};

/// A key as it is, or in quotes where it is not a bare one.
std::string key_text(const std::string& key) {
  const bool bare = !key.empty() && std::ranges::all_of(key, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  return bare ? key : toml_quoted(key);
}

/// Any value. An array of arrays has a line for each.
std::string value_text(const toml::node& node) {
  std::string text;
  if (const auto* array = node.as_array()) {
    for (const toml::node& element : *array) {
      text += text.empty() ? "" : element.is_array() ? ",\n  " : ", ";
      text += value_text(element);
    }
    return '[' + text + ']';
  }
  if (const auto* table = node.as_table()) {
    for (const std::string& key : ordered_keys(*table, kFirstKeys)) {
      text += fmt::format("{}{} = {}", text.empty() ? " " : ", ", key_text(key),
                          value_text(*table->get(key)));
    }
    return '{' + text + " }";
  }
  const auto* string = node.as_string();
  return string != nullptr ? toml_quoted(string->get()) : toml_text(node);
}

/// One section, its tables within on one line each.
std::string section_text(const std::string& header, const toml::table& table) {
  std::string text = header + '\n';
  for (const std::string& key : ordered_keys(table, kFirstKeys)) {
    text += fmt::format("{} = {}\n", key_text(key), value_text(*table.get(key)));
  }
  return text;
}

std::string printed(const toml::table& rig) {
  constexpr std::array<std::string_view, 5> kFirst = {"pendulum", "disc", "sensor", "filter",
                                                      "gpio"};
  std::vector<std::string> keys = ordered_keys(rig, kFirst);
  std::stable_partition(keys.begin(), keys.end(),
                        [](const std::string& key) { return key != "calibration"; });
  std::string plain;  // keys outside any section must come first
  std::string sections;
  for (const std::string& key : keys) {
    const toml::node& node = *rig.get(key);
    if (node.is_table()) {
      sections += '\n' + section_text(fmt::format("[{}]", key_text(key)), *node.as_table());
    } else if (node.is_array_of_tables()) {
      for (const toml::node& element : *node.as_array()) {
        sections += '\n' + section_text(fmt::format("[[{}]]", key_text(key)), *element.as_table());
      }
    } else {
      plain += fmt::format("{} = {}\n", key_text(key), value_text(node));
    }
  }
  return "# Written by 'penduline calibrate'; [calibration] says from what.\n" + plain + sections;
}

}  // namespace

Rig<double> changed(Rig<double> rig, const RigChanges& changes) {
  rig.layout.disc_offset_m = changes.disc_offset_m.value_or(rig.layout.disc_offset_m);
  for (std::size_t i = 0; i < rig.layout.count; ++i) {
    rig.layout.position_m[i] = changes.positions_m[i].value_or(rig.layout.position_m[i]);
    rig.responses[i] = changes.responses[i].value_or(rig.responses[i]);
    rig.noise[i].volts = changes.noise_v[i].value_or(rig.noise[i].volts);
  }
  return rig;
}

tl::expected<std::string, Error> rewritten_rig(const std::string& path, const RigChanges& changes,
                                               const CalibrationRecord& record) {
  const auto before = read_whole_text(path);
  if (!before) {
    return tl::unexpected(before.error());
  }
  if (const auto rig = parse_rig(*before, path); !rig) {
    return tl::unexpected(rig.error());
  }
  toml::table rig = toml::parse(*before);
  if (changes.disc_offset_m) {
    rig["disc"].as_table()->insert_or_assign("offset_m", rounded(*changes.disc_offset_m));
  }
  toml::array& sensors = *rig["sensor"].as_array();
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    toml::table& sensor = *sensors[i].as_table();
    if (changes.positions_m[i]) {
      sensor.insert_or_assign("position_m", rounded_numbers(*changes.positions_m[i]));
    }
    if (changes.responses[i]) {
      sensor.insert_or_assign("response", response_table(*changes.responses[i]));
    }
    if (changes.noise_v[i]) {
      sensor.insert_or_assign("noise_v", rounded(*changes.noise_v[i], 2));
    }
  }
  rig.insert_or_assign("calibration", calibration_table(record));
  std::string text = printed(rig);
  if (const auto written = parse_rig(text, "the new rig"); !written) {
    return tl::unexpected(written.error());
  }
  return text;
}

}  // namespace penduline
