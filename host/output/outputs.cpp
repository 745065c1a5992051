// SPDX-License-Identifier: Apache-2.0
// What becomes of the others where one output fails.
#include "host/output/outputs.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace penduline {

void Outputs::add(std::unique_ptr<Output> output, Need need) {
  places_.push_back({.output = std::move(output), .need = need});
}

tl::expected<void, Error> Outputs::take(const Estimate<double>& estimate) {
  for (Place& place : places_) {
    // An output that has failed counts what it misses.
    auto taken = place.output->take(estimate);
    if (taken || place.failed) {
      continue;
    }
    place.failed = true;
    ++failed_;
    const bool last = failed_ == places_.size() && !may_all_fail_;
    if (place.need == Need::kEssential || last) {
      return taken;
    }
    warn_(fmt::format("{}; this output has ended", taken.error().message));
  }
  return {};
}

tl::expected<void, Error> Outputs::finish(
    const std::function<void(const std::string& name, std::uint64_t dropped)>& count) {
  constexpr auto kPatience = std::chrono::seconds(2);
  const auto deadline = Output::Clock::now() + kPatience;
  for (const Place& place : places_) {
    place.output->close(deadline);
  }
  tl::expected<void, Error> outcome;
  for (const Place& place : places_) {
    auto finished = place.output->finish();
    if (!finished && !place.failed && outcome) {
      outcome = std::move(finished);
    }
    if (place.output->dropped() > 0) {
      count(place.output->name(), place.output->dropped());
    }
  }
  return outcome;
}

}  // namespace penduline
