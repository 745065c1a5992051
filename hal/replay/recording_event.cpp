// SPDX-License-Identifier: Apache-2.0
// Events as TOML on one line.
#include "hal/replay/recording_event.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cstddef>

#include "hal/replay/cells.hpp"
#include "hal/replay/toml_text.hpp"
#include "hal/replay/utc_text.hpp"

namespace penduline {
namespace {

constexpr std::string_view kEnd = " }\n";

/// Whether a text is a word that needs no quotes in TOML, and not an endless one.
bool is_word(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  return !text.empty() && text.size() <= kLongest && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

std::string value_text(const RecordingEvent::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    return toml_quoted(*text);
  }
  if (const auto* number = std::get_if<double>(&value)) {
    return toml_text(toml::value<double>(*number));
  }
  return fmt::format("{}", std::get<std::int64_t>(value));
}

/// A field of TOML as one of an event; none where it is no number or string.
std::optional<RecordingEvent::Value> value_of(const toml::node& node) {
  if (const auto* number = node.as_integer()) {
    return number->get();
  }
  if (const auto* number = node.as_floating_point()) {
    return number->get();
  }
  if (const auto* text = node.as_string()) {
    return text->get();
  }
  return std::nullopt;
}

}  // namespace

RecordingEvent boot_event(const RecordingHeader& header, std::optional<std::int64_t> utc_us) {
  RecordingEvent event{.kind = std::string(event::kBoot), .utc_us = utc_us};
  if (header.boot_id) {
    event.fields.push_back({"boot_id", std::int64_t{*header.boot_id}});
  }
  event.fields.push_back({"serial", header.serial});
  event.fields.push_back({"board", header.board});
  event.fields.push_back({"firmware", header.firmware});
  return event;
}

bool connected_after(const RecordingEvent& event, bool before) {
  return event.kind == event::kConnected || (before && event.kind != event::kDisconnected);
}

std::string event_line(const RecordingEvent& event) {
  std::string line = fmt::format("{}{{ kind = {}", kEventStart, toml_quoted(event.kind));
  if (event.utc_us) {
    line += fmt::format(", utc = {}", utc_text(*event.utc_us));
  }
  for (const RecordingEvent::Field& field : event.fields) {
    const std::string text =
        fmt::format(", {} = {}", is_word(field.key) ? field.key : toml_quoted(field.key),
                    value_text(field.value));
    if (line.size() + text.size() + kEnd.size() <= kMaxEventBytes) {
      line += text;
    }
  }
  line += kEnd;
  return line;
}

tl::expected<RecordingEvent, Error> parse_event(std::string_view line) {
  const auto wrong = [&](std::string_view why) {
    return failure(
        fmt::format("found '{}' ({}), expected an event such as '# event = {{ kind = "
                    "\"boot\" }}'",
                    excerpt(line), why));
  };
  toml::table table;
  try {
    table = toml::parse(line.substr(std::min(line.size(), std::string_view("# ").size())));
  } catch (const toml::parse_error& error) {
    return wrong(error.description());
  }
  const toml::table* fields = table["event"].as_table();
  if (fields == nullptr) {
    return wrong("no table");
  }
  RecordingEvent event{.kind = (*fields)["kind"].value_or(std::string())};
  if (!is_word(event.kind)) {
    return wrong("no word as its kind");
  }
  if (const auto utc = (*fields)["utc"].value<toml::date_time>()) {
    event.utc_us = utc_us_of(*utc);
  }
  for (const auto& [key, node] : *fields) {
    if (key == "kind" || key == "utc") {
      continue;
    }
    if (auto value = value_of(node)) {
      event.fields.push_back({std::string(key.str()), std::move(*value)});
    }
  }
  return event;
}

}  // namespace penduline
