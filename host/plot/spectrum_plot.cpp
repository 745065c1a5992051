// SPDX-License-Identifier: Apache-2.0
// The amplitude spectrum of each angle.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/plot/pen.hpp"
#include "host/plot/plot_kinds.hpp"
#include "host/plot/spectrum.hpp"
#include "host/plot/time_panel.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

/// From the lowest frequency that means something on; thinned for an eye on a logarithmic axis.
Curve spectrum_curve(const AmplitudeSpectrum& spectrum, const std::string& name) {
  const auto first = std::ranges::lower_bound(spectrum.frequency_hz, spectrum.lowest_hz) -
                     spectrum.frequency_hz.begin();
  const std::vector<double> hz(spectrum.frequency_hz.begin() + first, spectrum.frequency_hz.end());
  const std::vector<double> amplitude(spectrum.amplitude.begin() + first, spectrum.amplitude.end());
  std::vector<double> place(hz.size());
  std::ranges::transform(hz, place.begin(), [](double value) { return std::log(value); });
  const PenPath path = pen_over(place, amplitude, std::vector<bool>(hz.size(), true));
  const std::size_t peak = spectrum.peak();
  const std::string words = fmt::format(
      "{:.3g} deg at {:.4g} Hz", spectrum.amplitude[peak] / kDegree, spectrum.frequency_hz[peak]);
  return {.name = name.empty() ? words : name + ": " + words,
          .x = along(path, hz),
          .y = along(path, amplitude, kDegree)};
}

tl::expected<Panel, Error> spectrum_panel(const std::vector<EstimateSeries>& inputs,
                                          const std::string& angle,
                                          std::vector<double> EstimateSeries::*values) {
  Panel panel{.x_label = "frequency / Hz",
              .y_label = fmt::format("amplitude of {} / deg", angle),
              .logarithmic = true,
              .key_above = true};
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const EstimateSeries& series = inputs[i];
    if (!series.measures(values)) {
      continue;
    }
    const RowSpan rows = longest_span(joined_rows(series));
    const std::vector<double> span(
        (series.*values).begin() + static_cast<std::ptrdiff_t>(rows.begin),
        (series.*values).begin() + static_cast<std::ptrdiff_t>(rows.end));
    const double step_s = span.size() < 2 ? 0
                                          : (series.t_s[rows.end - 1] - series.t_s[rows.begin]) /
                                                static_cast<double>(span.size() - 1);
    const AmplitudeSpectrum spectrum = amplitude_spectrum(span, step_s);
    if (spectrum.amplitude.empty()) {
      return failure(
          fmt::format("{}: found {} rows in succession without a dropout, expected 8 or more",
                      series.name, span.size()));
    }
    if (const auto [least, most] = std::ranges::minmax(span); least == most) {
      return failure(fmt::format(
          "{}: found {} rows of one {}, {:.4g} deg, expected a swing: what rests has no "
          "spectrum",
          series.name, span.size(), angle, least / kDegree));
    }
    // What is weaker is no figure of a pendulum but of numbers' last digits.
    constexpr double kWeakest = 2e-6;
    const double least = kWeakest * spectrum.amplitude[spectrum.peak()] / kDegree;
    if (least > 0 && (!panel.y_least || least < *panel.y_least)) {
      panel.y_least = least;
    }
    panel.curves.push_back(spectrum_curve(spectrum, key_name(inputs, i)));
    panel.curves.back().colour = i;
    panel.curves.back().dash = i;
  }
  return panel;
}

void tell_what_is_used(const EstimateSeries& series, const PlotSettings& settings) {
  const RowSpan rows = longest_span(joined_rows(series));
  if (rows.end - rows.begin < series.size()) {
    settings.warn(fmt::format(
        "{}: the spectrum is that of the longest part without a dropout, {} of {} rows from {} s "
        "to {} s",
        series.name, rows.end - rows.begin, series.size(), series.t_s[rows.begin],
        series.t_s[rows.end - 1]));
  }
}

}  // namespace

tl::expected<Figure, Error> spectrum_plot(const std::vector<EstimateSeries>& inputs,
                                          const PlotSettings& settings) {
  const bool planar = std::ranges::all_of(inputs, &EstimateSeries::planar);
  auto first = spectrum_panel(inputs, planar ? "theta" : "theta1", &EstimateSeries::theta1_rad);
  if (!first) {
    return tl::unexpected(first.error());
  }
  Figure figure{.panels = {std::move(*first)}, .title = "Amplitude spectrum", .stacked = true};
  if (!planar) {
    auto second = spectrum_panel(inputs, "theta2", &EstimateSeries::theta2_rad);
    if (!second) {
      return tl::unexpected(second.error());
    }
    figure.panels.push_back(std::move(*second));
  }
  for (const EstimateSeries& series : inputs) {
    tell_what_is_used(series, settings);
  }
  return figure;
}

}  // namespace penduline
