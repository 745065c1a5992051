// SPDX-License-Identifier: Apache-2.0
// From files to columns of estimates.
#include "host/plot/estimate_input.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <limits>
#include <utility>

#include "host/analysis/number_table.hpp"
#include "host/session/session.hpp"
#include "host/source/source.hpp"

namespace penduline {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Where each of `kSeriesColumns` stands in a table.
using Places = std::array<std::optional<std::size_t>, kSeriesColumns.size()>;

Places find_places(const NumberTable& table, const AngleColumns& angles) {
  Places places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool is_theta1 = kSeriesColumns[i].values == &EstimateSeries::theta1_rad;
    places[i] = is_theta1 ? angles.theta1 : table.column(kSeriesColumns[i].name);
  }
  return places;
}

/// What a row says in the column that none of the file's is.
double absent(const SeriesColumn& column, bool planar) {
  const bool zero = column.values == &EstimateSeries::flags ||
                    (planar && column.values == &EstimateSeries::theta2_rad);
  return zero ? 0 : kUnknown;
}

tl::expected<void, Error> take_row(const NumberTable& table, const Places& places,
                                   EstimateSeries& series) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const SeriesColumn& column = kSeriesColumns[i];
    double value = absent(column, series.planar);
    const bool needed =
        column.values == &EstimateSeries::t_s || column.values == &EstimateSeries::flags;
    if (places[i] && (needed || !table.is_empty(*places[i]))) {
      const auto number = table.number(*places[i]);
      if (!number) {
        return tl::unexpected(number.error());
      }
      value = *number;
    }
    (series.*column.values).push_back(value);
  }
  const std::size_t last = series.size() - 1;
  if (last > 0 && !(series.t_s[last] > series.t_s[last - 1])) {
    return failure(fmt::format("{}: the time went from {} s to {} s, expected it to rise",
                               table.place(), series.t_s[last - 1], series.t_s[last]));
  }
  return {};
}

/// Keeps a session's estimates.
class SeriesSink final : public EstimateSink {
 public:
  explicit SeriesSink(EstimateSeries& series) : series_(series) {}

  tl::expected<void, Error> take(const Estimate<double>& estimate) override {
    series_.push_back(estimate);
    const std::size_t last = series_.size() - 1;
    if (last > 0 && !(series_.t_s[last] > series_.t_s[last - 1])) {
      return failure(
          fmt::format("seq {}: the board's clock started anew after {} s; plot each part by itself",
                      estimate.seq, series_.t_s[last - 1]));
    }
    return {};
  }

 private:
  EstimateSeries& series_;
};

}  // namespace

tl::expected<EstimateSeries, Error> read_estimate_table(const std::string& path) {
  auto table = NumberTable::open(path);
  if (!table) {
    return tl::unexpected(table.error());
  }
  const auto angles = find_angle_columns(*table);
  if (!angles) {
    return tl::unexpected(angles.error());
  }
  const Places places = find_places(*table, *angles);
  EstimateSeries series{.planar = !angles->theta2};
  return table->for_each_row([&] { return take_row(*table, places, series); }).map([&] {
    return std::move(series);
  });
}

tl::expected<EstimateSeries, Error> estimates_of_recording(
    const std::string& path, const Rig<double>& rig, const EstimatorOptions& options,
    const std::function<void(const std::string&)>& warn) {
  auto source = open_recording(path);
  if (!source) {
    return tl::unexpected(source.error());
  }
  const auto estimator = make_estimator(options, rig, (*source)->header().acquisition);
  if (!estimator) {
    return failure(fmt::format("{}: {}", path, estimator.error().message));
  }
  EstimateSeries series;
  SeriesSink sink(series);
  const StopSignal stop;
  const SessionResult result = run_session(
      {.source = **source, .estimator = **estimator, .output = sink, .warn = warn}, {}, stop);
  if (result.error) {
    return tl::unexpected(*result.error);
  }
  if (stop.requested()) {
    return failure(path + ": stopped while reading");
  }
  return series;
}

tl::expected<EstimateSeries, Error> read_estimates(
    const std::string& path, const EstimateInput& input,
    const std::function<void(const std::string&)>& warn) {
  const auto is_table = is_angle_table(path);
  if (!is_table) {
    return tl::unexpected(is_table.error());
  }
  if (!*is_table && !input.rig) {
    return tl::unexpected(no_angles(path));
  }
  auto series = *is_table ? read_estimate_table(path)
                          : estimates_of_recording(path, *input.rig, input.estimator, warn);
  if (!series) {
    return series;
  }
  series->name = std::filesystem::path(path).filename().string();
  if (input.rig && !any_known(series->x_m)) {
    series->hang_mass(input.rig->pendulum.length_m);
  }
  return series;
}

}  // namespace penduline
