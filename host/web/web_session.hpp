// SPDX-License-Identifier: Apache-2.0
// A session that can be watched: its hooks on the one side, the web server on the other.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "hal/error.hpp"
#include "host/output/output.hpp"
#include "host/recorder/recording_switch.hpp"
#include "host/session/session.hpp"
#include "host/web/live_feed.hpp"
#include "host/web/live_json.hpp"
#include "host/web/live_page.hpp"
#include "host/web/marks.hpp"
#include "host/web/web_server.hpp"

namespace penduline {

struct WebSettings {
  LiveSubject subject;
  std::string name;            ///< of the address to listen on, as typed
  std::string token;           ///< what actions need; "": nothing
  bool may_record = false;     ///< whether the page may start and stop the recording
  RecordingSwitch& recording;  ///< outlives the session
  std::function<void(const std::string&)> say;
};

/// From its construction on the page is served, until it goes; before there is a session it says
/// so.
class WebSession {
 public:
  WebSession(std::unique_ptr<WebListener> listener, const WebSettings& settings);
  WebSession(const WebSession&) = delete;
  WebSession& operator=(const WebSession&) = delete;
  ~WebSession();

  /// Shows the session of which these are the parts, beside what they do already.
  void join(SessionParts& parts);
  /// Where the session's estimates go, too: an output that takes each at once and never fails.
  [[nodiscard]] std::unique_ptr<Output> output();

 private:
  [[nodiscard]] RecordingState recording_state() const;
  [[nodiscard]] WebActions actions();
  tl::expected<void, Error> mark(const std::string& text);
  tl::expected<void, Error> start_recording();
  tl::expected<void, Error> stop_recording();
  void tell(std::string_view kind, std::string text);

  RecordingSwitch& recording_;
  bool may_record_;
  std::atomic<bool> joined_ = false;  ///< there is a session
  bool connected_ = false;            ///< to a board, whose clock runs
  std::function<void(const std::string&)> say_;
  LiveFeed feed_;
  Marks marks_;
  LivePage page_;
  std::optional<WebServer> server_;
};

}  // namespace penduline
