// SPDX-License-Identifier: Apache-2.0
// Reading and checking rig files.
#include "host/rig_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/closed_form.hpp"
#include "hal/replay/line_reader.hpp"
#include "host/response_section.hpp"
#include "host/toml_section.hpp"

namespace penduline {
namespace {

void read_pendulum(const toml::table& table, Pendulum<double>& pendulum, TomlFindings& findings) {
  TomlSection section(table, "[pendulum]", findings);
  pendulum.length_m = section.number("length_m", kAboveZero);
  pendulum.mass_kg = section.number_or("mass_kg", kAboveZero, pendulum.mass_kg);
  pendulum.gravity_m_s2 = section.number_or("gravity_m_s2", kAboveZero, pendulum.gravity_m_s2);
  pendulum.damping_per_s = section.number_or("damping_per_s", kNotNegative, 0);
  section.complain_of_unknown_keys();
}

void read_disc(const toml::table& table, Rig<double>& rig, TomlFindings& findings) {
  TomlSection section(table, "[disc]", findings);
  rig.layout.disc_offset_m = section.number("offset_m", kAboveZero);
  rig.disc_diameter_m = section.number("diameter_m", kAboveZero);
  section.complain_of_unknown_keys();
}

void read_filter(const toml::table& table, Rig<double>& rig, TomlFindings& findings) {
  constexpr NumberBounds kOrder{0, kMaxTaps - 1, false, "a whole number from 0 to 63"};
  constexpr NumberBounds kCutoff{0, 1, true, "a number above 0, up to 1"};
  TomlSection section(table, "[filter]", findings);
  const double order = section.number("order", kOrder);
  if (order != std::floor(order)) {
    section.fail("order", fmt::format("found {}, expected {}", order, kOrder.words));
  }
  rig.filter = {.order = static_cast<std::size_t>(order),
                .cutoff_of_nyquist = section.number("cutoff_of_nyquist", kCutoff)};
  section.complain_of_unknown_keys();
}

void read_trust(const toml::table& table, Rig<double>& rig, TomlFindings& findings) {
  TomlSection section(table, "[ekf]", findings);
  FilterTrust<double>& trust = rig.trust;
  const auto read = [&](std::string_view key, double& value) {
    value = section.number_or(key, kNotNegative, value);
  };
  double length_sigma_m = trust.length_share * rig.pendulum.length_m;
  read("length_sigma_m", length_sigma_m);
  trust.length_share = length_sigma_m / rig.pendulum.length_m;
  read("damping_sigma_per_s", trust.damping_per_s);
  read("offset_sigma_m", trust.offset_m);
  trust.acceleration_rad_s15 =
      section.number_or("acceleration_rad_s15", kAboveZero, trust.acceleration_rad_s15);
  read("damping_walk_per_s15", trust.damping_walk_per_s15);
  read("offset_walk_m_s05", trust.offset_walk_m_s05);
  section.complain_of_unknown_keys();
}

void read_sensor(const toml::table& table, std::size_t index, RigFile& file,
                 TomlFindings& findings) {
  TomlSection section(table, fmt::format("[[sensor]] {}", index + 1), findings);
  file.sensor_names.push_back(
      section.text_or("name", "a name in quotes", fmt::format("S{}", index + 1)));
  const std::vector<double> position = section.numbers("position_m", 3, 3);
  file.rig.layout.position_m[index] = {position[0], position[1], position[2]};
  if (const toml::table* response = section.section("response")) {
    file.rig.responses[index] =
        read_response(*response, fmt::format("[[sensor]] {} response", index + 1), findings);
  } else {
    section.fail("response", "missing, expected a table such as { model = \"linear\", ... }");
  }
  SensorNoise<double>& noise = file.rig.noise[index];
  noise.volts = section.number_or("noise_v", kNotNegative, noise.volts);
  noise.gap_m = section.number_or("noise_m", kAboveZero, noise.gap_m);
  section.complain_of_unknown_keys();
}

void read_sensors(const toml::array& sensors, RigFile& file, TomlFindings& findings) {
  if (sensors.size() < 2 || sensors.size() > kMaxSensors) {
    findings.fail(sensors, fmt::format("[[sensor]]: found {}, expected 2 to {}", sensors.size(),
                                       kMaxSensors));
    return;
  }
  file.rig.layout.count = sensors.size();
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    read_sensor(*sensors[i].as_table(), i, file, findings);
  }
  if (!findings.error && !determines_tilt(file.rig.layout)) {
    findings.fail(sensors,
                  "[[sensor]]: the positions lie on one line through the pivot, expected sensors "
                  "on two sides such as X and Y");
  }
}

}  // namespace

tl::expected<RigFile, Error> parse_rig(const std::string& toml_text, const std::string& name) {
  toml::table root;
  try {
    root = toml::parse(toml_text);
  } catch (const toml::parse_error& error) {
    return failure(
        fmt::format("{}:{}: not TOML: {}", name, error.source().begin.line, error.description()));
  }
  RigFile file;
  TomlFindings findings{.file = name, .error = {}, .complaints = {}};
  TomlSection top(root, "rig file", findings);
  const auto require = [&](std::string_view key, std::string_view header, const auto* found) {
    if (found == nullptr) {
      top.fail(key, fmt::format("missing, expected {}", header));
    }
    return found != nullptr;
  };
  if (const auto* table = top.section("pendulum"); require("pendulum", "[pendulum]", table)) {
    read_pendulum(*table, file.rig.pendulum, findings);
  }
  if (const auto* table = top.section("disc"); require("disc", "[disc]", table)) {
    read_disc(*table, file.rig, findings);
  }
  if (const auto* sensors = top.array("sensor"); require("sensor", "[[sensor]]", sensors)) {
    read_sensors(*sensors, file, findings);
  }
  if (const auto* table = top.section("filter")) {
    read_filter(*table, file.rig, findings);
  }
  if (const auto* table = top.section("ekf")) {
    read_trust(*table, file.rig, findings);
  }
  if (const auto* table = top.section("gpio")) {
    file.lines = read_gpio(*table, findings);
  }
  if (const auto* table = top.section("calibration")) {
    file.calibration = read_calibration(*table, findings);
  }
  top.complain_of_unknown_keys();
  if (findings.error) {
    return tl::unexpected(*findings.error);
  }
  file.complaints = std::move(findings.complaints);
  return file;
}

tl::expected<RigFile, Error> read_rig_file(const std::string& path) {
  return read_whole_text(path).and_then(
      [&](const std::string& text) { return parse_rig(text, path); });
}

}  // namespace penduline
