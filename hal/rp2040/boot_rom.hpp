// SPDX-License-Identifier: Apache-2.0
// Functions in the RP2040's boot ROM, found by their two-letter codes (data sheet 2.8.3).
#pragma once

#include <cstdint>

namespace penduline::rp2040::rom {

/// The code of a function as the ROM's table has it.
[[nodiscard]] constexpr std::uint32_t code(char first, char second) {
  return static_cast<std::uint32_t>(first) | (static_cast<std::uint32_t>(second) << 8U);
}

/// Looks a function up; the table and the function that searches it stand at fixed addresses.
template <class Function>
[[nodiscard]] Function function(std::uint32_t code) {
  using Lookup = void* (*)(const std::uint16_t* table, std::uint32_t code);
  const auto halfword = [](std::uint32_t address) {
    asm("" : "+r"(address));  // the compiler takes a known address so low for a null pointer
    return std::uintptr_t{*reinterpret_cast<const volatile std::uint16_t*>(address)};  // NOLINT
  };
  constexpr std::uint32_t kTable = 0x14;
  constexpr std::uint32_t kLookup = 0x18;
  const auto lookup = reinterpret_cast<Lookup>(halfword(kLookup));               // NOLINT
  const auto* table = reinterpret_cast<const std::uint16_t*>(halfword(kTable));  // NOLINT
  return reinterpret_cast<Function>(lookup(table, code));                        // NOLINT
}

using Action = void (*)();
using RangeErase = void (*)(std::uint32_t offset, std::uint32_t bytes, std::uint32_t block_bytes,
                            std::uint8_t block_command);
using RangeProgram = void (*)(std::uint32_t offset, const std::uint8_t* data, std::uint32_t bytes);
using UsbBoot = void (*)(std::uint32_t activity_pins, std::uint32_t disabled_interfaces);

inline constexpr std::uint32_t kConnectFlash = code('I', 'F');
inline constexpr std::uint32_t kExitXip = code('E', 'X');
inline constexpr std::uint32_t kEraseRange = code('R', 'E');
inline constexpr std::uint32_t kProgramRange = code('R', 'P');
inline constexpr std::uint32_t kFlushCache = code('F', 'C');
inline constexpr std::uint32_t kEnterXip = code('C', 'X');
inline constexpr std::uint32_t kUsbBoot = code('U', 'B');

}  // namespace penduline::rp2040::rom
