// SPDX-License-Identifier: Apache-2.0
// Tests of the CRC against its published check value and zlib.
#include "common/wire/crc32.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "tests/unit/common/wire_examples.hpp"

namespace penduline::test {
namespace {

using namespace wire;

const Bytes kDigits = bytes_of("31 32 33 34 35 36 37 38 39");

TEST_CASE("The digits 1 to 9 have the check value of CRC-32/ISO-HDLC", "[wire][crc]") {
  // reveng.sourceforge.io/crc-catalogue: check=0xcbf43926
  CHECK(crc32(kDigits) == 0xCBF43926);
}

TEST_CASE("Values are zlib's", "[wire][crc]") {
  // zlib.crc32 of b"", b"a", bytes(32), bytes(range(256)) in Python
  CHECK(crc32(Bytes{}) == 0);
  CHECK(crc32(bytes_of("61")) == 0xE8B7BE43);
  CHECK(crc32(Bytes(32)) == 0x190A55AD);
  Bytes all(256);
  std::iota(all.begin(), all.end(), std::uint8_t{0});
  CHECK(crc32(all) == 0x29058C73);
}

TEST_CASE("A CRC goes on from that of what came before", "[wire][crc]") {
  for (std::size_t cut = 0; cut <= kDigits.size(); ++cut) {
    CAPTURE(cut);
    const std::span<const std::uint8_t> bytes(kDigits);
    CHECK(crc32(bytes.subspan(cut), crc32(bytes.first(cut))) == 0xCBF43926);
  }
}

}  // namespace
}  // namespace penduline::test
