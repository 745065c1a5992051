// SPDX-License-Identifier: Apache-2.0
// A rig as bytes, which the host uploads and the board stores, and back.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "common/closed_form.hpp"
#include "common/rig.hpp"
#include "common/wire/bytes.hpp"
#include "common/wire/choices.hpp"

namespace penduline::wire {

/// The first byte of an image. The first version ended with the sensors.
inline constexpr std::uint8_t kRigImageVersion = 2;
inline constexpr std::uint8_t kFirstRigImageVersion = 1;

/// The rate from which on a board does not run the Kalman filter: samples go first.
inline constexpr std::uint32_t kMostKalmanMillihz = 100'000;

/// A rig for a board, and what it is to find the angles by.
struct BoardRig {
  Rig<float> rig;
  OnboardEstimator estimator = OnboardEstimator::kGaussNewton;
};

/// What a board keeps for an image: two sensors with the longest tables take 637 bytes, eight
/// linear ones 385.
inline constexpr std::size_t kMaxRigImageBytes = 1024;

/// The byte that says which response model follows.
enum class ResponseModel : std::uint8_t {
  kLinear = 0,
  kTable = 1,
  kInverseSquare = 2,
  kPolynomial = 3,
};

inline void write_model(const LinearResponse<float>& curve, ByteWriter& writer) {
  writer.put(ResponseModel::kLinear);
  writer.put(curve.gap_at_zero_m);
  writer.put(curve.slope_m_per_v);
}

inline void write_model(const TableResponse<float>& curve, ByteWriter& writer) {
  const std::span<const float> volts = curve.gap_over_volts.x();
  const std::span<const float> gap_m = curve.gap_over_volts.y();
  writer.put(ResponseModel::kTable);
  writer.put(static_cast<std::uint8_t>(volts.size()));
  for (std::size_t i = 0; i < volts.size(); ++i) {
    writer.put(volts[i]);
    writer.put(gap_m[i]);
  }
}

inline void write_model(const InverseSquareResponse<float>& curve, ByteWriter& writer) {
  writer.put(ResponseModel::kInverseSquare);
  writer.put(curve.a_v_m2);
  writer.put(curve.b_m);
  writer.put(curve.c_v);
}

inline void write_model(const PolynomialResponse<float>& curve, ByteWriter& writer) {
  writer.put(ResponseModel::kPolynomial);
  writer.put(curve.volts_min);
  writer.put(curve.volts_max);
  writer.put(static_cast<std::uint8_t>(curve.count));
  for (std::size_t i = 0; i < curve.count; ++i) {
    writer.put(curve.coefficient[i]);
  }
}

/// Calls `visit` with each number of the trust, in the order of the image.
template <class Trust, class Visitor>
void for_each_trust(Trust& trust, const Visitor& visit) {
  visit(trust.length_share);
  visit(trust.damping_per_s);
  visit(trust.offset_m);
  visit(trust.acceleration_rad_s15);
  visit(trust.damping_walk_per_s15);
  visit(trust.offset_walk_m_s05);
}

/// Writes the rig's image. Returns its bytes; 0 where `out` is too small.
[[nodiscard]] inline std::size_t encode_rig(const BoardRig& board_rig,
                                            std::span<std::uint8_t> out) {
  const Rig<float>& rig = board_rig.rig;
  ByteWriter writer(out);
  writer.put(kRigImageVersion);
  writer.put(rig.pendulum.length_m);
  writer.put(rig.pendulum.mass_kg);
  writer.put(rig.pendulum.gravity_m_s2);
  writer.put(rig.pendulum.damping_per_s);
  writer.put(rig.layout.disc_offset_m);
  writer.put(rig.disc_diameter_m);
  writer.put(static_cast<std::uint8_t>(rig.filter ? 1 : 0));
  if (rig.filter) {
    writer.put(static_cast<std::uint8_t>(rig.filter->order));
    writer.put(rig.filter->cutoff_of_nyquist);
  }
  writer.put(static_cast<std::uint8_t>(rig.layout.count));
  for (std::size_t i = 0; i < rig.layout.count; ++i) {
    for (const float coordinate_m : rig.layout.position_m[i]) {
      writer.put(coordinate_m);
    }
    const Response<float>& response = rig.responses[i];
    writer.put(response.nearest_m);
    writer.put(response.farthest_m);
    writer.put(response.peak_m);
    std::visit([&](const auto& curve) { write_model(curve, writer); }, response.model);
  }
  writer.put(board_rig.estimator);
  for (std::size_t i = 0; i < rig.layout.count; ++i) {
    writer.put(rig.noise[i].volts);
    writer.put(rig.noise[i].gap_m);
  }
  for_each_trust(rig.trust, [&](float number) { writer.put(number); });
  return writer.fits() ? writer.size() : 0;
}

/// Reads an image value by value and keeps in mind whether all rules held so far.
class RigImageReader {
 public:
  explicit RigImageReader(std::span<const std::uint8_t> image) : reader_(image) {}

