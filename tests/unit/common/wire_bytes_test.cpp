// SPDX-License-Identifier: Apache-2.0
// Tests of numbers as bytes: their order, their signs, and both ends of the room.
#include "common/wire/bytes.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tests/unit/common/wire_examples.hpp"

namespace penduline::test {
namespace {

using namespace wire;

template <class Value>
Bytes written(Value value) {
  Bytes bytes(16);
  ByteWriter writer(bytes);
  writer.put(value);
  bytes.resize(writer.size());
  return bytes;
}

template <class Value>
Value read_back(const Bytes& bytes) {
  return ByteReader(bytes).take<Value>();
}

TEST_CASE("The least significant byte comes first", "[wire]") {
  CHECK(written(std::uint16_t{0x0102}) == bytes_of("02 01"));
  CHECK(written(std::uint32_t{0x01020304}) == bytes_of("04 03 02 01"));
  CHECK(written(std::uint64_t{0x0102030405060708}) == bytes_of("08 07 06 05 04 03 02 01"));
  CHECK(read_back<std::uint16_t>(bytes_of("02 01")) == 0x0102);
  CHECK(read_back<std::uint32_t>(bytes_of("04 03 02 01")) == 0x01020304);
  CHECK(read_back<std::uint64_t>(bytes_of("08 07 06 05 04 03 02 01")) == 0x0102030405060708);
}

TEST_CASE("Negative numbers are in two's complement", "[wire]") {
  // struct.pack('<hiq', -2, -2, -2) in Python
  CHECK(written(std::int16_t{-2}) == bytes_of("fe ff"));
  CHECK(written(std::int32_t{-2}) == bytes_of("fe ff ff ff"));
  CHECK(written(std::int64_t{-2}) == bytes_of("fe ff ff ff ff ff ff ff"));
  CHECK(read_back<std::int8_t>(bytes_of("fe")) == -2);
  CHECK(read_back<std::int16_t>(bytes_of("fe ff")) == -2);
  CHECK(read_back<std::int32_t>(bytes_of("fe ff ff ff")) == -2);
  CHECK(read_back<std::int64_t>(bytes_of("fe ff ff ff ff ff ff ff")) == -2);
}

TEST_CASE("A float is its IEEE 754 bits", "[wire]") {
  // struct.pack('<f', 0.1)
  CHECK(written(0.1F) == bytes_of("cd cc cc 3d"));
  CHECK(read_back<float>(bytes_of("cd cc cc 3d")) == 0.1F);
  CHECK(read_back<float>(bytes_of("00 00 80 7f")) == std::numeric_limits<float>::infinity());
  CHECK(std::isnan(read_back<float>(bytes_of("00 00 c0 7f"))));
}

TEST_CASE("An array is its elements in order", "[wire]") {
  CHECK(written(std::array<std::uint16_t, 2>{0x0102, 0x0304}) == bytes_of("02 01 04 03"));
  CHECK(read_back<std::array<std::uint16_t, 2>>(bytes_of("02 01 04 03")) ==
        std::array<std::uint16_t, 2>{0x0102, 0x0304});
}

TEST_CASE("A writer that runs out of room writes nothing past it and says so", "[wire]") {
  std::array<std::uint8_t, 4> memory = {0xAA, 0xAA, 0xAA, 0xAA};
  ByteWriter writer{std::span(memory).first(3)};
  writer.put(std::uint32_t{0x01020304});
  CHECK_FALSE(writer.fits());
  CHECK(writer.size() == 4);
  CHECK(memory == std::array<std::uint8_t, 4>{0x04, 0x03, 0x02, 0xAA});
}

TEST_CASE("A writer fits exactly", "[wire]") {
  std::array<std::uint8_t, 2> memory{};
  ByteWriter writer(memory);
  writer.put(std::uint16_t{0x0102});
  CHECK(writer.fits());
}

TEST_CASE("A reader that runs out of bytes takes zeros and says so", "[wire]") {
  const Bytes bytes = bytes_of("01 02 03");
  ByteReader reader(bytes);
  CHECK(reader.take<std::uint32_t>() == 0x00030201);
  CHECK_FALSE(reader.used_up());
}

TEST_CASE("A reader says when it has used up its bytes, not before", "[wire]") {
  const Bytes bytes = bytes_of("01 02");
  ByteReader reader(bytes);
  CHECK(reader.take<std::uint8_t>() == 1);
  CHECK_FALSE(reader.used_up());
  CHECK(reader.take<std::uint8_t>() == 2);
  CHECK(reader.used_up());
}

}  // namespace
}  // namespace penduline::test
