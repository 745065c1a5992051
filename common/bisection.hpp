// SPDX-License-Identifier: Apache-2.0
// Bisection to the last bit of the scalar.
#pragma once

namespace penduline {

/// Where a predicate turns from false to true between `low` (false) and `high` (true): the last
/// place at which it is still false. At most as many steps as the scalar has representable orders
/// and bits between the ends.
template <class Scalar, class Predicate>
[[nodiscard]] Scalar bisect(Scalar low, Scalar high, Predicate is_beyond) {
  while (true) {
    const Scalar middle = (low + high) / 2;
    if (!(middle > low && middle < high)) {
      return low;
    }
    (is_beyond(middle) ? high : low) = middle;
  }
}

}  // namespace penduline
