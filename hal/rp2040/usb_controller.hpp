// SPDX-License-Identifier: Apache-2.0
// The RP2040's USB controller in device mode: its registers, and arming its buffers (data
// sheet 4.1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/rp2040/registers.hpp"

namespace penduline::rp2040::usb {

inline constexpr std::uint32_t kMemory = 0x50100000;
inline constexpr std::uint32_t kMemoryBytes = 0x1000;
inline constexpr std::uint32_t kAddress = 0x50110000;
inline constexpr std::uint32_t kMainCtrl = 0x50110040;
inline constexpr std::uint32_t kFrameNumber = 0x50110048;
inline constexpr std::uint32_t kSieCtrl = 0x5011004c;
inline constexpr std::uint32_t kSieStatus = 0x50110050;
inline constexpr std::uint32_t kBufferStatus = 0x50110058;
inline constexpr std::uint32_t kStallArm = 0x50110068;
inline constexpr std::uint32_t kMuxing = 0x50110074;
inline constexpr std::uint32_t kPower = 0x50110078;
inline constexpr std::uint32_t kInterruptEnable = 0x50110090;
inline constexpr std::uint32_t kInterruptStatus = 0x50110098;

// Bits of kInterruptStatus and of kSieStatus.
inline constexpr std::uint32_t kOnBuffer = 1U << 4U;
inline constexpr std::uint32_t kOnBusReset = 1U << 12U;
inline constexpr std::uint32_t kOnSetup = 1U << 16U;
inline constexpr std::uint32_t kOnFrame = 1U << 17U;
inline constexpr std::uint32_t kBusResetSeen = 1U << 19U;
inline constexpr std::uint32_t kSetupSeen = 1U << 17U;

/// Which way an endpoint's packets go, seen from the host.
enum class Direction : std::uint32_t { kIn = 0, kOut = 1 };

/// Where the packets of endpoint 0 and of the others stand in the controller's memory.
inline constexpr std::uint32_t kControlBuffer = 0x100;
inline constexpr std::uint32_t kNotifyBuffer = 0x180;
inline constexpr std::uint32_t kInBuffer = 0x1c0;
inline constexpr std::uint32_t kOutBuffer = 0x200;

/// Bit of an endpoint in kBufferStatus.
[[nodiscard]] constexpr std::uint32_t buffer_bit(std::uint32_t endpoint, Direction direction) {
  return 1U << (2 * endpoint + static_cast<std::uint32_t>(direction));
}

[[nodiscard]] constexpr std::uint32_t buffer_ctrl(std::uint32_t endpoint, Direction direction) {
  return kMemory + 0x80 + 8 * endpoint + 4 * static_cast<std::uint32_t>(direction);
}

/// Endpoints from 1 on; endpoint 0 needs none.
[[nodiscard]] constexpr std::uint32_t endpoint_ctrl(std::uint32_t endpoint, Direction direction) {
  return kMemory + 8 * endpoint + 4 * static_cast<std::uint32_t>(direction);
}

enum class TransferType : std::uint32_t { kBulk = 2, kInterrupt = 3 };

inline void open_endpoint(std::uint32_t endpoint, Direction direction, TransferType type,
                          std::uint32_t buffer) {
  constexpr std::uint32_t kEnable = 1U << 31U;
  constexpr std::uint32_t kInterruptEachBuffer = 1U << 29U;
  reg(endpoint_ctrl(endpoint, direction)) =
      kEnable | kInterruptEachBuffer | (static_cast<std::uint32_t>(type) << 26U) | buffer;
}

/// The controller's memory takes bytes, but no bursts.
inline void copy_in(std::uint32_t buffer, std::span<const std::uint8_t> bytes) {
  auto* to = reinterpret_cast<volatile std::uint8_t*>(kMemory + buffer);  // NOLINT: an address
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    to[i] = bytes[i];
  }
}
inline void copy_out(std::uint32_t buffer, std::span<std::uint8_t> bytes) {
  const auto* from = reinterpret_cast<const volatile std::uint8_t*>(kMemory + buffer);  // NOLINT
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = from[i];
  }
}

/// Hands a buffer to the controller: `bytes` to be sent, or room for as many. `data1` is the
/// packet's turn of DATA0 and DATA1.
inline void arm(std::uint32_t endpoint, Direction direction, std::size_t bytes, bool data1) {
  constexpr std::uint32_t kFull = 1U << 15U;
  constexpr std::uint32_t kData1 = 1U << 13U;
  constexpr std::uint32_t kAvailable = 1U << 10U;
  const std::uint32_t value = static_cast<std::uint32_t>(bytes) | (data1 ? kData1 : 0) |
                              (direction == Direction::kIn ? kFull : 0);
  volatile std::uint32_t& ctrl = reg(buffer_ctrl(endpoint, direction));
  ctrl = value;
  // The controller runs at 48 MHz and must see the rest before "available" (4.1.2.5.1).
  asm volatile("nop\nnop\nnop\nnop\nnop\nnop\nnop\nnop\nnop\nnop\nnop\nnop");
  ctrl = value | kAvailable;
}

/// Refuses a request on endpoint 0.
inline void stall_control() {
  constexpr std::uint32_t kStall = 1U << 11U;
  set_bits(kStallArm, 3);
  reg(buffer_ctrl(0, Direction::kIn)) = kStall;
  reg(buffer_ctrl(0, Direction::kOut)) = kStall;
}

}  // namespace penduline::rp2040::usb
