// SPDX-License-Identifier: Apache-2.0
// A connected socket, because only such a one learns that nobody listens.
#include "host/output/udp_output.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "host/output/estimate_writer.hpp"
#include "host/output/unix_time.hpp"

namespace penduline {
namespace {

constexpr int kNone = -1;

}  // namespace

tl::expected<std::unique_ptr<UdpOutput>, Error> UdpOutput::open(const UdpAddress& address) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(address.port);
  const int refused = ::getaddrinfo(address.host.c_str(), port.c_str(), &wanted, &found);
  if (refused != 0) {
    return failure(fmt::format("{}: {}", address.name, ::gai_strerror(refused)));
  }
  std::vector<SocketAddress> addresses;
  for (const addrinfo* each = found; each != nullptr; each = each->ai_next) {
    SocketAddress next{.bytes = {}, .size = each->ai_addrlen};
    std::memcpy(&next.bytes, each->ai_addr, each->ai_addrlen);
    addresses.push_back(next);
  }
  ::freeaddrinfo(found);
  return std::unique_ptr<UdpOutput>(new UdpOutput(address.name, std::move(addresses)));
}

UdpOutput::UdpOutput(std::string name, std::vector<SocketAddress> addresses)
    : name_(std::move(name)), addresses_(std::move(addresses)) {}

UdpOutput::~UdpOutput() {
  disconnect();
}

void UdpOutput::disconnect() {
  if (socket_ != kNone) {
    ::close(socket_);
    socket_ = kNone;
  }
}

/// Fails where there is no way to the address now; the network may come later. The next call takes
/// the host's next address.
bool UdpOutput::connect() {
  const SocketAddress& address = addresses_[next_];
  next_ = (next_ + 1) % addresses_.size();
  socket_ = ::socket(address.bytes.ss_family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const auto* bytes = static_cast<const void*>(&address.bytes);
  if (socket_ != kNone &&
      ::connect(socket_, static_cast<const sockaddr*>(bytes), address.size) != 0) {
    disconnect();
  }
  return socket_ != kNone;
}

/// Sends the message; false where it does not go now.
bool UdpOutput::send() {
  const auto sent = [this] {
    constexpr int kAtOnce = MSG_DONTWAIT | MSG_NOSIGNAL;
    return ::send(socket_, message_.data(), message_.size(), kAtOnce) >= 0;
  };
  if (socket_ == kNone && !connect()) {
    return false;
  }
  if (sent()) {
    return true;
  }
  if (errno == ECONNREFUSED) {
    // That was the datagram before. A host's other address may be the one that is listened to, as
    // with localhost, which is ::1 and 127.0.0.1.
    ++dropped_;
    disconnect();
    return connect() && sent();
  }
  if (errno != EAGAIN) {
    // The way may be another one when the network is back.
    disconnect();
  }
  return false;
}

tl::expected<void, Error> UdpOutput::take(const Estimate<double>& estimate) {
  message_.clear();
  append_estimate_message(message_, estimate, timestamp_s(estimate));
  if (!send()) {
    ++dropped_;
  }
  return {};
}

tl::expected<void, Error> UdpOutput::finish() {
  int refused = 0;
  socklen_t size = sizeof refused;
  if (socket_ != kNone && ::getsockopt(socket_, SOL_SOCKET, SO_ERROR, &refused, &size) == 0 &&
      refused == ECONNREFUSED) {
    ++dropped_;
  }
  return {};
}

}  // namespace penduline
