// SPDX-License-Identifier: Apache-2.0
// docs/protocol.md is true: its tables are those that the lists of fields and choices make.
#include <array>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>

#include "tests/unit/common/wire_examples.hpp"

namespace penduline::test {
namespace {

using namespace wire;

/// The document's name for a type.
template <class Value>
std::string type_name() {
  if constexpr (kIsArray<Value>) {
    return type_name<typename Value::value_type>() + "[" + std::to_string(sizeof(Value)) + "]";
  } else if constexpr (std::is_enum_v<Value>) {
    return type_name<std::underlying_type_t<Value>>();
  } else if constexpr (std::is_same_v<Value, char>) {
    return "char";
  } else {
    const char* kind = std::is_floating_point_v<Value> ? "f" : std::is_signed_v<Value> ? "i" : "u";
    return kind + std::to_string(8 * sizeof(Value));
  }
}

template <Message Kind>
std::string heading() {
  std::ostringstream text;
  text << "### `" << Kind::kName << "` (0x" << std::hex << (Kind::kType < 16 ? "0" : "")
       << int{Kind::kType} << ")\n";
  return text.str();
}

template <Message Kind>
std::string field_table() {
  std::ostringstream text;
  text << "| offset | field | type | meaning |\n|---|---|---|---|\n";
  std::size_t offset = 0;
  for_each_field<Kind>([&]<class Value>(const Field<Kind, Value>& field) {
    text << "| " << offset << " | `" << field.name << "` | " << type_name<Value>() << " | "
         << field.meaning << " |\n";
    offset += sizeof(Value);
  });
  return text.str();
}

template <class Choices>
std::string choice_table(std::string_view name, const Choices& choices) {
  std::ostringstream text;
  text << "| `" << name << "` | name | meaning |\n|---|---|---|\n";
  for (const auto& choice : choices) {
    text << "| " << static_cast<int>(choice.value) << " | `" << choice.name << "` | "
         << choice.meaning << " |\n";
  }
  return text.str();
}

std::string document() {
  std::ifstream file(PENDULINE_SOURCE_DIR "/docs/protocol.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What stands under a heading, up to the next.
std::string section_of(const std::string& text, const std::string& under) {
  const std::size_t begin = text.find(under);
  if (begin == std::string::npos) {
    return {};
  }
  return text.substr(begin, text.find("\n##", begin + under.size()) - begin);
}

TEST_CASE("The document has every message's table, under its heading", "[wire][document]") {
  const std::string text = document();
  for_each_message([&]<Message Kind>(const Kind&) {
    CHECK_THAT(section_of(text, heading<Kind>()), Catch::Contains("\n" + field_table<Kind>()));
  });
}

TEST_CASE("The document has no message that the code does not have", "[wire][document]") {
  const std::string text = document();
  std::size_t headings = 0;
  for (std::size_t at = 0; (at = text.find("\n### `", at)) != std::string::npos; ++at) {
    ++headings;
  }
  CHECK(headings == std::tuple_size_v<AllMessages>);
}

TEST_CASE("The document has every enumeration's table", "[wire][document]") {
  const std::string text = document();
  CHECK_THAT(text, Catch::Contains("\n" + choice_table("EmitterMode", kEmitterModes)));
  CHECK_THAT(text, Catch::Contains("\n" + choice_table("RebootTarget", kRebootTargets)));
  CHECK_THAT(text, Catch::Contains("\n" + choice_table("ResetCause", kResetCauses)));
  CHECK_THAT(text, Catch::Contains("\n" + choice_table("StoreState", kStoreStates)));
  CHECK_THAT(text, Catch::Contains("\n" + choice_table("OnboardEstimator", kOnboardEstimators)));
  CHECK_THAT(text, Catch::Contains("\n" + choice_table("Result", kResults)));
}

TEST_CASE("The document's worked example is a frame", "[wire][document]") {
  constexpr std::string_view kExample = "03 41 07 01 01 05 5d be 66 3e 00";
  CHECK_THAT(document(), Catch::Contains("\n    " + std::string(kExample) + "     as a frame"));
  CHECK(frame_of(Ping{.token = 7}) == bytes_of(kExample));
}

TEST_CASE("The document's sizes are those of the code", "[wire][document]") {
  const std::string text = document();
  CHECK_THAT(text, Catch::Contains("up to " + std::to_string(kMaxPayloadBytes) + " bytes"));
  CHECK_THAT(text, Catch::Contains("whole frame is at most " + std::to_string(kMaxFrameBytes)));
  CHECK_THAT(text, Catch::Contains("A `SampleMessage` takes " +
                                   std::to_string(kFrameBytes<SampleMessage>) + " bytes"));
}

}  // namespace
}  // namespace penduline::test
