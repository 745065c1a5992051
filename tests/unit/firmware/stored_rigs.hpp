// SPDX-License-Identifier: Apache-2.0
// What the tests of stored rigs share: a rig, its image, and a store in memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "common/wire/rig_image.hpp"
#include "hal/concepts.hpp"
#include "tests/unit/common/test_rig.hpp"
#include "tests/unit/common/wire_examples.hpp"

namespace penduline::test {

/// The paper's layout with linear sensors and a filter.
[[nodiscard]] inline Rig<float> two_sensor_rig() {
  Rig<float> rig = linear_rig(paper_layout<float>());
  rig.pendulum = {.length_m = 0.3F, .mass_kg = 0.1F, .gravity_m_s2 = 9.8F, .damping_per_s = 0.01F};
  return rig;
}

[[nodiscard]] inline Bytes image_of(const wire::BoardRig& rig) {
  Bytes image(wire::kMaxRigImageBytes);
  image.resize(wire::encode_rig(rig, image));
  return image;
}
[[nodiscard]] inline Bytes image_of(const Rig<float>& rig) {
  return image_of(wire::BoardRig{.rig = rig});
}

/// As large as a small flash sector, and erased.
struct MemoryStore {
  static constexpr std::size_t kBytes = 2048;
  Bytes bytes = Bytes(kBytes, 0xff);
  bool worn_out = false;

  [[nodiscard]] std::span<const std::uint8_t> contents() const { return bytes; }
  bool replace(std::span<const std::uint8_t> block) {
    if (worn_out) {
      return false;
    }
    bytes.assign(kBytes, 0xff);
    std::ranges::copy(block, bytes.begin());
    return true;
  }
};

static_assert(Store<MemoryStore>);

}  // namespace penduline::test
