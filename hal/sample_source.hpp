// SPDX-License-Identifier: Apache-2.0
// What the host reads samples from, as a concept; each backend asserts that it models it.
#pragma once

#include <concepts>
#include <tl/expected.hpp>

#include "common/sample.hpp"
#include "hal/error.hpp"

namespace penduline {

/// A stream of samples: simulated, recorded, or from a board.
template <class Source>
concept SampleSource = requires(Source& source, const Source& unchanged, Sample& sample) {
  /// How all samples of the stream are taken.
  { unchanged.acquisition() } -> std::same_as<const Acquisition<double>&>;
  /// Fills in the next sample: true; false when the stream has ended.
  { source.read(sample) } -> std::same_as<tl::expected<bool, Error>>;
};

}  // namespace penduline
