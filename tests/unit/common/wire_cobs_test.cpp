// SPDX-License-Identifier: Apache-2.0
// Tests of COBS by the examples that are published for it, and of its refusals.
#include "common/wire/cobs.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <numeric>

#include "tests/unit/common/wire_examples.hpp"

namespace penduline::test {
namespace {

using namespace wire;

/// `count` bytes from `first` on, counting up.
Bytes counting(std::uint8_t first, std::size_t count) {
  Bytes bytes(count);
  std::iota(bytes.begin(), bytes.end(), first);
  return bytes;
}

Bytes encoded(const Bytes& in) {
  Bytes out(cobs_bound(in.size()));
  out.resize(cobs_encode(in, out));
  return out;
}

std::optional<Bytes> decoded(const Bytes& in) {
  Bytes out(in.size());
  const auto size = cobs_decode(in, out);
  if (!size) {
    return std::nullopt;
  }
  out.resize(*size);
  return out;
}

struct Example {
  Bytes plain;
  Bytes encoded;
};

/// The eleven of Wikipedia, "Consistent Overhead Byte Stuffing", section "Encoding examples",
/// without the zero that ends each.
std::vector<Example> published_examples() {
  return {
      {bytes_of("00"), bytes_of("01 01")},
      {bytes_of("00 00"), bytes_of("01 01 01")},
      {bytes_of("00 11 00"), bytes_of("01 02 11 01")},
      {bytes_of("11 22 00 33"), bytes_of("03 11 22 02 33")},
      {bytes_of("11 22 33 44"), bytes_of("05 11 22 33 44")},
      {bytes_of("11 00 00 00"), bytes_of("02 11 01 01 01")},
      {counting(0x01, 254), joined({{0xFF}, counting(0x01, 254)})},
      {counting(0x00, 255), joined({{0x01, 0xFF}, counting(0x01, 254)})},
      {counting(0x01, 255), joined({{0xFF}, counting(0x01, 254), {0x02, 0xFF}})},
      {joined({counting(0x02, 254), {0x00}}), joined({{0xFF}, counting(0x02, 254), {0x01, 0x01}})},
      {joined({counting(0x03, 253), {0x00, 0x01}}),
       joined({{0xFE}, counting(0x03, 253), {0x02, 0x01}})},
  };
}

TEST_CASE("COBS encodes the published examples", "[wire][cobs]") {
  for (const Example& example : published_examples()) {
    CAPTURE(example.plain);
    CHECK(encoded(example.plain) == example.encoded);
  }
}

TEST_CASE("COBS decodes the published examples", "[wire][cobs]") {
  for (const Example& example : published_examples()) {
    CAPTURE(example.plain);
    CHECK(decoded(example.encoded) == example.plain);
  }
}

TEST_CASE("Nothing at all is one byte", "[wire][cobs]") {
  CHECK(encoded({}) == bytes_of("01"));
  CHECK(decoded(bytes_of("01")) == Bytes{});
}

TEST_CASE("An empty block after a full one is taken, as other encoders write it", "[wire][cobs]") {
  CHECK(decoded(joined({{0xFF}, counting(0x01, 254), {0x01}})) == counting(0x01, 254));
}

TEST_CASE("The bound is met by bytes without a zero", "[wire][cobs]") {
  for (const std::size_t size : std::initializer_list<std::size_t>{0, 1, 253, 254, 255, 508, 509}) {
    CAPTURE(size);
    CHECK(encoded(Bytes(size, 0x55)).size() == cobs_bound(size));
  }
}

TEST_CASE("Decoding in place gives the same", "[wire][cobs]") {
  for (const Example& example : published_examples()) {
    CAPTURE(example.plain);
    Bytes bytes = example.encoded;
    const auto size = cobs_decode(bytes, bytes);
    REQUIRE(size == example.plain.size());
    bytes.resize(*size);
    CHECK(bytes == example.plain);
  }
}

TEST_CASE("What COBS cannot have written is refused", "[wire][cobs]") {
  CHECK_FALSE(decoded({}));
  CHECK_FALSE(decoded(bytes_of("00")));           // no code is zero
  CHECK_FALSE(decoded(bytes_of("02")));           // a byte less than the code says
  CHECK_FALSE(decoded(bytes_of("03 11")));        // likewise
  CHECK_FALSE(decoded(bytes_of("03 11 00")));     // a zero within a block
  CHECK_FALSE(decoded(bytes_of("02 11 00 11")));  // a zero for a code
}

TEST_CASE("Encoding into too little room writes nothing past it", "[wire][cobs]") {
  for (const Example& example : published_examples()) {
    for (std::size_t room = 0; room < example.encoded.size(); ++room) {
      Bytes out(example.encoded.size(), 0xAA);
      CHECK(cobs_encode(example.plain, std::span(out).first(room)) == 0);
      CHECK(std::span(out).subspan(room).front() == 0xAA);
    }
  }
}

TEST_CASE("Decoding into too little room writes nothing past it", "[wire][cobs]") {
  for (const Example& example : published_examples()) {
    for (std::size_t room = 0; room < example.plain.size(); ++room) {
      Bytes out(example.plain.size(), 0xAA);
      CHECK_FALSE(cobs_decode(example.encoded, std::span(out).first(room)));
      CHECK(std::span(out).subspan(room).front() == 0xAA);
    }
  }
}

}  // namespace
}  // namespace penduline::test
