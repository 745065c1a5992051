// SPDX-License-Identifier: Apache-2.0
// Every message that there is, in the order of their type bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

#include "common/wire/commands.hpp"
#include "common/wire/device_messages.hpp"

namespace penduline::wire {

using AllMessages = std::tuple<Hello, SampleMessage, Status, AnglesMessage, Pong, Reply,  //
                               Ping, AskHello, AskStatus, SetRate, SetEmitter, Identify, Reboot,
                               BeginRig, RigPart, EndRig, EraseRig>;

/// Calls `visit` with a default message of every kind.
template <class Visitor>
constexpr void for_each_message(const Visitor& visit) {
  std::apply([&](const auto&... message) { (visit(message), ...); }, AllMessages{});
}

/// Bytes of the longest payload of this version.
inline constexpr std::size_t kLongestPayloadBytes = [] {
  std::size_t longest = 0;
  for_each_message([&]<Message Kind>(const Kind&) {
    longest = kPayloadBytes<Kind> > longest ? kPayloadBytes<Kind> : longest;
  });
  return longest;
}();

static_assert(
    [] {
      int last = 0;
      bool ascending = true;
      for_each_message([&]<Message Kind>(const Kind&) {
        ascending = ascending && last < Kind::kType;
        last = Kind::kType;
      });
      return ascending;
    }(),
    "no two messages have one type byte");

}  // namespace penduline::wire
