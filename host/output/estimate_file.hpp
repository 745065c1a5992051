// SPDX-License-Identifier: Apache-2.0
// Writes estimates to a file without losing any: whoever hands them on waits for the file.
#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>

#include "host/output/estimate_writer.hpp"
#include "host/output/output.hpp"
#include "host/output/text_file.hpp"

namespace penduline {

class EstimateFile final : public Output {
 public:
  EstimateFile(TextFile file, EstimateLayout layout);

  [[nodiscard]] std::string name() const override { return file_.name(); }
  tl::expected<void, Error> take(const Estimate<double>& estimate) override;
  tl::expected<void, Error> finish() override { return file_.flush(); }
  [[nodiscard]] std::uint64_t dropped() const override { return 0; }

 private:
  TextFile file_;
  EstimateLayout layout_;
};

}  // namespace penduline
