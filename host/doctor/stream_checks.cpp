// SPDX-License-Identifier: Apache-2.0
// What is good, doubtful and bad of a stream.
#include "host/doctor/stream_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace penduline {
namespace {

Finding check_rate(const Survey& survey, const TypedNames& names) {
  if (!survey.rate_complaint.empty()) {
    return {.health = Health::kDoubtful,
            .subject = "rate",
            .found = survey.rate_complaint,
            .advice = "a long cable, a hub or a busy computer may hold it up; try another port"};
  }
  if (survey.lost + survey.late > 0) {
    return {.health = Health::kDoubtful,
            .subject = "rate",
            .found = fmt::format("of {} samples {} lost, {} late", survey.samples + survey.lost,
                                 survey.lost, survey.late),
            .advice = fmt::format("try another port or cable, or sample more slowly: {}",
                                  names.run_slower(survey.acquisition.rate_hz))};
  }
  return {.subject = "rate",
          .found = fmt::format("{} samples at {} Hz, none lost, none late", survey.samples,
                               survey.acquisition.rate_hz)};
}

}  // namespace

Findings check_stream(const Survey& survey, const TypedNames& names) {
  if (survey.samples == 0) {
    return {{.health = Health::kBad,
             .subject = "rate",
             .found = "no sample came",
             .advice = "unplug the board and plug it in again; if that does not help, flash it"}};
  }
  Findings findings = {check_rate(survey, names)};
  for (const std::string& complaint : survey.complaints) {
    findings.push_back({.health = Health::kDoubtful,
                        .subject = "stream",
                        .found = complaint,
                        .advice = "try another cable or port"});
  }
  return findings;
}

}  // namespace penduline
