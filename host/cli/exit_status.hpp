// SPDX-License-Identifier: Apache-2.0
// The program's exit statuses.
#pragma once

namespace penduline {

enum class ExitStatus {
  kDone = 0,
  kFailed = 1,    ///< with one line on stderr
  kUsage = 2,     ///< wrong options
  kDoubtful = 3,  ///< finished, but the data had flagged problems and --strict asked
};

}  // namespace penduline
