// SPDX-License-Identifier: Apache-2.0
// Putting the page's three files and the data into one.
#include "host/report/report_page.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "host/report/base64.hpp"
#include "host/web/page/page_files.hpp"

namespace penduline {
namespace {

const PageFile& page_file(std::string_view path) {
  return *std::ranges::find(page_files(), path, &PageFile::path);
}

/// What stands in a script element can end it by no '<' of the data.
std::string without_tags(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    text += c == '<' ? std::string_view("\\u003c") : std::string_view(&c, 1);
  }
  return text;
}

std::string recording_json(const ReportParts& parts) {
  const auto quoted = [](const auto& value) {
    return nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  };
  std::string notes;
  for (const std::string& note : parts.notes) {
    notes += (notes.empty() ? "" : ",") + note;
  }
  return "{\"session\":" + parts.session + ",\"state\":" + parts.state +
         ",\"recorded\":" + parts.recorded + ",\"notes\":[" + notes +
         "],\"analysis\":" + quoted(parts.analysis) + ",\"rig_toml\":" + quoted(parts.rig_toml) +
         ",\"bin_s\":" + quoted(parts.bin_s) + ",\"points\":" + parts.points + '}';
}

/// `html` with `element` replaced by `with`, which the page's template has once.
void replace(std::string& html, std::string_view element, const std::string& with) {
  html.replace(html.find(element), element.size(), with);
}

/// A source of a Content-Security-Policy: a file as it stands in an element.
std::string hash_source(const PageFile& file) {
  constexpr int kHexadecimal = 16;
  std::string bytes;
  for (std::size_t i = 0; i < file.sha256.size(); i += 2) {
    bytes +=
        static_cast<char>(std::stoi(std::string(file.sha256.substr(i, 2)), nullptr, kHexadecimal));
  }
  std::string source = "'sha256-";
  append_base64(source, bytes);
  return source + "'";
}

/// The page's script and style may run, its icon be drawn; nothing is loaded or sent.
std::string security_policy() {
  return R"(<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src )" +
         hash_source(page_file("/page.js")) + "; style-src " + hash_source(page_file("/page.css")) +
         R"(; img-src data:; base-uri 'none'; form-action 'none'">)";
}

}  // namespace

std::string report_page(const ReportParts& parts) {
  std::string html(page_file("/").text);
  constexpr std::string_view kCharset = R"(<meta charset="utf-8">)";
  replace(html, kCharset, std::string(kCharset) + '\n' + security_policy());
  replace(html, R"(<link rel="stylesheet" href="page.css">)",
          "<style>" + std::string(page_file("/page.css").text) + "</style>");
  replace(html, R"(<script src="page.js"></script>)",
          R"(<script type="application/json" id="recording">)" +
              without_tags(recording_json(parts)) + "</script>\n<script>" +
              std::string(page_file("/page.js").text) + "</script>");
  return html;
}

}  // namespace penduline
