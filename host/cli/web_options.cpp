// SPDX-License-Identifier: Apache-2.0
// From --web to the server.
#include "host/cli/web_options.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "host/cli/log.hpp"
#include "host/web/web_server.hpp"
#include "host/web/web_session.hpp"

namespace penduline {
namespace {

/// Whether a recording is a file, which can be ended and begun again and had by a viewer.
bool is_file(const std::string& path) {
  std::error_code failed;
  return path != "-" &&
         (!std::filesystem::exists(path, failed) || std::filesystem::is_regular_file(path, failed));
}

}  // namespace

void add_web_options(CLI::App& command, WebOptions& options) {
  CLI::Option* web =
      command
          .add_option_function<std::string>(
              "--web",
              [&options](const std::string& text) {
                auto address = parse_web_address(text);
                if (!address) {
                  throw CLI::ValidationError("--web", address.error().message);
                }
                options.address = std::move(*address);
              },
              "Show the run live in a browser, on this port of 127.0.0.1 (0: one that is free) or\n"
              "of the address ADDR, where others can watch; what changes the run then needs the\n"
              "token in the address that is printed")
          ->type_name("[ADDR:]PORT");
  command
      .add_option("--web-recordings", options.recordings,
                  "Folder of recordings that are begun in the browser, without --record")
      ->check(CLI::ExistingDirectory.description(""))
      ->needs(web)
      ->type_name("DIR")
      ->default_str(".");
}

tl::expected<std::unique_ptr<WebListener>, Error> open_web(const WebOptions& options) {
  if (!options.address) {
    return nullptr;
  }
  return WebListener::open(*options.address);
}

std::string web_recording_path(const WebOptions& options, const RecordingOptions& recording) {
  if (!recording.path.empty()) {
    return recording.path;
  }
  std::string folder = options.recordings == "." ? "" : options.recordings + "/";
  // Its own percent signs are none of the time's.
  for (std::size_t i = folder.find('%'); i != std::string::npos; i = folder.find('%', i + 2)) {
    folder.insert(i, 1, '%');
  }
  return folder + "penduline-%Y%m%dT%H%M%SZ.csv";
}

std::unique_ptr<WebSession> start_web(const WebOptions& options,
                                      std::unique_ptr<WebListener> listener, LiveSubject subject,
                                      const RecordingOptions& recording,
                                      RecordingSwitch& recorded) {
  const std::string token = listener->beyond_loopback() ? new_token() : "";
  subject.token_needed = !token.empty();
  log_info(fmt::format("live page: {}{}", listener->url(), token.empty() ? "" : "#token=" + token));
  return std::make_unique<WebSession>(
      std::move(listener),
      WebSettings{.subject = std::move(subject),
                  .name = options.address->host,
                  .token = token,
                  .may_record = is_file(web_recording_path(options, recording)),
                  .recording = recorded,
                  .say = log_info});
}

}  // namespace penduline
