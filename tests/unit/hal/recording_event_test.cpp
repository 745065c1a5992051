// SPDX-License-Identifier: Apache-2.0
// Tests of a recording's events as text: one line of TOML each, that comes back as it went in.
#include "hal/replay/recording_event.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <string>

#include "hal/replay/line_reader.hpp"
#include "hal/replay/utc_text.hpp"

namespace {

using namespace penduline;

/// 2026-11-21T07:00:03.25Z, from `date -u +%s`.
constexpr std::int64_t kSomeUtcUs = 1'795'244'403'250'000;

std::string message_of(std::string_view line) {
  return parse_event(line).error().message;
}

TEST_CASE("An event is one comment line of TOML", "[event]") {
  CHECK(event_line({.kind = "boot",
                    .utc_us = kSomeUtcUs,
                    .fields = {{"boot_id", std::int64_t{7}}, {"board", std::string("pico")}}}) ==
        "# event = { kind = \"boot\", utc = 2026-11-21T07:00:03.250000Z, boot_id = 7, board = "
        "\"pico\" }\n");
}

TEST_CASE("An event may have nothing but its kind", "[event]") {
  CHECK(event_line({.kind = "connected"}) == "# event = { kind = \"connected\" }\n");
}

TEST_CASE("Events come back as they went in", "[event]") {
  const RecordingEvent event{
      .kind = "trigger",
      .utc_us = kSomeUtcUs + 1,
      .fields = {{"a", std::numeric_limits<std::int64_t>::min()},
                 {"b", 100.0 / 3},
                 {"c", 5.0},
                 {"d", std::string("two\nlines, \"quotes\" and # sharp \x7f")},
                 {"with blank", std::numeric_limits<std::int64_t>::max()}}};
  const auto read = parse_event(event_line(event));
  REQUIRE(read);
  CHECK(read->kind == "trigger");
  CHECK(read->utc_us == kSomeUtcUs + 1);
  CHECK(read->get<std::int64_t>("a") == std::numeric_limits<std::int64_t>::min());
  CHECK(read->get<double>("b") == 100.0 / 3);
  CHECK(read->get<double>("c") == 5.0);
  CHECK(read->get<std::string>("d") == "two\nlines, \"quotes\" and # sharp \x7f");
  CHECK(read->get<std::int64_t>("with blank") == std::numeric_limits<std::int64_t>::max());
}

TEST_CASE("A field of another name or type is not there", "[event]") {
  const RecordingEvent event{.kind = "boot", .fields = {{"boot_id", std::int64_t{7}}}};
  CHECK_FALSE(event.get<std::int64_t>("serial"));
  CHECK_FALSE(event.get<std::string>("boot_id"));
}

TEST_CASE("Fields that no version knows yet are left out, the others are kept", "[event]") {
  const auto read = parse_event("# event = { kind = \"new\", list = [1, 2], on = true, x = 1 }");
  REQUIRE(read);
  REQUIRE(read->fields.size() == 1);
  CHECK(read->get<std::int64_t>("x") == 1);
}

TEST_CASE("A time may have an offset, or none for UTC", "[event]") {
  CHECK(parse_event("# event = { kind = \"a\", utc = 2026-11-21T08:30:03.25+01:30 }")->utc_us ==
        kSomeUtcUs);
  CHECK(parse_event("# event = { kind = \"a\", utc = 2026-11-21 07:00:03.25 }")->utc_us ==
        kSomeUtcUs);
}

TEST_CASE("What is no event is said", "[event]") {
  const std::string expected = ", expected an event such as '# event = { kind = \"boot\" }'";
  CHECK(message_of("# event = the cat came").starts_with("found '# event = the cat came' ("));
  CHECK(message_of("# event = 7") == "found '# event = 7' (no table)" + expected);
  CHECK(message_of("# event = { at = 1 }") ==
        "found '# event = { at = 1 }' (no word as its kind)" + expected);
  CHECK_FALSE(parse_event("# event = { kind = \"\" }"));
  CHECK_FALSE(parse_event("# event = { kind = \"two words\" }"));
  CHECK_FALSE(parse_event("# event = { kind = \"boot\""));
  CHECK_FALSE(parse_event(""));
}

TEST_CASE("However long its fields, an event is a line that the reader takes", "[event]") {
  static_assert(kMaxEventBytes <= kMaxLineBytes);
  RecordingEvent event{.kind = "disconnected", .utc_us = kSomeUtcUs};
  event.fields = {{"reason", std::string(3000, '\x01')}, {"port", std::string("usb")}};
  const std::string line = event_line(event);
  CHECK(line ==
        "# event = { kind = \"disconnected\", utc = 2026-11-21T07:00:03.250000Z, port = "
        "\"usb\" }\n");
  for (std::size_t bytes = 1900; bytes < 2100; ++bytes) {
    event.fields = {{"reason", std::string(bytes, 'x')}};
    const std::string long_line = event_line(event);
    REQUIRE(long_line.size() <= kMaxEventBytes);
    REQUIRE(parse_event(long_line));
  }
}

TEST_CASE("Times are written in UTC to the microsecond", "[event]") {
  CHECK(utc_text(0) == "1970-01-01T00:00:00.000000Z");
  CHECK(utc_text(951'782'400'000'001) == "2000-02-29T00:00:00.000001Z");
  CHECK(utc_text_s(1'795'244'403'999'999) == "2026-11-21T07:00:03Z");
  CHECK(utc_text(253'402'300'799'999'999) == "9999-12-31T23:59:59.999999Z");
}

TEST_CASE("A host whose clock is off by thousands of years writes times that can be read",
          "[event]") {
  for (const std::int64_t utc_us :
       {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    CHECK(parse_event(event_line({.kind = "boot", .utc_us = utc_us})));
  }
}

}  // namespace