  void read(BoardRig& board_rig) {
    Rig<float>& rig = board_rig.rig;
    const std::size_t version = count(kFirstRigImageVersion, kRigImageVersion);
    rig.pendulum.length_m = above_zero();
    rig.pendulum.mass_kg = above_zero();
    rig.pendulum.gravity_m_s2 = above_zero();
    rig.pendulum.damping_per_s = not_negative();
    rig.layout.disc_offset_m = above_zero();
    rig.disc_diameter_m = above_zero();
    if (count(0, 1) == 1) {
      rig.filter.emplace();
      rig.filter->order = count(0, kMaxTaps - 1);
      rig.filter->cutoff_of_nyquist = above_zero();
      require(rig.filter->cutoff_of_nyquist <= 1);
    }
    rig.layout.count = count(2, kMaxSensors);
    for (std::size_t i = 0; i < rig.layout.count; ++i) {
      for (float& coordinate_m : rig.layout.position_m[i]) {
        coordinate_m = finite();
      }
      read(rig.responses[i]);
    }
    require(determines_tilt(rig.layout));
    if (version == kFirstRigImageVersion) {
      return;
    }
    board_rig.estimator = static_cast<OnboardEstimator>(count(0, kOnboardEstimators.size() - 1));
    for (std::size_t i = 0; i < rig.layout.count; ++i) {
      rig.noise[i] = {.volts = up_to(kMostNoise), .gap_m = up_to(kMostNoise)};
      require(rig.noise[i].volts > 0 || rig.noise[i].gap_m > 0);
    }
    for_each_trust(rig.trust, [&](float& number) { number = up_to(kMostTrust); });
    require(rig.trust.acceleration_rad_s15 > 0);
    // A shorter pendulum is more steps of its motion than a board has time for.
    require(board_rig.estimator != OnboardEstimator::kKalman ||
            rig.pendulum.gravity_m_s2 <= kMostGravityPerLength * rig.pendulum.length_m);
  }

  /// Whether every rule held and the image ended where it should.
  [[nodiscard]] bool valid() const { return valid_ && reader_.used_up(); }

 private:
  static constexpr float kMostNoise = 10;               ///< volts, or metres
  static constexpr float kMostTrust = 1000;             ///< in the unit of each
  static constexpr float kMostGravityPerLength = 1000;  ///< 1/s^2

  void require(bool kept) { valid_ = valid_ && kept; }

  [[nodiscard]] float finite() {
    const float value = reader_.take<float>();
    require(std::isfinite(value));
    return value;
  }
  [[nodiscard]] float above_zero() {
    const float value = finite();
    require(value > 0);
    return value;
  }
  [[nodiscard]] float not_negative() {
    const float value = finite();
    require(value >= 0);
    return value;
  }
  [[nodiscard]] float up_to(float most) {
    const float value = not_negative();
    require(value <= most);
    return value;
  }
  /// `least` where the number is not allowed, so that no loop runs away.
  [[nodiscard]] std::size_t count(std::size_t least, std::size_t most) {
    const std::size_t value = reader_.take<std::uint8_t>();
    const bool allowed = least <= value && value <= most;
    require(allowed);
    return allowed ? value : least;
  }

  void read(Response<float>& response) {
    response.nearest_m = finite();
    // Infinite where the model has no far end.
    response.farthest_m = reader_.take<float>();
    require(response.nearest_m < response.farthest_m);
    response.peak_m = not_negative();
    switch (reader_.take<ResponseModel>()) {
      case ResponseModel::kLinear:
        response.model = linear();
        return;
      case ResponseModel::kTable:
        response.model = table();
        return;
      case ResponseModel::kInverseSquare:
        response.model = inverse_square();
        return;
      case ResponseModel::kPolynomial:
        response.model = polynomial();
        return;
    }
    require(false);
  }

  [[nodiscard]] LinearResponse<float> linear() {
    LinearResponse<float> curve{.gap_at_zero_m = finite(), .slope_m_per_v = finite()};
    require(curve.slope_m_per_v != 0);
    return curve;
  }

  [[nodiscard]] Response<float>::Model table() {
    std::array<float, kMaxCurvePoints> volts{};
    std::array<float, kMaxCurvePoints> gap_m{};
    const std::size_t points = count(2, kMaxCurvePoints);
    for (std::size_t i = 0; i < points; ++i) {
      volts[i] = finite();
      gap_m[i] = finite();
    }
    for (std::size_t i = 1; i < points; ++i) {
      require(volts[i] > volts[i - 1]);
      require(gap_m[1] > gap_m[0] ? gap_m[i] > gap_m[i - 1] : gap_m[i] < gap_m[i - 1]);
    }
    if (!valid_) {
      return LinearResponse<float>{};
    }
    const TableResponse<float> curve{
        {std::span(volts).first(points), std::span(gap_m).first(points)}};
    // Points that are apart by a rounding or by the whole range of a float have no slope.
    for (std::size_t i = 1; i < points; ++i) {
      require(std::isfinite(*curve.gap_m(volts[i - 1] / 2 + volts[i] / 2)));
    }
    require(std::isfinite(*curve.gap_m(volts[0] - 1)));
    require(std::isfinite(*curve.gap_m(volts[points - 1] + 1)));
    return curve;
  }

  [[nodiscard]] InverseSquareResponse<float> inverse_square() {
    return {.a_v_m2 = above_zero(), .b_m = not_negative(), .c_v = finite()};
  }

  [[nodiscard]] PolynomialResponse<float> polynomial() {
    // Coarser than the host's check of the same, so that a float's rounding does not fail it.
    constexpr int kPlaces = 64;
    PolynomialResponse<float> curve;
    curve.volts_min = finite();
    curve.volts_max = finite();
    require(curve.volts_min < curve.volts_max);
    curve.count = count(2, PolynomialResponse<float>::kMaxCoefficients);
    for (std::size_t i = 0; i < curve.count; ++i) {
      curve.coefficient[i] = finite();
    }
    require(curve.is_monotone(kPlaces));
    return curve;
  }

  ByteReader reader_;
  bool valid_ = true;
};

/// The rig in an image; nothing unless the pipeline can work with every number in it.
[[nodiscard]] inline std::optional<BoardRig> decode_rig(std::span<const std::uint8_t> image) {
  std::optional<BoardRig> rig;
  rig.emplace();
  RigImageReader reader(image);
  reader.read(*rig);
  if (!reader.valid()) {
    rig.reset();
  }
  return rig;
}

}  // namespace penduline::wire
