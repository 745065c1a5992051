// SPDX-License-Identifier: Apache-2.0
// Bytes as text (RFC 4648, section 4).
#pragma once

#include <string>
#include <string_view>

namespace penduline {

/// Appends the base64 of `bytes`, filled up by '='.
void append_base64(std::string& text, std::string_view bytes);

}  // namespace penduline
