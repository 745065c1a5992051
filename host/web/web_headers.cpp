// SPDX-License-Identifier: Apache-2.0
// Headers of answers, and of requests that cannot be read.
#include "host/web/web_headers.hpp"

#include <fmt/format.h>

#include <boost/beast/http/error.hpp>
#include <iterator>

namespace penduline {
namespace {

namespace http = boost::beast::http;

}  // namespace

std::string stream_head(std::string_view own_lines) {
  std::string head = fmt::format("HTTP/1.1 200 OK\r\n{}Connection: close\r\n", own_lines);
  for (const HeaderLine& line : kHeaderLines) {
    head += fmt::format("{}: {}\r\n", line.name, line.value);
  }
  return head + "\r\n";
}

std::string_view only_value(const http::fields& fields, boost::beast::string_view name) {
  const auto [begin, end] = fields.equal_range(name);
  return begin != end && std::next(begin) == end ? text_view(begin->value()) : std::string_view();
}

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

}  // namespace penduline
