// SPDX-License-Identifier: Apache-2.0
// The options of the live page, and opening what they name.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "hal/error.hpp"
#include "host/cli/recording_options.hpp"
#include "host/recorder/recording_switch.hpp"
#include "host/web/live_json.hpp"
#include "host/web/web_address.hpp"

namespace penduline {

class WebListener;
class WebSession;

struct WebOptions {
  std::optional<WebAddress> address{};  ///< none: no page
  std::string recordings = ".";         ///< folder of recordings that viewers start
};

void add_web_options(CLI::App& command, WebOptions& options);

/// Listens where `options` say; no server where they ask for none. So early that nothing else has
/// begun where the address is taken.
[[nodiscard]] tl::expected<std::unique_ptr<WebListener>, Error> open_web(const WebOptions& options);

/// How a recording is called that is begun on the page: as `--record` says or, without it, by its
/// time.
[[nodiscard]] std::string web_recording_path(const WebOptions& options,
                                             const RecordingOptions& recording);

/// Serves the page, and says where it is. All outlive what is returned.
[[nodiscard]] std::unique_ptr<WebSession> start_web(const WebOptions& options,
                                                    std::unique_ptr<WebListener> listener,
                                                    LiveSubject subject,
                                                    const RecordingOptions& recording,
                                                    RecordingSwitch& recorded);

}  // namespace penduline
