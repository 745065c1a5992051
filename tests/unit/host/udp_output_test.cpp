// SPDX-License-Identifier: Apache-2.0
// Tests of estimates by UDP: a datagram each, and what nobody hears is counted.
#include "host/output/udp_output.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "host/output/estimate_columns.hpp"

namespace {

using namespace penduline;

/// A port that listens on the loopback of one family; closed with the object.
class Listener {
 public:
  explicit Listener(int family, std::uint16_t port = 0) : socket_(::socket(family, SOCK_DGRAM, 0)) {
    sockaddr_storage any{};
    any.ss_family = static_cast<sa_family_t>(family);
    auto* const v4 = reinterpret_cast<sockaddr_in*>(&any);
    auto* const v6 = reinterpret_cast<sockaddr_in6*>(&any);
    socklen_t size = family == AF_INET ? sizeof *v4 : sizeof *v6;
    if (family == AF_INET) {
      v4->sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    } else {
      v6->sin6_addr = in6addr_loopback;
    }
    v4->sin_port = htons(port);  // at the same place in both
    timeval patience{.tv_sec = 5, .tv_usec = 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    bound_ = ::bind(socket_, reinterpret_cast<sockaddr*>(&any), size) == 0 &&
             ::getsockname(socket_, reinterpret_cast<sockaddr*>(&any), &size) == 0;
    port_ = ntohs(v4->sin_port);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener() { ::close(socket_); }

  [[nodiscard]] bool bound() const { return bound_; }
  [[nodiscard]] std::uint16_t port() const { return port_; }

  /// The next datagram; "" where none comes.
  [[nodiscard]] std::string receive() const {
    std::array<char, 2048> bytes{};
    const ssize_t got = ::recv(socket_, bytes.data(), bytes.size(), 0);
    return {bytes.data(), got < 0 ? 0 : static_cast<std::size_t>(got)};
  }

 private:
  int socket_;
  bool bound_ = false;
  std::uint16_t port_ = 0;
};

std::unique_ptr<UdpOutput> output_to(const std::string& host, std::uint16_t port) {
  auto output = UdpOutput::open({.name = "udp:test", .host = host, .port = port});
  REQUIRE(output);
  return std::move(*output);
}

TEST_CASE("Each estimate is one datagram of JSON with the columns' names", "[output]") {
  const Listener listener(AF_INET);
  const auto output = output_to("127.0.0.1", listener.port());
  REQUIRE(output->take({.t_us = 1'250'000, .seq = 25, .flags = flag::kFilling}));
  REQUIRE(output->take({.seq = 26}));
  const auto first = nlohmann::ordered_json::parse(listener.receive());
  CHECK(nlohmann::json::parse(listener.receive())["seq"] == 26);
  CHECK(first.size() == 1 + estimate_columns().size());
  for (const EstimateColumn& column : estimate_columns()) {
    CHECK(first.contains(std::string(column.name)));
  }
  CHECK(first["t_s"] == 1.25);
  CHECK(first["seq"] == 25);
  CHECK(first["theta1_rad"].is_null());
  CHECK(first["flags"] == 2048);
  REQUIRE(output->finish());
  CHECK(output->dropped() == 0);
}

TEST_CASE("Every datagram begins with the time of day as a number", "[output]") {
  const Listener listener(AF_INET);
  const auto output = output_to("127.0.0.1", listener.port());
  const auto now = [] {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch());
  };
  const double before = now().count();
  REQUIRE(output->take({}));
  const std::string datagram = listener.receive();
  CHECK(datagram.starts_with("{\"timestamp\":"));
  const double timestamp = nlohmann::json::parse(datagram)["timestamp"];
  CHECK(timestamp >= before - 1e-6);  // its last digit
  CHECK(timestamp <= now().count() + 1e-6);
}

TEST_CASE("Datagrams that nobody hears are counted, all of them", "[output]") {
  const std::uint16_t closed_port = Listener(AF_INET).port();
  const auto output = output_to("127.0.0.1", closed_port);
  for (int i = 0; i < 10; ++i) {
    CHECK(output->take({}));
  }
  CHECK(output->finish());
  CHECK(output->dropped() == 10);
}

TEST_CASE("A listener that comes later hears what is sent from then on", "[output]") {
  const std::uint16_t port = Listener(AF_INET).port();
  const auto output = output_to("127.0.0.1", port);
  REQUIRE(output->take({.seq = 1}));
  const Listener listener(AF_INET, port);
  REQUIRE(listener.bound());
  REQUIRE(output->take({.seq = 2}));
  CHECK(nlohmann::json::parse(listener.receive())["seq"] == 2);
  REQUIRE(output->take({.seq = 3}));
  CHECK(nlohmann::json::parse(listener.receive())["seq"] == 3);
  REQUIRE(output->finish());
  CHECK(output->dropped() == 1);
}

TEST_CASE("By IPv6, too", "[output]") {
  const Listener listener(AF_INET6);
  if (!listener.bound()) {
    WARN("this machine has no IPv6: not tried");
    return;
  }
  const auto output = output_to("::1", listener.port());
  REQUIRE(output->take({.seq = 5}));
  CHECK(nlohmann::json::parse(listener.receive())["seq"] == 5);
}

TEST_CASE("Of localhost's two addresses the one that is listened to is found", "[output]") {
  addrinfo* found = nullptr;
  if (::getaddrinfo("localhost", nullptr, nullptr, &found) != 0) {
    WARN("this system does not know localhost: not tested");
    return;
  }
  ::freeaddrinfo(found);
  const Listener listener(AF_INET);
  const auto output = output_to("localhost", listener.port());
  REQUIRE(output->take({.seq = 1}));
  REQUIRE(output->take({.seq = 2}));
  const auto seq = nlohmann::json::parse(listener.receive())["seq"];
  // The first datagram may have gone to ::1.
  CHECK(seq.get<int>() - 1 == static_cast<int>(output->dropped()));
}

TEST_CASE("An address without a way to it costs datagrams, not the run", "[output]") {
  const auto output = output_to("fe80::1", 9);  // link-local, of no link
  CHECK(output->take({}));
  CHECK(output->take({}));
  CHECK(output->finish());
  CHECK(output->dropped() == 2);
}

TEST_CASE("A group is joined by its listeners, not by the output", "[output]") {
  const Listener listener(AF_INET);
  const auto output = output_to("239.255.80.68", 9);
  CHECK(output->take({}));
  CHECK(output->finish());
}

TEST_CASE("A host that nobody knows is refused", "[output]") {
  const auto output = UdpOutput::open({.name = "udp:no host:1", .host = "no host", .port = 1});
  REQUIRE_FALSE(output);
  CHECK(output.error().message.starts_with("udp:no host:1: "));
}

}  // namespace
