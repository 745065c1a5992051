// SPDX-License-Identifier: Apache-2.0
// The USB probe's descriptors (USB 2.0 sec. 9.6, CDC 1.2 sec. 5.2.3) and the mistakes it can be
// built with.
#pragma once

#include <cstdint>

enum class Mistake {
  none,
  no_pull_up,
  no_clock,
  no_controller,
  no_vbus,
  no_endpoint_enable,
  no_stall_arm,
  no_toggle,
  no_full,
  full_out,
  available_at_once,
  overlong,
  short_out,
  low_buffer,
  double_buffer,
  address_early,
  long_status,
  long_reply,
  no_strings,
  no_configuration,
  stalled_bulk,
  late_in_frame,
};

struct Bytes {
  const std::uint8_t* data;
  unsigned size;
};

inline constexpr std::uint8_t kDeviceBytes[] = {18,   1, 0, 2, 2, 0, 0, 64, 0x09,
                                                0x12, 1, 0, 0, 1, 1, 2, 3,  1};
inline constexpr std::uint8_t kConfigurationBytes[] = {
    9, 2,    67, 0,  2, 1, 0,    0x80, 50, 9, 4,    0,  0, 1, 2, 2, 0,    0, 5,  0x24, 0,  0x10, 1,
    5, 0x24, 1,  0,  1, 4, 0x24, 2,    2,  5, 0x24, 6,  0, 1, 7, 5, 0x81, 3, 8,  0,    16, 9,    4,
    1, 0,    2,  10, 0, 0, 0,    7,    5,  2, 2,    64, 0, 0, 7, 5, 0x82, 2, 64, 0,    0};
inline constexpr std::uint8_t kLanguageBytes[] = {4, 3, 9, 4};
inline constexpr std::uint8_t kNameBytes[] = {12, 3, 'P', 0, 'r', 0, 'o', 0, 'b', 0, 'e', 0};

inline constexpr Bytes kDeviceDescriptor{kDeviceBytes, sizeof kDeviceBytes};
inline constexpr Bytes kConfigurationDescriptor{kConfigurationBytes, sizeof kConfigurationBytes};
inline constexpr Bytes kLanguages{kLanguageBytes, sizeof kLanguageBytes};
inline constexpr Bytes kName{kNameBytes, sizeof kNameBytes};
