// SPDX-License-Identifier: Apache-2.0
// One connection of a browser: its requests one after the other, or a stream of events.
#pragma once

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_suffix.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"
#include "host/web/live_events.hpp"
#include "host/web/recording_download.hpp"
#include "host/web/web_server.hpp"

namespace penduline {

/// Lives as long as something is under way on it. Of the server's thread.
class WebConnection : public std::enable_shared_from_this<WebConnection> {
 public:
  WebConnection(boost::asio::ip::tcp::socket socket, WebServer& server);
  WebConnection(const WebConnection&) = delete;
  WebConnection& operator=(const WebConnection&) = delete;
  ~WebConnection();

  void wait_for_request();
  /// Sends a viewer what it has not yet got, unless it still takes what was sent before.
  void send_news();
  void close();

 private:
  using Error = penduline::Error;
  using ErrorCode = boost::system::error_code;
  using Request = boost::beast::http::request<boost::beast::http::string_body>;
  using Buffers = boost::beast::buffers_suffix<std::vector<boost::asio::const_buffer>>;
  using Action = std::function<tl::expected<void, Error>()>;

  void take_request(ErrorCode failed);
  void answer_get();
  void answer_post();
  void act(Action action);
  void answer(unsigned status, std::string_view content_type, std::string text);
  void refuse(unsigned status, std::string_view sentence);
  /// Lets the other side read an answer to what it has not yet sent in full.
  void linger();
  void begin_live();
  void send(std::vector<LiveEvents::Text> texts);
  void send_rest();
  void watch_for_end();
  void begin_download();
  void send_file();

  boost::beast::tcp_stream stream_;
  WebServer& server_;
  boost::asio::ip::address address_;  ///< the server's own, as the browser knows it
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
  Request request_;
  std::array<char, 4096> thrown_away_{};
  std::size_t lingered_bytes_ = 0;
  std::optional<std::list<WebConnection*>::iterator> waiting_;
  std::optional<std::list<WebConnection*>::iterator> viewing_;
  /// What a viewer has not yet taken: `left` is of `texts`.
  struct Sending {
    std::vector<LiveEvents::Text> texts;
    Buffers left;
  };
  std::optional<Sending> sending_;
  std::uint64_t position_ = 0;  ///< in the page's events
  std::optional<RecordingDownload> download_;
  std::vector<char> piece_;
};

}  // namespace penduline
