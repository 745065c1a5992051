// SPDX-License-Identifier: Apache-2.0
// Reading a recording's header by toml++.
#include "hal/replay/recording_header.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "hal/replay/toml_text.hpp"

namespace penduline {
namespace {

constexpr double kLeastReferenceV = 1e-6;
constexpr double kMostReferenceV = 1e6;

}  // namespace

tl::expected<RecordingHeader, Error> parse_recording_header(const std::string& text,
                                                            const std::string& file,
                                                            std::uint64_t first_line) {
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& error) {
    return failure(fmt::format("{}:{}: the header is not TOML behind '# ': {}", file,
                               first_line + error.source().begin.line - 1, error.description()));
  }
  const auto wrong = [&](std::string_view key, std::string_view expected) {
    const toml::node* found = table.get(key);
    return failure(found == nullptr ? fmt::format("{}: header key '{}': missing, expected {}", file,
                                                  key, expected)
                                    : fmt::format("{}:{}: header key '{}': found {}, expected {}",
                                                  file, first_line + found->source().begin.line - 1,
                                                  key, toml_text(*found), expected));
  };
  const auto within = [&](std::string_view key, double least, double most) {
    const auto value = table[key].value<double>();
    return value && *value >= least && *value <= most ? value : std::nullopt;
  };

  const auto version = table[kVersionKey].value_exact<std::int64_t>();
  if (version != kRecordingVersion) {
    return wrong(kVersionKey, fmt::format("{}", kRecordingVersion));
  }
  const auto rate_hz = within("rate_hz", kSlowestHz, kFastestHz);
  if (!rate_hz) {
    return wrong("rate_hz", fmt::format("a rate from {} to {}", kSlowestHz, kFastestHz));
  }
  const auto full_scale_counts =
      within("full_scale_counts", 1, std::numeric_limits<std::int32_t>::max());
  if (!full_scale_counts || *full_scale_counts != std::floor(*full_scale_counts)) {
    return wrong("full_scale_counts", "the counts at full scale, a whole number such as 65535");
  }
  const auto reference_v = within("reference_v", kLeastReferenceV, kMostReferenceV);
  if (!reference_v) {
    return wrong("reference_v",
                 fmt::format("a voltage from {} to {}", kLeastReferenceV, kMostReferenceV));
  }
  RecordingHeader header{.acquisition = {.rate_hz = *rate_hz,
                                         .full_scale_counts = *full_scale_counts,
                                         .reference_v = *reference_v},
                         .board = table["board"].value_or(std::string()),
                         .firmware = table["firmware"].value_or(std::string()),
                         .started = "",
                         .serial = table["serial"].value_or(std::string()),
                         .boot_id = table["boot_id"].value<std::uint32_t>()};
  if (const auto started = table["started"].value<toml::date_time>()) {
    std::ostringstream started_text;
    started_text << *started;
    header.started = started_text.str();
  }
  return header;
}

}  // namespace penduline
