// SPDX-License-Identifier: Apache-2.0
// Listening, the server's thread, its turns.
#include "host/web/web_server.hpp"

#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <unistd.h>

#include <boost/asio/post.hpp>
#include <chrono>
#include <cstdint>
#include <utility>

#include "host/signals_blocked.hpp"
#include "host/web/web_connection.hpp"

namespace penduline {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using ErrorCode = boost::system::error_code;

/// Twenty times a second.
constexpr std::chrono::milliseconds kTurn{50};
/// Before accepting again where the system refused to.
constexpr std::chrono::milliseconds kRefusedWait{100};
/// How much less urgent than the session's the server's thread is, as of nice(1).
constexpr int kNiceness = 10;

/// An address of this machine that others know, of the family of `any`; where there is none, as
/// without a network, its loopback.
asio::ip::address known_address(const asio::ip::address& any) {
  asio::ip::address loopback = asio::ip::address_v4::loopback();
  if (any.is_v6()) {
    loopback = asio::ip::address_v6::loopback();
  }
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) {
    return loopback;
  }
  asio::ip::address found = loopback;
  for (const ifaddrs* each = all; each != nullptr && found == loopback; each = each->ifa_next) {
    if (each->ifa_addr == nullptr || (each->ifa_flags & IFF_UP) == 0) {
      continue;
    }
    asio::ip::address address;
    if (any.is_v4() && each->ifa_addr->sa_family == AF_INET) {
      const auto* v4 = reinterpret_cast<const sockaddr_in*>(each->ifa_addr);
      address = asio::ip::address_v4(ntohl(v4->sin_addr.s_addr));
    } else if (any.is_v6() && each->ifa_addr->sa_family == AF_INET6) {
      const auto* v6 = reinterpret_cast<const sockaddr_in6*>(each->ifa_addr);
      asio::ip::address_v6::bytes_type bytes{};
      std::copy(std::begin(v6->sin6_addr.s6_addr), std::end(v6->sin6_addr.s6_addr), bytes.begin());
      address = asio::ip::address_v6(bytes);
    }
    const bool local = address.is_v6() && address.to_v6().is_link_local();
    if (!address.is_unspecified() && !address.is_loopback() && !local) {
      found = address;
    }
  }
  ::freeifaddrs(all);
  return found;
}

}  // namespace

tl::expected<std::unique_ptr<WebListener>, Error> WebListener::open(const WebAddress& address) {
  const std::string name = fmt::format("--web {}:{}", address.host, address.port);
  std::unique_ptr<WebListener> listener(new WebListener);
  ErrorCode failed;
  tcp::resolver resolver(listener->context_);
  const auto found =
      resolver.resolve(address.host, std::to_string(address.port),
                       tcp::resolver::passive | tcp::resolver::numeric_service, failed);
  if (failed) {
    return failure(fmt::format("{}: {}", name, failed.message()));
  }
  const tcp::endpoint endpoint = *found.begin();
  tcp::acceptor& acceptor = listener->acceptor_;
  const auto step = [&](const auto& work) {
    if (!failed) {
      work();
    }
  };
  step([&] { acceptor.open(endpoint.protocol(), failed); });
  step([&] { acceptor.set_option(tcp::acceptor::reuse_address(true), failed); });
  step([&] { acceptor.bind(endpoint, failed); });
  step([&] { acceptor.listen(asio::socket_base::max_listen_connections, failed); });
  if (failed) {
    return failure(fmt::format("{}: {}", name, failed.message()));
  }
  return listener;
}

bool WebListener::beyond_loopback() const {
  return !acceptor_.local_endpoint().address().is_loopback();
}

std::string WebListener::url() const {
  const tcp::endpoint bound = acceptor_.local_endpoint();
  const asio::ip::address address =
      bound.address().is_unspecified() ? known_address(bound.address()) : bound.address();
  return address.is_v6() ? fmt::format("http://[{}]:{}/", address.to_string(), bound.port())
                         : fmt::format("http://{}:{}/", address.to_string(), bound.port());
}

WebServer::WebServer(std::unique_ptr<WebListener> listener, WebGuard guard, LivePage& page,
                     WebActions actions, WebLimits limits)
    : guard_(std::move(guard)),
      page_(page),
      actions_(std::move(actions)),
      limits_(limits),
      listener_(std::move(listener)),
      timer_(listener_->context_) {
  const SignalsBlocked in_threads;
  workers_ = std::make_unique<asio::thread_pool>(1);
  accept();
  turn();
  thread_ = std::thread([this] { run(); });
}

WebServer::~WebServer() {
  listener_->context_.stop();
  thread_.join();
  workers_->join();
}

void WebServer::run() {
  // Linux: of this thread alone.
  static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness));
  listener_->context_.run();
}

void WebServer::accept() {
  listener_->acceptor_.async_accept([this](ErrorCode failed, tcp::socket socket) {
    if (failed) {
      // No file is left, or the like: other connections will end.
      auto wait = std::make_shared<asio::steady_timer>(listener_->context_, kRefusedWait);
      wait->async_wait([this, wait](ErrorCode) { accept(); });
      return;
    }
    if (connections_ < limits_.connections || make_room()) {
      std::make_shared<WebConnection>(std::move(socket), *this)->wait_for_request();
    }
    accept();
  });
}

bool WebServer::make_room() {
  if (waiting_.empty()) {
    return false;
  }
  waiting_.front()->close();
  return true;
}

void WebServer::turn() {
  page_.turn(LivePage::Clock::now());
  for (WebConnection* viewer : viewers_) {
    viewer->send_news();
  }
  timer_.expires_after(kTurn);
  timer_.async_wait([this](ErrorCode failed) {
    if (!failed) {
      turn();
    }
  });
}

}  // namespace penduline
