// SPDX-License-Identifier: Apache-2.0
// What takes a connection for as long as it lasts: the stream of events, a download.
#include <fmt/format.h>

#include <boost/asio/write.hpp>
#include <boost/beast/core/buffer_traits.hpp>
#include <utility>

#include "host/web/web_connection.hpp"
#include "host/web/web_headers.hpp"

namespace penduline {
namespace {

namespace asio = boost::asio;

constexpr std::size_t kPieceBytes = 65536;

LiveEvents::Text shared(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

}  // namespace

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
  std::vector<asio::const_buffer> buffers;
  buffers.reserve(texts.size());
  for (const LiveEvents::Text& text : texts) {
    buffers.emplace_back(text->data(), text->size());
  }
  sending_.emplace(Sending{.texts = std::move(texts), .left = Buffers(buffers)});
  send_rest();
}

void WebConnection::send_rest() {
  // Anew for each piece: who is slow, and takes something, goes on.
  stream_.expires_after(server_.limits_.viewer_time);
  stream_.async_write_some(sending_->left,
                           [self = shared_from_this()](ErrorCode failed, std::size_t bytes) {
                             if (failed) {
                               return self->close();
                             }
                             self->sending_->left.consume(bytes);
                             if (boost::beast::buffer_bytes(self->sending_->left) > 0) {
                               return self->send_rest();
                             }
                             self->sending_.reset();
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
