// SPDX-License-Identifier: Apache-2.0
// Numbers as bytes, least significant first: explicit loads and stores that know their bounds.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace penduline::wire {

/// What can stand in a payload: integers, floats, enumerations, and arrays of these.
template <class Value>
inline constexpr bool kIsArray = false;
template <class Element, std::size_t kCount>
inline constexpr bool kIsArray<std::array<Element, kCount>> = true;

/// Puts values one after the other into a given room. What does not fit is not written, and
/// `fits()` says so.
class ByteWriter {
 public:
  explicit constexpr ByteWriter(std::span<std::uint8_t> room) : room_(room) {}

  template <class Value>
  constexpr void put(const Value& value) {
    if constexpr (kIsArray<Value>) {
      for (const auto& element : value) {
        put(element);
      }
    } else if constexpr (std::is_same_v<Value, float>) {
      put(std::bit_cast<std::uint32_t>(value));
    } else if constexpr (std::is_enum_v<Value>) {
      put(static_cast<std::underlying_type_t<Value>>(value));
    } else if constexpr (sizeof(Value) == 8) {
      // By halves: a shift of 64 bits is a call on a Cortex-M0+.
      const auto bits = static_cast<std::uint64_t>(value);
      put(static_cast<std::uint32_t>(bits));
      put(static_cast<std::uint32_t>(bits >> 32U));
    } else {
      static_assert(std::is_integral_v<Value>);
      std::uint32_t bits = static_cast<std::make_unsigned_t<Value>>(value);
      for (std::size_t i = 0; i < sizeof(Value); ++i) {
        put_byte(static_cast<std::uint8_t>(bits & 0xFFU));
        bits >>= 8U;
      }
    }
  }

  /// Bytes put so far, those that found no room too.
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool fits() const { return size_ <= room_.size(); }

 private:
  constexpr void put_byte(std::uint8_t byte) {
    if (size_ < room_.size()) {
      room_[size_] = byte;
    }
    ++size_;
  }

  std::span<std::uint8_t> room_;
  std::size_t size_ = 0;
};

/// Takes values one after the other. Past the end all bytes are zero, and `used_up()` is
/// false.
class ByteReader {
 public:
  explicit constexpr ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class Value>
  [[nodiscard]] constexpr Value take() {
    if constexpr (kIsArray<Value>) {
      Value values{};
      for (auto& element : values) {
        element = take<typename Value::value_type>();
      }
      return values;
    } else if constexpr (std::is_same_v<Value, float>) {
      return std::bit_cast<float>(take<std::uint32_t>());
    } else if constexpr (std::is_enum_v<Value>) {
      return static_cast<Value>(take<std::underlying_type_t<Value>>());
    } else if constexpr (sizeof(Value) == 8) {
      const std::uint64_t low = take<std::uint32_t>();
      const std::uint64_t high = take<std::uint32_t>();
      return static_cast<Value>(low | (high << 32U));
    } else {
      static_assert(std::is_integral_v<Value>);
      std::uint32_t bits = 0;
      for (std::size_t i = 0; i < sizeof(Value); ++i) {
        bits |= std::uint32_t{take_byte()} << (8U * i);
      }
      return static_cast<Value>(bits);
    }
  }

  /// Whether all that was there was taken, and no more.
  [[nodiscard]] constexpr bool used_up() const { return size_ == bytes_.size(); }

 private:
  constexpr std::uint8_t take_byte() {
    const std::size_t at = size_++;
    return at < bytes_.size() ? bytes_[at] : std::uint8_t{0};
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t size_ = 0;  ///< bytes taken, those past the end too
};

}  // namespace penduline::wire
