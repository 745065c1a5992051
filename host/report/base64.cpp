// SPDX-License-Identifier: Apache-2.0
// Boost's iterators from bytes to digits.
#include "host/report/base64.hpp"

#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <iterator>

namespace penduline {

void append_base64(std::string& text, std::string_view bytes) {
  constexpr std::size_t kByteBits = 8;
  constexpr std::size_t kDigitBits = 6;
  constexpr std::size_t kGroupBytes = 3;
  using Digits =
      boost::archive::iterators::base64_from_binary<boost::archive::iterators::transform_width<
          std::string_view::const_iterator, kDigitBits, kByteBits>>;
  std::copy(Digits(bytes.begin()), Digits(bytes.end()), std::back_inserter(text));
  text.append((kGroupBytes - bytes.size() % kGroupBytes) % kGroupBytes, '=');
}

}  // namespace penduline
