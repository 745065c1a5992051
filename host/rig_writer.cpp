// SPDX-License-Identifier: Apache-2.0
// A rig's TOML tree, changed and printed.
#include "host/rig_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string_view>

#include "hal/replay/line_reader.hpp"
#include "host/output/text_file.hpp"
#include "host/rig_file.hpp"

namespace penduline {
namespace {

template <class Numbers>
toml::array numbers_of(const Numbers& numbers) {
  toml::array array;
  for (const double number : numbers) {
    array.push_back(rounded(number));
  }
  return array;
}

void put_model(toml::table& table, const LinearResponse<double>& model) {
  table.insert("model", "linear");
  table.insert("gap_at_zero_m", rounded(model.gap_at_zero_m));
  table.insert("slope_m_per_v", rounded(model.slope_m_per_v));
}

void put_model(toml::table& table, const TableResponse<double>& model) {
  table.insert("model", "table");
  table.insert("volts", numbers_of(model.gap_over_volts.x()));
  table.insert("gap_m", numbers_of(model.gap_over_volts.y()));
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
  table.is_inline(true);
  return table;
}

/// The sections in the order in which one reads them, whatever else there is, the record last.
std::string printed(const toml::table& rig) {
  constexpr std::array<std::string_view, 6> kOrder = {"pendulum", "disc", "sensor",
                                                      "filter",   "gpio", "calibration"};
  const auto rank = [&](std::string_view key) {
    const auto* const at = std::ranges::find(kOrder, key);
    return key == kOrder.back() ? kOrder.size() + 1 : static_cast<std::size_t>(at - kOrder.begin());
  };
  std::ostringstream text;
  text << "# Written by 'penduline calibrate'; [calibration] says from what.\n";
  for (std::size_t wanted = 0; wanted <= kOrder.size() + 1; ++wanted) {
    for (const auto& [key, node] : rig) {
      if (rank(key.str()) == wanted) {
        toml::table section;
        section.insert(key, node);
        text << section << "\n\n";
      }
    }
  }
  std::string result = text.str();
  result.erase(result.find_last_not_of('\n') + 2);
  return result;
}

}  // namespace

Rig<double> changed(Rig<double> rig, const RigChanges& changes) {
  rig.layout.disc_offset_m = changes.disc_offset_m.value_or(rig.layout.disc_offset_m);
  for (std::size_t i = 0; i < rig.layout.count; ++i) {
    rig.layout.position_m[i] = changes.positions_m[i].value_or(rig.layout.position_m[i]);
    rig.responses[i] = changes.responses[i].value_or(rig.responses[i]);
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
      sensor.insert_or_assign("position_m", numbers_of(*changes.positions_m[i]));
    }
    if (changes.responses[i]) {
      sensor.insert_or_assign("response", response_table(*changes.responses[i]));
    }
  }
  rig.insert_or_assign("calibration", calibration_table(record));
  std::string text = printed(rig);
  if (const auto written = parse_rig(text, "the new rig"); !written) {
    return tl::unexpected(written.error());
  }
  return text;
}

tl::expected<void, Error> put_file(const std::string& path, const std::string& text) {
  const std::string unfinished = path + ".part";
  auto file = TextFile::create(unfinished);
  if (!file) {
    return tl::unexpected(file.error());
  }
  file->text() = text;
  std::error_code error;
  if (const auto flushed = file->flush(); !flushed) {
    std::filesystem::remove(unfinished, error);
    return flushed;
  }
  std::filesystem::rename(unfinished, path, error);
  if (error) {
    return failure(fmt::format("{}: cannot write: {}", path, error.message()));
  }
  return {};
}

}  // namespace penduline
