// SPDX-License-Identifier: Apache-2.0
// Sends each estimate as one datagram of JSON, as PlotJuggler reads them.
#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "host/output/output.hpp"
#include "host/output/output_address.hpp"

namespace penduline {

class UdpOutput final : public Output {
 public:
  /// Looks the host up, by IPv4 and IPv6; a multicast group may stand for it. Fails where the name
  /// is not known; that nobody listens is no failure.
  static tl::expected<std::unique_ptr<UdpOutput>, Error> open(const UdpAddress& address);

  UdpOutput(const UdpOutput&) = delete;
  UdpOutput& operator=(const UdpOutput&) = delete;
  ~UdpOutput() override;

  [[nodiscard]] std::string name() const override { return name_; }
  /// Never waits and never fails: a datagram that does not go or is refused is counted.
  tl::expected<void, Error> take(const Estimate<double>& estimate) override;
  tl::expected<void, Error> finish() override;
  [[nodiscard]] std::uint64_t dropped() const override { return dropped_; }

 private:
  struct SocketAddress {
    sockaddr_storage bytes;
    socklen_t size;
  };

  UdpOutput(std::string name, std::vector<SocketAddress> addresses);
  bool connect();
  void disconnect();
  bool send();

  std::string name_;
  std::vector<SocketAddress> addresses_;
  std::size_t next_ = 0;  ///< address to connect to
  int socket_ = -1;
  std::uint64_t dropped_ = 0;
  std::string message_;
};

}  // namespace penduline
