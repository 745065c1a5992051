// SPDX-License-Identifier: Apache-2.0
// The list of an estimate's columns.
#include "host/output/estimate_columns.hpp"

#include <array>

namespace penduline {
namespace {

using Row = Estimate<double>;
using Value = std::optional<double>;

constexpr std::size_t kMicro = 6;
constexpr std::size_t kNano = 9;

template <class Pick>
Value from_attitude(const Row& row, Pick pick) {
  return row.attitude ? Value(pick(*row.attitude)) : std::nullopt;
}

Value first(const std::optional<Row::Pair>& pair) {
  return pair ? Value(pair->first) : std::nullopt;
}

Value second(const std::optional<Row::Pair>& pair) {
  return pair ? Value(pair->second) : std::nullopt;
}

constexpr std::array kColumns = {
    EstimateColumn{"t_s", "the moment that the angles refer to, in device seconds", kMicro,
                   [](const Row& row) -> Value { return static_cast<double>(row.t_us) / 1e6; }},
    EstimateColumn{"seq", "the newest sample that went in", 0,
                   [](const Row& row) -> Value { return static_cast<double>(row.seq); }},
    EstimateColumn{"theta1_rad", "rotation about the fixed X axis", kNano,
                   [](const Row& row) {
                     return from_attitude(row, [](const auto& a) { return a.angles.theta1_rad; });
                   }},
    EstimateColumn{"theta2_rad", "then rotation about the turned Y axis", kNano,
                   [](const Row& row) {
                     return from_attitude(row, [](const auto& a) { return a.angles.theta2_rad; });
                   }},
    EstimateColumn{"x_m", "position of the mass from the pivot", kNano,
                   [](const Row& row) {
                     return from_attitude(row, [](const auto& a) { return a.mass_m.x(); });
                   }},
    EstimateColumn{"y_m", "position of the mass from the pivot", kNano,
                   [](const Row& row) {
                     return from_attitude(row, [](const auto& a) { return a.mass_m.y(); });
                   }},
    EstimateColumn{"z_m", "position of the mass from the pivot, upwards", kNano,
                   [](const Row& row) {
                     return from_attitude(row, [](const auto& a) { return a.mass_m.z(); });
                   }},
    EstimateColumn{"omega1_rad_s", "rate of theta1", kNano,
                   [](const Row& row) { return first(row.omega_rad_s); }},
    EstimateColumn{"omega2_rad_s", "rate of theta2", kNano,
                   [](const Row& row) { return second(row.omega_rad_s); }},
    EstimateColumn{"sigma1_rad", "standard deviation of theta1", kNano,
                   [](const Row& row) { return first(row.sigma_rad); }},
    EstimateColumn{"sigma2_rad", "standard deviation of theta2", kNano,
                   [](const Row& row) { return second(row.sigma_rad); }},
    EstimateColumn{"residual_m", "RMS misfit of the gaps", kNano,
                   [](const Row& row) { return row.residual_m; }},
    EstimateColumn{"flags", "sum of the flags that are set", 0,
                   [](const Row& row) -> Value { return static_cast<double>(row.flags); }},
    // By request, so the last one.
    EstimateColumn{
        "utc_s", "the same moment in seconds since 1970, where the host knows it", kMicro,
        [](const Row& row) {
          return row.utc_us ? Value(static_cast<double>(*row.utc_us) / 1e6) : std::nullopt;
        }},
};

}  // namespace

std::span<const EstimateColumn> estimate_columns(bool with_utc) {
  return std::span(kColumns).first(kColumns.size() - (with_utc ? 0 : 1));
}

}  // namespace penduline
