// SPDX-License-Identifier: Apache-2.0
// Tests of every message: its frame to the byte, and what old and new versions make of each other.
#include "common/wire/messages.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/wire/frame.hpp"
#include "tests/unit/common/wire_examples.hpp"

namespace penduline::test {
namespace {

using namespace wire;

/// The frames of `example_messages` as Python makes them: struct.pack("<" + the format beside each)
/// for the payload, zlib.crc32, and COBS by splitting at zeros.
constexpr std::array<std::string_view, std::tuple_size_v<AllMessages>> kExampleFrames = {
    // B16s16s8sIIIHIBBHH
    "07 01 01 70 69 63 6f 01 01 01 01 01 01 01 01 01 01 01 06 30 2e 31 2e 30 01 01 01 01 "
    "01 01 01 01 01 01 10 e6 60 58 38 83 20 b1 2d ef be ad de 40 42 0f 03 20 4e 01 06 ff "
    "ff a0 5a 32 02 02 04 d0 07 40 05 f1 7a 4a ae 00",
    // QQHHHHB
    "0c 02 08 07 06 05 04 03 02 01 50 c3 01 01 01 01 01 04 73 5b 66 04 5c 59 63 06 05 78 "
    "f4 05 6e 00",
    // QQIIIHHhHBHIH16sBIB
    "07 03 14 1a 99 be 1c 01 01 03 a5 09 01 01 01 01 01 02 01 01 01 02 02 01 01 02 03 01 "
    "01 02 11 02 fa 03 e3 09 04 04 04 07 03 bc 0a 02 10 01 0c 73 61 6d 70 6c 65 72 2e 63 "
    "70 70 01 01 01 01 04 01 20 4e 01 06 02 1d ec ef 32 00",
    // QqfffIffff
    "04 04 a5 09 01 01 01 01 01 09 b0 3c ff ff ff ff ff ff 01 03 80 3e 01 01 06 bf ac c5 "
    "27 37 02 10 01 01 01 03 c0 3f 01 01 0e c0 6f 12 83 3a 6f 12 03 3b 5d 51 2f 7b 00",
    // IQ
    "06 05 ef cd ab 89 05 f2 05 2a 01 01 01 05 ce a5 c8 49 00",
    // BBB
    "09 06 44 09 03 2f 4f 77 3b 00",
    // I
    "0a 41 ef cd ab 89 3f 8c 4d 6d 00",
    // B
    "07 42 01 ee 0f 91 f4 00",
    // B
    "07 43 02 15 6f 83 74 00",
    // BI
    "06 44 03 a0 86 01 05 7f dc 63 d3 00",
    // BB
    "08 45 04 01 ab 63 7b 9a 00",
    // BB
    "08 46 05 0a 3b 35 f4 16 00",
    // BB
    "08 47 06 01 47 d5 c9 ab 00",
    // BHI
    "0d 48 07 54 02 26 39 f4 cb 42 30 a7 65 00",
    // BHB48s
    "04 49 08 30 03 03 01 02 ff 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 "
    "01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 01 05 93 2e "
    "54 07 00",
    // B
    "07 4a 09 d4 0d 93 32 00",
    // B
    "07 4b 0a 2f 6d 81 b2 00",
};

/// Calls `visit` with each example and the frame that Python makes of it.
template <class Visitor>
void for_each_example(const Visitor& visit) {
  std::size_t index = 0;
  std::apply(
      [&](const auto&... message) { (visit(message, bytes_of(kExampleFrames[index++])), ...); },
      example_messages());
}

template <Message Kind>
void check_same(const Kind& found, const Kind& expected) {
  for_each_field<Kind>([&](const auto& field) {
    INFO(std::string(Kind::kName) << "::" << field.name);
    CHECK(found.*field.member == expected.*field.member);
  });
}

TEST_CASE("Every message's frame is the one that Python makes", "[wire][messages]") {
  for_each_example([]<Message Kind>(const Kind& message, const Bytes& frame) {
    INFO(std::string(Kind::kName));
    CHECK(frame_of(message) == frame);
  });
}

TEST_CASE("Every field comes back from its frame", "[wire][messages]") {
  for_each_example([]<Message Kind>(const Kind& message, const Bytes& frame) {
    INFO(std::string(Kind::kName));
    const auto frames = frames_in(frame);
    REQUIRE(frames.size() == 1);
    CHECK(frames[0].type == Kind::kType);
    const auto read = read_message<Kind>(frames[0].payload);
    REQUIRE(read);
    check_same(*read, message);
  });
}

TEST_CASE("A frame's size is known beforehand and fits any buffer for frames", "[wire][messages]") {
  for_each_example([]<Message Kind>(const Kind&, const Bytes& frame) {
    INFO(std::string(Kind::kName));
    CHECK(frame.size() == kFrameBytes<Kind>);
    CHECK(frame.size() <= kMaxFrameBytes);
  });
}

TEST_CASE("A frame that does not fit is not begun", "[wire][messages]") {
  for_each_example([]<Message Kind>(const Kind& message, const Bytes& frame) {
    INFO(std::string(Kind::kName));
    Bytes out(frame.size() - 1, 0xAA);
    CHECK(encode_frame(message, out) == 0);
    CHECK(out == Bytes(frame.size() - 1, 0xAA));
  });
}

TEST_CASE("A longer payload is read by the start that is known", "[wire][messages]") {
  for_each_example([]<Message Kind>(const Kind& message, const Bytes& frame) {
    INFO(std::string(Kind::kName));
    Bytes payload = frames_in(frame).at(0).payload;
    payload.resize(kMaxPayloadBytes, 0x5A);
    const auto frames = frames_in(frame_of(Kind::kType, payload));
    REQUIRE(frames.size() == 1);
    const auto read = read_message<Kind>(frames[0].payload);
    REQUIRE(read);
    check_same(*read, message);
  });
}

TEST_CASE("A payload that lacks its last byte is not read", "[wire][messages]") {
  for_each_example([]<Message Kind>(const Kind&, const Bytes& frame) {
    INFO(std::string(Kind::kName));
    Bytes payload = frames_in(frame).at(0).payload;
    payload.pop_back();
    CHECK_FALSE(read_message<Kind>(payload));
  });
}

TEST_CASE("A value of an enumeration that is not known yet is kept", "[wire][messages]") {
  const auto frames = frames_in(frame_of(Reply::kType, bytes_of("44 09 c8")));
  const auto reply = read_message<Reply>(frames.at(0).payload);
  REQUIRE(reply);
  CHECK(static_cast<int>(reply->result) == 0xC8);
}

TEST_CASE("An angle without an answer is NaN on the other side too", "[wire][messages]") {
  const auto frames = frames_in(frame_of(AnglesMessage{.theta1_rad = std::nanf("")}));
  CHECK(std::isnan(read_message<AnglesMessage>(frames.at(0).payload).value().theta1_rad));
}

TEST_CASE("What the board says is below 0x40, what the host says is from 0x41 on",
          "[wire][messages]") {
  std::size_t index = 0;
  for_each_message([&]<Message Kind>(const Kind&) {
    INFO(std::string(Kind::kName));
    CHECK((index++ < 6 ? Kind::kType < 0x40 : Kind::kType > 0x40));
  });
}

}  // namespace
}  // namespace penduline::test
