// SPDX-License-Identifier: Apache-2.0
// The rig file's numbers as JSON.
#include "host/output/rig_description.hpp"

#include <unistd.h>

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>

namespace penduline {
namespace {

using Json = nlohmann::ordered_json;

std::string machine_name() {
  std::array<char, 256> name{};
  // One byte stays zero, also where the name is cut short.
  ::gethostname(name.data(), name.size() - 1);
  return name.data();
}

Json sensors_of(const RigFile& rig) {
  Json sensors = Json::array();
  for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
    const Vector3<double>& face = rig.rig.layout.position_m[i];
    sensors.push_back(
        {{"name", rig.sensor_names[i]}, {"position_m", {face.x(), face.y(), face.z()}}});
  }
  return sensors;
}

}  // namespace

std::string describe_rig(const RigFile& rig, const RecordingHeader& header,
                         std::string_view estimator) {
  const Pendulum<double>& pendulum = rig.rig.pendulum;
  const Json description = {
      {"penduline", PENDULINE_VERSION},
      {"machine", machine_name()},
      {"board", header.board},
      {"firmware", header.firmware},
      {"rate_hz", header.acquisition.rate_hz},
      {"estimator", estimator},
      {"pendulum",
       {{"length_m", pendulum.length_m},
        {"mass_kg", pendulum.mass_kg},
        {"gravity_m_s2", pendulum.gravity_m_s2},
        {"damping_per_s", pendulum.damping_per_s}}},
      {"disc",
       {{"offset_m", rig.rig.layout.disc_offset_m}, {"diameter_m", rig.rig.disc_diameter_m}}},
      {"sensors", sensors_of(rig)}};
  // A name from a file or a board may be no UTF-8.
  return description.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace penduline
