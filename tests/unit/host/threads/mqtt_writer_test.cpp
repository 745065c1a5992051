// SPDX-License-Identifier: Apache-2.0
// Tests of an MQTT output without a broker; tests/program/mqtt_test.py has a real one.
#include "host/output/mqtt_writer.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace penduline;
using namespace std::chrono_literals;

using Clock = Output::Clock;

/// What an output said.
class Messages {
 public:
  void add(const std::string& text) {
    const std::lock_guard lock(mutex_);
    texts_.push_back(text);
  }
  [[nodiscard]] std::vector<std::string> texts() const {
    const std::lock_guard lock(mutex_);
    return texts_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> texts_;
};

/// A port of this machine that takes connections and answers nothing; none once it has ended.
class SilentPort {
 public:
  SilentPort() {
    sockaddr_in any{};
    any.sin_family = AF_INET;
    any.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof any;
    auto* const address = reinterpret_cast<sockaddr*>(&any);
    REQUIRE(::bind(socket_, address, size) == 0);
    REQUIRE(::listen(socket_, 1) == 0);
    REQUIRE(::getsockname(socket_, address, &size) == 0);
    number_ = ntohs(any.sin_port);
  }
  SilentPort(const SilentPort&) = delete;
  SilentPort& operator=(const SilentPort&) = delete;
  ~SilentPort() { ::close(socket_); }

  [[nodiscard]] std::uint16_t number() const { return number_; }

 private:
  int socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
  std::uint16_t number_ = 0;
};

MqttAddress address_at(std::uint16_t port) {
  return {.name = "mqtt://here/rig",
          .host = "127.0.0.1",
          .port = port,
          .topic = "rig",
          .user = "",
          .password = "",
          .tls = false};
}

std::unique_ptr<QueuedOutput> output_at(std::uint16_t port, Messages& messages) {
  auto writer = MqttWriter::make(
      address_at(port), {.qos = 1, .description = "{}", .warn = [&](const std::string& text) {
                           messages.add(text);
                         }});
  return std::make_unique<QueuedOutput>(std::move(writer.value()));
}

TEST_CASE("A broker that is not there is said once and costs rows, not the run", "[threads]") {
  Messages messages;
  const std::uint16_t closed_port = SilentPort().number();
  const auto output = output_at(closed_port, messages);
  const auto deadline = Clock::now() + 30s;
  while (messages.texts().empty() && Clock::now() < deadline) {
    std::this_thread::sleep_for(1ms);
  }
  CHECK(output->take({}));
  const auto start = Clock::now();
  output->close(start + 60s);
  CHECK(output->finish());
  CHECK(Clock::now() - start < 30s);  // there is nothing to wait for
  CHECK(output->dropped() == 1);
  CHECK(messages.texts() ==
        std::vector<std::string>{"mqtt://here/rig: no broker; it is tried again, and the newest "
                                 "4096 estimates wait: Connection refused"});
}

TEST_CASE("A broker that says nothing is waited for until the deadline", "[threads]") {
  Messages messages;
  const SilentPort port;
  const auto output = output_at(port.number(), messages);
  CHECK(output->take({}));
  const auto start = Clock::now();
  output->close(start + 100ms);
  CHECK(output->finish());
  CHECK(Clock::now() - start >= 100ms);
  CHECK(Clock::now() - start < 30s);
  CHECK(output->dropped() == 1);
  CHECK(messages.texts().empty());
}

TEST_CASE("A topic that is no UTF-8 is refused", "[threads]") {
  MqttAddress address = address_at(1);
  address.topic = "rig\xff";
  const auto writer = MqttWriter::make(address, {.qos = 0, .description = "", .warn = {}});
  REQUIRE_FALSE(writer);
  CHECK(writer.error().message.starts_with("mqtt://here/rig: "));
}

}  // namespace
