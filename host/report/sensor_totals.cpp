// SPDX-License-Identifier: Apache-2.0
// Counting sensor by sensor.
#include "host/report/sensor_totals.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/web/sensor_now.hpp"

namespace penduline {

void SensorTotals::take(const Sample& sample) {
  for (std::size_t i = 0; i < totals_.size(); ++i) {
    const SensorNow now = sensor_now(rig_, acquisition_, sample, i);
    SensorTotal& total = totals_[i];
    total.saturated += now.saturated.value_or(false) ? 1U : 0U;
    total.maybe_saturated += now.saturated ? 0U : 1U;
    total.out_of_range += now.out_of_range ? 1U : 0U;
    total.missing += now.signal_v ? 0U : 1U;
    if (now.ambient_v) {
      const auto [least, greatest] =
          total.ambient_v.value_or(std::pair(*now.ambient_v, *now.ambient_v));
      total.ambient_v = {std::min(least, *now.ambient_v), std::max(greatest, *now.ambient_v)};
    }
  }
}

std::string SensorTotals::json() const {
  using Json = nlohmann::ordered_json;
  Json sensors = Json::array();
  for (const SensorTotal& total : totals_) {
    Json ambient;
    if (total.ambient_v) {
      ambient = {total.ambient_v->first, total.ambient_v->second};
    }
    sensors.push_back({{"saturated", total.saturated},
                       {"maybe_saturated", total.maybe_saturated},
                       {"out_of_range", total.out_of_range},
                       {"missing", total.missing},
                       {"ambient_v", std::move(ambient)}});
  }
  return sensors.dump();
}

}  // namespace penduline
