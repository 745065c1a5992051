// SPDX-License-Identifier: Apache-2.0
// Routes, limits and deadlines of a connection.
#include "host/web/web_connection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/bind_executor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/error.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/web/live_json.hpp"
#include "host/web/page/page_files.hpp"

namespace penduline {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;

constexpr std::size_t kPieceBytes = 65536;
constexpr std::string_view kPlainText = "text/plain; charset=utf-8";
constexpr std::string_view kJsonType = "application/json";

struct HeaderLine {
  std::string_view name;
  std::string_view value;
};

/// With every answer. What the page loads comes from here, and nothing in data is ever run.
constexpr std::array kHeaderLines = {
    HeaderLine{"Content-Security-Policy",
               "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
               "img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    HeaderLine{"X-Content-Type-Options", "nosniff"},
    HeaderLine{"Referrer-Policy", "no-referrer"},
    HeaderLine{"Cache-Control", "no-store"},
    HeaderLine{"Cross-Origin-Resource-Policy", "same-origin"},
};

/// The start of an answer that ends with its connection.
std::string stream_head(std::string_view own_lines) {
  std::string head = fmt::format("HTTP/1.1 200 OK\r\n{}Connection: close\r\n", own_lines);
  for (const HeaderLine& line : kHeaderLines) {
    head += fmt::format("{}: {}\r\n", line.name, line.value);
  }
  return head + "\r\n";
}

LiveEvents::Text shared(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

std::string_view view(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

/// A header's value; "" where there is none, or two that contradict each other.
std::string_view only(const http::fields& fields, boost::beast::string_view name) {
  const auto [begin, end] = fields.equal_range(name);
  return begin != end && std::next(begin) == end ? view(begin->value()) : std::string_view();
}

/// What the request's reading failed of, as a status and a sentence; none where nobody listens any
/// more.
std::optional<WebRefusal> refusal_of(const boost::system::error_code& failed) {
  constexpr unsigned kBadRequest = 400;
  constexpr unsigned kTooLarge = 413;
  constexpr unsigned kHeaderTooLarge = 431;
  if (failed == http::error::header_limit || failed == http::error::buffer_overflow) {
    return WebRefusal{kHeaderTooLarge, "The headers are too long."};
  }
  if (failed == http::error::body_limit) {
    return WebRefusal{kTooLarge, "The body is too long."};
  }
  const bool malformed = failed.category() == make_error_code(http::error::bad_method).category();
  if (malformed && failed != http::error::end_of_stream && failed != http::error::partial_message) {
    return WebRefusal{kBadRequest, "This is no request of HTTP."};
  }
  return std::nullopt;
}

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
                   .host = only(request_, "Host"),
                   .content_type = only(request_, "Content-Type"),
                   .marker = only(request_, "X-Penduline"),
                   .token = only(request_, "X-Penduline-Token")};
  if (request_.count(http::field::origin) > 0) {
    asked.origin = only(request_, "Origin");
  }
  if (const auto refused = server_.guard_.refusal(asked, address_)) {
    return refuse(refused->status, refused->sentence);
  }
  return is_post ? answer_post() : answer_get();
}

void WebConnection::answer_get() {
  const std::string_view target = view(request_.target());
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
  const std::string_view target = view(request_.target());
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

void WebConnection::begin_live() {
  constexpr unsigned kUnavailable = 503;
  if (server_.viewers_.size() >= server_.limits_.viewers) {
    return refuse(kUnavailable,
                  fmt::format("{} viewers watch already, which is the most there may be.",
                              server_.limits_.viewers));
  }
  viewing_ = server_.viewers_.insert(server_.viewers_.end(), this);
  position_ = server_.page_.events().end();
  watch_for_end();
  send({shared(stream_head("Content-Type: text/event-stream\r\n") + "retry: 1000\n\n"),
        shared(server_.page_.greeting())});
}

void WebConnection::send_news() {
  const LiveEvents& events = server_.page_.events();
  if (sending_ || position_ == events.end()) {
    return;
  }
  std::vector<LiveEvents::Text> texts;
  if (events.has_all_from(position_)) {
    texts = events.from(position_);
  } else {
    texts.push_back(shared(server_.page_.resumption()));
  }
  position_ = events.end();
  send(std::move(texts));
}

void WebConnection::send(std::vector<LiveEvents::Text> texts) {
  sending_ = true;
  std::vector<asio::const_buffer> buffers;
  buffers.reserve(texts.size());
  for (const LiveEvents::Text& text : texts) {
    buffers.emplace_back(text->data(), text->size());
  }
  stream_.expires_after(server_.limits_.viewer_time);
  asio::async_write(
      stream_, buffers,
      [self = shared_from_this(), texts = std::move(texts)](ErrorCode failed, std::size_t) {
        self->sending_ = false;
        if (failed) {
          self->close();
        }
      });
}

void WebConnection::watch_for_end() {
  // A viewer has nothing more to say; that its connection is over is to be known at once.
  stream_.expires_never();
  stream_.async_read_some(asio::buffer(thrown_away_),
                          [self = shared_from_this()](ErrorCode, std::size_t) { self->close(); });
}

void WebConnection::begin_download() {
  constexpr unsigned kNotFound = 404;
  constexpr unsigned kUnavailable = 503;
  const auto path = server_.actions_.download();
  if (!path) {
    return refuse(kNotFound, "There is no recording yet.");
  }
  if (server_.downloads_ >= server_.limits_.downloads) {
    return refuse(kUnavailable, "Too many downloads are under way; try again later.");
  }
  auto file = RecordingDownload::open(*path);
  if (!file) {
    return refuse(kNotFound, file.error().message);
  }
  download_.emplace(std::move(*file));
  ++server_.downloads_;
  const std::string head =
      stream_head(fmt::format("Content-Type: text/csv; charset=utf-8\r\nContent-Length: {}\r\n"
                              "Content-Disposition: attachment; filename=\"{}\"\r\n",
                              download_->size_bytes(), download_name(*path)));
  piece_.assign(head.begin(), head.end());
  send_file();
}

void WebConnection::send_file() {
  stream_.expires_after(server_.limits_.request_time);
  asio::async_write(stream_, asio::buffer(piece_),
                    [self = shared_from_this()](ErrorCode failed, std::size_t) {
                      if (failed) {
                        return;
                      }
                      self->piece_.resize(kPieceBytes);
                      self->piece_.resize(self->download_->read(self->piece_));
                      if (self->piece_.empty()) {
                        return self->linger();
                      }
                      self->send_file();
                    });
}

}  // namespace penduline
