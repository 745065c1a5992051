// SPDX-License-Identifier: Apache-2.0
// What every answer of the web server begins with, and what of a request's headers counts.
#pragma once

#include <array>
#include <boost/beast/core/string_type.hpp>
#include <boost/beast/http/fields.hpp>
#include <boost/system/error_code.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "host/web/web_guard.hpp"

namespace penduline {

struct HeaderLine {
  std::string_view name;
  std::string_view value;
};

/// With every answer. What the page loads comes from here, and nothing in data is ever run.
inline constexpr std::array kHeaderLines = {
    HeaderLine{"Content-Security-Policy",
               "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
               "img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    HeaderLine{"X-Content-Type-Options", "nosniff"},
    HeaderLine{"Referrer-Policy", "no-referrer"},
    HeaderLine{"Cache-Control", "no-store"},
    HeaderLine{"Cross-Origin-Resource-Policy", "same-origin"},
};

/// The start of an answer that ends with its connection; `own_lines` end in CR LF each.
[[nodiscard]] std::string stream_head(std::string_view own_lines);

[[nodiscard]] inline std::string_view text_view(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

/// A header's value; "" where there is none, or two that contradict each other.
[[nodiscard]] std::string_view only_value(const boost::beast::http::fields& fields,
                                          boost::beast::string_view name);

/// What the request's reading failed of, as a status and a sentence; none where nobody listens any
/// more.
[[nodiscard]] std::optional<WebRefusal> refusal_of(const boost::system::error_code& failed);

}  // namespace penduline
