// SPDX-License-Identifier: Apache-2.0
// All of a board's ports.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "common/wire/frame.hpp"
#include "firmware/port.hpp"

namespace penduline {

/// A port for each link of a tuple of references.
template <class Links>
class Ports;

template <class... Links>
class Ports<std::tuple<Links&...>> {
 public:
  explicit Ports(std::tuple<Links&...> links) : ports_(std::get<Links&>(links)...) {}

  template <class Visitor>
  void for_each(const Visitor& visit) {
    std::apply([&](auto&... port) { (visit(port), ...); }, ports_);
  }

  /// Encodes a message once and sends it by every port.
  template <wire::Message Message>
  void send(const Message& message) {
    std::array<std::uint8_t, wire::kFrameBytes<Message>> frame{};
    const std::size_t size = wire::encode_frame(message, frame);
    for_each([&](auto& port) { port.send_frame({frame.data(), size}); });
  }

 private:
  std::tuple<Port<Links>...> ports_;
};

}  // namespace penduline
