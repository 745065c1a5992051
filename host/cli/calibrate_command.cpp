// SPDX-License-Identifier: Apache-2.0
// `penduline calibrate`: recordings in, a better rig file out.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hal/replay/cells.hpp"
#include "host/calibration/geometry_calibration.hpp"
#include "host/calibration/rest_calibration.hpp"
#include "host/calibration/static_calibration.hpp"
#include "host/calibration/swing_calibration.hpp"
#include "host/cli/calibration_options.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/number_within.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

struct StaticOptions {
  CalibrationOptions common;
  std::string points_path;
  ResponseModel model = ResponseModel::kTable;
};

void add_static(CLI::App& calibrate, ExitStatus& status) {
  auto options = std::make_shared<StaticOptions>();
  CLI::App* command = calibrate.add_subcommand(
      "static", "Fit each sensor's response to points at known tilts or gaps");
  add_recordings(*command, options->common, "The recording, where the table names none");
  add_calibration_options(*command, options->common);
  command
      ->add_option("--points", options->points_path,
                   "Table of the points: recording, or from_s and to_s of one; theta1_deg and\n"
                   "theta2_deg, or gap_x_mm, gap_y_mm, ... (docs/formats.md)")
      ->required()
      ->type_name("FILE");
  const std::map<std::string, ResponseModel> models{
      {"table", ResponseModel::kTable},
      {"inverse_square", ResponseModel::kInverseSquare},
      {"polynomial", ResponseModel::kPolynomial},
      {"linear", ResponseModel::kLinear}};
  command
      ->add_option("--model", options->model,
                   "The response to fit; table is a smooth curve, as bent as the points tell")
      ->transform(CLI::CheckedTransformer(models).description(""))
      ->type_name("table|inverse_square|polynomial|linear")
      ->default_str("table");
  command->footer(
      "Points nearer than a quarter beyond the response's peak are left out, and said.\n\n"
      "  penduline calibrate static --points points.csv --rig rig.toml -o calibrated.toml\n"
      "  penduline calibrate static rec.csv --points spans.csv --rig rig.toml -o new.toml");
  command->final_callback([options, &status] {
    status = conclude_calibration(options->common, [&](const RigFile& rig) {
      return by_points(options->common, options->points_path, rig, [&](const SensorPoints& points) {
        return calibrate_static(rig, points, options->model);
      });
    });
  });
}

struct RestOptions {
  CalibrationOptions common;
  ZeroOf zero_of = ZeroOf::kHeight;
};

void add_rest(CLI::App& calibrate, ExitStatus& status) {
  auto options = std::make_shared<RestOptions>();
  CLI::App* command =
      calibrate.add_subcommand("rest", "Zero the sensors by a pendulum that hangs still");
  add_recordings(*command, options->common, "Recordings of the still pendulum, 10 s or more")
      ->required();
  add_calibration_options(*command, options->common);
  const std::map<std::string, ZeroOf> zeros{
      {"height", ZeroOf::kHeight}, {"response", ZeroOf::kResponse}, {"gain", ZeroOf::kGain}};
  command
      ->add_option("--zero", options->zero_of,
                   "What has changed. height: how the sensor is mounted; response: its gap for a\n"
                   "signal; gain: its light, as with temperature")
      ->transform(CLI::CheckedTransformer(zeros).description(""))
      ->type_name("height|response|gain")
      ->default_str("height");
  command->footer(
      "A pendulum that swings or sensors that drift by more than 0.03 deg are refused.\n\n"
      "  penduline calibrate rest still.csv --rig rig.toml -o zeroed.toml");
  command->final_callback([options, &status] {
    status = conclude_calibration(options->common, [&](const RigFile& rig) {
      return by_recordings(options->common, rig, [&](const std::vector<SignalLog>& logs) {
        return calibrate_rest(rig, logs, options->zero_of);
      });
    });
  });
}

/// "12": a tilt; "8.5,-8.5": theta1 and theta2.
Release parse_release(const std::string& text) {
  constexpr double kMostDeg = 60;
  std::vector<double> numbers;
  for (const std::string_view cell : split_cells(text, ",")) {
    const auto number = parse_number<double>(cell);
    if (!number || !(std::abs(*number) <= kMostDeg)) {
      throw CLI::ValidationError(
          "--released-at",
          fmt::format("found '{}', expected the tilt or theta1,theta2 in degrees, to 60", text));
    }
    numbers.push_back(*number * kDegree);
  }
  if (numbers.size() == 1 && numbers[0] > 0) {
    return {.angles = {}, .tilt_rad = numbers[0]};
  }
  if (numbers.size() == 2) {
    return {.angles = Angles<double>{.theta1_rad = numbers[0], .theta2_rad = numbers[1]}};
  }
  throw CLI::ValidationError(
      "--released-at",
      fmt::format("found '{}', expected a tilt above 0 or theta1,theta2 in degrees", text));
}

