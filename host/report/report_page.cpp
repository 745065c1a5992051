// SPDX-License-Identifier: Apache-2.0
// Putting the page's three files and the data into one.
#include "host/report/report_page.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "host/web/page/page_files.hpp"

namespace penduline {
namespace {

std::string_view page_text(std::string_view path) {
  return std::ranges::find(page_files(), path, &PageFile::path)->text;
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
  return "{\"session\":" + parts.session + ",\"state\":" + parts.state + ",\"notes\":[" + notes +
         "],\"analysis\":" + quoted(parts.analysis) + ",\"rig_toml\":" + quoted(parts.rig_toml) +
         ",\"bin_s\":" + quoted(parts.bin_s) + ",\"points\":" + parts.points + '}';
}

/// `html` with `element` replaced by `with`, which the page's template has once.
void replace(std::string& html, std::string_view element, const std::string& with) {
  html.replace(html.find(element), element.size(), with);
}

}  // namespace

std::string report_page(const ReportParts& parts) {
  std::string html(page_text("/"));
  replace(html, R"(<link rel="stylesheet" href="page.css">)",
          "<style>" + std::string(page_text("/page.css")) + "</style>");
  replace(html, R"(<script src="page.js"></script>)",
          R"(<script type="application/json" id="recording">)" +
              without_tags(recording_json(parts)) + "</script>\n<script>" +
              std::string(page_text("/page.js")) + "</script>");
  return html;
}

}  // namespace penduline
