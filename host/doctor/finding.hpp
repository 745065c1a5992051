// SPDX-License-Identifier: Apache-2.0
// What one check of a set-up has come to.
#pragma once

#include <string>
#include <vector>

namespace penduline {

enum class Health {
  kGood,
  kDoubtful,  ///< it measures, but not as well as it could
  kBad,       ///< it does not measure
};

/// One check, in words for somebody who has never done this before.
struct Finding {
  Health health = Health::kGood;
  std::string subject;   ///< "board", "sensor x light": what was looked at
  std::string found;     ///< what is so, with its numbers
  std::string advice{};  ///< what to do about it; empty where nothing is to be done
};

using Findings = std::vector<Finding>;

}  // namespace penduline
