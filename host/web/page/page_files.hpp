// SPDX-License-Identifier: Apache-2.0
// The live page, embedded into the program when it is built.
#pragma once

#include <span>
#include <string_view>

namespace penduline {

/// One file of the page as a browser asks for it. All three live as long as the program.
struct PageFile {
  std::string_view path;          ///< of the URL: "/", "/page.js" or "/page.css"
  std::string_view content_type;  ///< for the header of that name
  std::string_view text;          ///< UTF-8
  std::string_view sha256;        ///< of the text, 64 hexadecimal digits
};

/// "/" first, then what it loads. The page needs nothing else, and nothing from the internet.
[[nodiscard]] std::span<const PageFile> page_files();

}  // namespace penduline
