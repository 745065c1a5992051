// SPDX-License-Identifier: Apache-2.0
// A message's list of fields, and what follows from it: its size, its writer, its reader.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>

#include "common/wire/bytes.hpp"

namespace penduline::wire {

/// One member of a message, as the wire, the tests and docs/protocol.md know it.
template <class Message, class Value>
struct Field {
  std::string_view name;
  Value Message::*member;
  std::string_view meaning;
};
template <class Message, class Value>
Field(std::string_view, Value Message::*, std::string_view) -> Field<Message, Value>;

/// A message has a type byte, a name, and a list of its fields in the order of the wire.
template <class Candidate>
concept Message = requires {
  { Candidate::kType } -> std::convertible_to<std::uint8_t>;
  { Candidate::kName } -> std::convertible_to<std::string_view>;
  std::tuple_size<decltype(Candidate::fields())>::value;
};

/// Calls `visit` with each `Field` of the message in the order of the wire.
template <Message Kind, class Visitor>
constexpr void for_each_field(const Visitor& visit) {
  constexpr auto kFields = Kind::fields();
  std::apply([&](const auto&... field) { (visit(field), ...); }, kFields);
}

/// Bytes of all fields together.
template <Message Kind>
inline constexpr std::size_t kPayloadBytes = [] {
  std::size_t bytes = 0;
  for_each_field<Kind>([&]<class Value>(const Field<Kind, Value>&) { bytes += sizeof(Value); });
  return bytes;
}();

/// Puts all fields of the message.
template <Message Kind>
constexpr void write_fields(const Kind& message, ByteWriter& writer) {
  for_each_field<Kind>([&](const auto& field) { writer.put(message.*field.member); });
}

/// The message in a payload. A longer one, from a newer peer, is read by the start that is known;
/// a shorter one is damaged: nothing.
template <Message Kind>
[[nodiscard]] constexpr std::optional<Kind> read_message(std::span<const std::uint8_t> payload) {
  if (payload.size() < kPayloadBytes<Kind>) {
    return std::nullopt;
  }
  Kind message;
  ByteReader reader(payload);
  for_each_field<Kind>([&]<class Value>(const Field<Kind, Value>& field) {
    message.*field.member = reader.take<Value>();
  });
  return message;
}

}  // namespace penduline::wire
