// SPDX-License-Identifier: Apache-2.0
// Routes, limits and deadlines of a connection.
#include "host/web/web_connection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/web/live_json.hpp"
#include "host/web/page/page_files.hpp"
#include "host/web/web_headers.hpp"

namespace penduline {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;

constexpr std::string_view kPlainText = "text/plain; charset=utf-8";
constexpr std::string_view kJsonType = "application/json";

}  // namespace

WebConnection::WebConnection(asio::ip::tcp::socket socket, WebServer& server)
    : stream_(std::move(socket)),
      server_(server),
      buffer_(server.limits_.header_bytes + server.limits_.body_bytes) {
  ErrorCode gone;
  address_ = stream_.socket().local_endpoint(gone).address();
  stream_.socket().set_option(asio::socket_base::send_buffer_size(server.limits_.send_buffer_bytes),
                              gone);
  stream_.socket().set_option(asio::ip::tcp::no_delay(true), gone);
  ++server_.connections_;
}

WebConnection::~WebConnection() {
  if (waiting_) {
    server_.waiting_.erase(*waiting_);
  }
  if (viewing_) {
    server_.viewers_.erase(*viewing_);
  }
  server_.downloads_ -= download_ ? 1U : 0U;
  --server_.connections_;
}

void WebConnection::close() {
  if (waiting_) {
    server_.waiting_.erase(*std::exchange(waiting_, std::nullopt));
  }
  stream_.close();
}

void WebConnection::wait_for_request() {
  waiting_ = server_.waiting_.insert(server_.waiting_.end(), this);
  parser_.emplace();
  parser_->header_limit(server_.limits_.header_bytes);
  parser_->body_limit(server_.limits_.body_bytes);
  // For the whole of it, however slowly its bytes come.
  stream_.expires_after(server_.limits_.request_time);
  http::async_read(
      stream_, buffer_, *parser_,
      [self = shared_from_this()](ErrorCode failed, std::size_t) { self->take_request(failed); });
}

void WebConnection::take_request(ErrorCode failed) {
  if (!waiting_) {
    return;  // it had to make room
  }
  server_.waiting_.erase(*std::exchange(waiting_, std::nullopt));
  if (failed) {
    if (const auto refused = refusal_of(failed)) {
      request_ = {};
      request_.keep_alive(false);
      refuse(refused->status, refused->sentence);
    }
    return;
  }
  request_ = parser_->release();
  const bool is_post = request_.method() == http::verb::post;
  if (!is_post && request_.method() != http::verb::get) {
    constexpr unsigned kMethodNotAllowed = 405;
    return refuse(kMethodNotAllowed, "Only GET and POST are understood.");
  }
  WebRequest asked{.is_action = is_post,
                   .host = only_value(request_, "Host"),
                   .content_type = only_value(request_, "Content-Type"),
                   .marker = only_value(request_, "X-Penduline"),
                   .token = only_value(request_, "X-Penduline-Token")};
  if (request_.count(http::field::origin) > 0) {
    asked.origin = only_value(request_, "Origin");
  }
  if (const auto refused = server_.guard_.refusal(asked, address_)) {
    return refuse(refused->status, refused->sentence);
  }
  return is_post ? answer_post() : answer_get();
}

void WebConnection::answer_get() {
  const std::string_view target = text_view(request_.target());
  const auto files = page_files();
  const auto file = std::ranges::find(files, target, &PageFile::path);
  constexpr unsigned kOk = 200;
  constexpr unsigned kNotFound = 404;
  if (file != files.end()) {
    answer(kOk, file->content_type, std::string(file->text));
  } else if (target == "/live") {
    begin_live();
  } else if (target == "/recording") {
    begin_download();
  } else {
    refuse(kNotFound, "There is nothing here; the page is at /.");
  }
}

void WebConnection::answer_post() {
  const std::string_view target = text_view(request_.target());
  constexpr unsigned kBadRequest = 400;
  constexpr unsigned kNotFound = 404;
  if (target == "/recording/start") {
    act(server_.actions_.start_recording);
  } else if (target == "/recording/stop") {
    act(server_.actions_.stop_recording);
  } else if (target == "/mark") {
    const auto body = nlohmann::json::parse(request_.body(), nullptr, false);
    const auto text = body.is_object() ? body.find("text") : body.end();
    if (text == body.end() || !text->is_string()) {
      return refuse(kBadRequest, "The body is not {\"text\": \"...\"}.");
    }
    act([mark = server_.actions_.mark, said = text->get<std::string>()] { return mark(said); });
  } else {
    refuse(kNotFound, "There is no such action.");
  }
}

void WebConnection::act(Action action) {
  // The worker hands the connection on, so that it never ends on the worker's thread.
  asio::post(*server_.workers_, [self = shared_from_this(), executor = stream_.get_executor(),
                                 action = std::move(action)]() mutable {
    auto done = action();
    asio::post(executor, [self = std::move(self), done = std::move(done)] {
      constexpr unsigned kOk = 200;
      constexpr unsigned kConflict = 409;
      if (done) {
        self->answer(kOk, kJsonType, "{}");
      } else {
        self->refuse(kConflict, done.error().message);
      }
    });
  });
}

void WebConnection::refuse(unsigned status, std::string_view sentence) {
  if (request_.method() == http::verb::post) {
    answer(status, kJsonType, error_json(sentence));
  } else {
    answer(status, kPlainText, fmt::format("{}\n", sentence));
  }
}

void WebConnection::answer(unsigned status, std::string_view content_type, std::string text) {
  auto response = std::make_shared<http::response<http::string_body>>();
  response->version(request_.version());
  response->result(status);
  response->set(http::field::content_type,
                boost::beast::string_view(content_type.data(), content_type.size()));
  for (const HeaderLine& line : kHeaderLines) {
    response->set(boost::beast::string_view(line.name.data(), line.name.size()),
                  boost::beast::string_view(line.value.data(), line.value.size()));
  }
  response->keep_alive(request_.keep_alive());
  response->body() = std::move(text);
  response->prepare_payload();
  stream_.expires_after(server_.limits_.request_time);
  http::async_write(stream_, *response,
                    [self = shared_from_this(), response](ErrorCode failed, std::size_t) {
                      if (failed) {
                        return;
                      }
                      if (response->need_eof()) {
                        return self->linger();
                      }
                      self->wait_for_request();
                    });
}

void WebConnection::linger() {
  constexpr std::size_t kMostBytes = std::size_t{1024} * 1024;
  constexpr std::chrono::seconds kLongest{1};
  ErrorCode gone;
  if (lingered_bytes_ == 0) {
    stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, gone);
    stream_.expires_after(kLongest);
  }
  stream_.async_read_some(asio::buffer(thrown_away_),
                          [self = shared_from_this()](ErrorCode failed, std::size_t bytes) {
                            self->lingered_bytes_ += bytes;
                            if (!failed && self->lingered_bytes_ < kMostBytes) {
                              self->linger();
                            }
                          });
}

}  // namespace penduline
