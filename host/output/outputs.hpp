// SPDX-License-Identifier: Apache-2.0
// Several outputs as one.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "host/output/output.hpp"

namespace penduline {

/// Whether the run can go on without an output that has failed.
enum class Need { kEssential, kOptional };

/// Hands each estimate to every output.
class Outputs final : public EstimateSink {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// `warn` is told when an output fails and the run goes on.
  explicit Outputs(Warn warn) : warn_(std::move(warn)) {}

  void add(std::unique_ptr<Output> output, Need need);
  /// Says that the run is of use with no output left: it is recorded, too.
  void may_all_fail() { may_all_fail_ = true; }

  /// Fails where an essential output does, or the last one.
  tl::expected<void, Error> take(const Estimate<double>& estimate) override;

  /// Ends all outputs, which have two seconds for what still waits, and tells `count` of each that
  /// has dropped estimates. Fails where one fails now.
  tl::expected<void, Error> finish(
      const std::function<void(const std::string& name, std::uint64_t dropped)>& count);

  /// Whether an output has failed in the middle of the run.
  [[nodiscard]] bool any_failed() const { return failed_ > 0; }

 private:
  struct Place {
    std::unique_ptr<Output> output;
    Need need;
    bool failed = false;
  };

  Warn warn_;
  std::vector<Place> places_;
  std::size_t failed_ = 0;
  bool may_all_fail_ = false;
};

}  // namespace penduline
