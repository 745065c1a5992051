// SPDX-License-Identifier: Apache-2.0
// Which kinds of friction the data of a swing support.
#pragma once

#include <tl/expected.hpp>
#include <vector>

#include "host/analysis/swing_fit.hpp"

namespace penduline {

/// One model's case. Numbers compare models of the same data only.
struct FrictionCandidate {
  FrictionTerms terms;
  double residual_rad = 0;  ///< RMS over all angles
  double bic = 0;           ///< above the best model's (Schwarz 1978), repetition counted
  bool supported = false;   ///< within `kBicMargin` of the best
};

/// What one kind of friction explains that the others cannot.
struct FrictionTest {
  double f = 0;            ///< of the model with all three against that without it
  double probability = 1;  ///< of such an F or a larger one by chance
};

struct FrictionChoice {
  SwingFit chosen;  ///< the fewest kinds among the supported; linear before quadratic before dry
  SwingFit full;    ///< all three
  std::vector<FrictionCandidate> candidates;  ///< all eight, in binary order of the terms
  FrictionTest linear;
  FrictionTest quadratic;
  FrictionTest dry;
};

/// A difference that is strong evidence (Kass and Raftery 1995).
inline constexpr double kBicMargin = 6;

/// Fits all eight models from the linear one's fit on. Fails as `fit_swing` does.
[[nodiscard]] tl::expected<FrictionChoice, Error> choose_friction(
    const AngleSeries& series, const SwingFit& linear, const std::function<bool()>& stopped = {});

/// "linear", "quadratic + dry", "none".
[[nodiscard]] std::string name_of(const FrictionTerms& terms);

}  // namespace penduline