void add_swing_options(CLI::App& command, SwingOptions& options) {
  command
      .add_option_function<std::string>(
          "--released-at",
          [&options](const std::string& text) { options.release = parse_release(text); },
          "Each recording begins before the pendulum is let go, or as it is, from rest at this\n"
          "tilt, or at these theta1,theta2; known to 0.1 deg")
      ->type_name("DEG[,DEG]");
  command
      .add_option("--length-m", options.length_m,
                  "The pendulum's effective length, known to 0.1 %; else the rig's, to 2 %")
      ->check(number_within(1e-3, 100))
      ->type_name("M");
}

struct SwingCommandOptions {
  CalibrationOptions common;
  SwingOptions swing;
  std::string points_path;
};

void add_swing(CLI::App& calibrate, ExitStatus& status) {
  auto options = std::make_shared<SwingCommandOptions>();
  CLI::App* command = calibrate.add_subcommand(
      "swing", "Fit each sensor's response to a free swing, without any jig");
  add_recordings(*command, options->common, "Recordings of free swings, 20 s to minutes each")
      ->required();
  add_calibration_options(*command, options->common);
  add_swing_options(*command, options->swing);
  const std::map<std::string, CurveKind> models{{"table", CurveKind::kLogPolynomial},
                                                {"inverse_square", CurveKind::kInverseSquare}};
  command
      ->add_option("--model", options->swing.curve, "The response to fit; table is a smooth curve")
      ->transform(CLI::CheckedTransformer(models).description(""))
      ->type_name("table|inverse_square")
      ->default_str("table");
  command->footer(
      "Let it swing in an ellipse, 10 deg by 4 or so, for a minute: the slower period and the "
      "turning\n"
      "of a wide ellipse tell how large its angles are.\n\n"
      "  penduline calibrate swing swing.csv --rig rig.toml -o calibrated.toml --plot fit.svg\n"
      "  penduline calibrate swing let_go.csv --released-at 8,8 --rig rig.toml -o new.toml");
  command->final_callback([options, &status] {
    status = conclude_calibration(options->common, [&](const RigFile& rig) {
      return by_recordings(options->common, rig, [&](const std::vector<SignalLog>& logs) {
        return calibrate_swing(rig, logs, options->swing);
      });
    });
  });
}

void add_geometry(CLI::App& calibrate, ExitStatus& status) {
  auto options = std::make_shared<SwingCommandOptions>();
  CLI::App* command = calibrate.add_subcommand(
      "geometry", "Find where the sensors stand and the disc's offset, as far as the data tell");
  add_recordings(*command, options->common,
                 "Recordings of free swings, or the one that a table of points is of");
  add_calibration_options(*command, options->common);
  command
      ->add_option("--points", options->points_path,
                   "Table of points at known tilts, as of calibrate static")
      ->type_name("FILE");
  add_swing_options(*command, options->swing);
  command->footer(
      "The responses are taken as right: calibrate them by known gaps before.\n\n"
      "  penduline calibrate geometry --points tilts.csv --rig rig.toml -o new.toml\n"
      "  penduline calibrate geometry swing.csv --rig rig.toml -o new.toml");
  command->final_callback([options, &status] {
    const bool swing = options->points_path.empty();
    if (swing && options->common.recordings.empty()) {
      throw CLI::RequiredError("FILE or --points");
    }
    if (!swing && (options->swing.release || options->swing.length_m)) {
      throw CLI::ValidationError("--points", "excludes --released-at and --length-m");
    }
    status = conclude_calibration(options->common, [&](const RigFile& rig) {
      if (swing) {
        return by_recordings(options->common, rig, [&](const std::vector<SignalLog>& logs) {
          return calibrate_geometry(rig, logs, options->swing);
        });
      }
      return by_points(options->common, options->points_path, rig,
                       [&](const SensorPoints& points) { return calibrate_geometry(rig, points); });
    });
  });
}

}  // namespace

void add_calibrate_command(CLI::App& program, ExitStatus& status) {
  CLI::App* command = program.add_subcommand("calibrate", "Make a better rig file from recordings");
  command->require_subcommand(1);
  add_static(*command, status);
  add_rest(*command, status);
  add_swing(*command, status);
  add_geometry(*command, status);
  command->footer(
      "docs/calibration.md tells which method suits.\n\n"
      "  penduline calibrate swing swing.csv --rig rig.toml -o calibrated.toml");
}

}  // namespace penduline
