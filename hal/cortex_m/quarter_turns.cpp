// SPDX-License-Identifier: Apache-2.0
// How newlib's sinf and cosf bring an angle within an eighth of a turn of 0, in place of newlib's
// own function of this name: that holds for any float, and takes 3.5 KiB for it.
#include <limits>

extern "C" int __ieee754_rem_pio2f(float angle_rad, float* rest_rad);  // NOLINT: newlib's name

/// Returns the quarter turns and fills in what is left of the angle, in two parts: to 1e-10 rad
/// for up to 127 quarter turns. Beyond them, where no angle of a pendulum or a filter is, NaN.
extern "C" int __ieee754_rem_pio2f(float angle_rad, float* rest_rad) {  // NOLINT
  constexpr float kQuartersPerRad = 0.636619772F;
  constexpr float kMostQuarters = 127;
  // A quarter turn in two parts, the first of 17 bits: times up to 127 it is exact.
  constexpr float kQuarterRad = 0x1.921fp+0F;
  constexpr float kQuarterRestRad = 0x1.6a8886p-17F;
  const float quarters = angle_rad * kQuartersPerRad;
  if (!(quarters <= kMostQuarters && quarters >= -kMostQuarters)) {
    rest_rad[0] = rest_rad[1] = std::numeric_limits<float>::quiet_NaN();
    return 0;
  }
  const int whole = static_cast<int>(quarters + (quarters < 0 ? -0.5F : 0.5F));
  const auto count = static_cast<float>(whole);
  const float near_rad = angle_rad - count * kQuarterRad;
  const float correction_rad = count * kQuarterRestRad;
  rest_rad[0] = near_rad - correction_rad;
  rest_rad[1] = (near_rad - rest_rad[0]) - correction_rad;
  return whole;
}
