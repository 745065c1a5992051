// SPDX-License-Identifier: Apache-2.0
// The web server: one thread for all connections, none of which holds up another for longer than
// the disk takes for 64 KiB of a download, or the session at all.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <cstddef>
#include <list>
#include <memory>
#include <string>
#include <thread>
#include <tl/expected.hpp>

#include "hal/error.hpp"
#include "host/web/live_page.hpp"
#include "host/web/web_address.hpp"
#include "host/web/web_guard.hpp"
#include "host/web/web_site.hpp"

namespace penduline {

class WebConnection;

/// A socket that listens, so that its address is known; nobody is answered yet.
class WebListener {
 public:
  /// Fails, naming the address, where it cannot be had.
  static tl::expected<std::unique_ptr<WebListener>, Error> open(const WebAddress& address);

  /// Whether others than this machine can reach it.
  [[nodiscard]] bool beyond_loopback() const;
  /// Where a browser finds it, such as "http://127.0.0.1:8080/".
  [[nodiscard]] std::string url() const;

 private:
  friend class WebServer;
  WebListener() : acceptor_(context_) {}

  boost::asio::io_context context_{1};
  boost::asio::ip::tcp::acceptor acceptor_;
};

class WebServer {
 public:
  /// Begins to answer. `page` is this server's thread's from now on.
  WebServer(std::unique_ptr<WebListener> listener, WebGuard guard, LivePage& page,
            WebActions actions, WebLimits limits = {});
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;
  /// Closes all connections.
  ~WebServer();

 private:
  friend class WebConnection;
  using Connections = std::list<WebConnection*>;

  void run();
  void accept();
  void turn();
  /// Closes the connection that has waited longest for a request; false where none waits.
  bool make_room();

  WebGuard guard_;
  LivePage& page_;
  WebActions actions_;
  WebLimits limits_;
  std::size_t connections_ = 0;
  std::size_t downloads_ = 0;
  Connections waiting_;  ///< for a request, in order
  Connections viewers_;
  // Below, so that connections, which go with it, still find what is above.
  std::unique_ptr<WebListener> listener_;
  boost::asio::steady_timer timer_;
  std::unique_ptr<boost::asio::thread_pool> workers_;  ///< a thread for what may wait
  std::thread thread_;
};

}  // namespace penduline
