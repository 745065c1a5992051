// SPDX-License-Identifier: Apache-2.0
// The few objects that are sent seldom; the many numbers are LivePoints' matter.
#include "host/web/live_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "hal/replay/utc_text.hpp"
#include "host/web/sensor_now.hpp"

namespace penduline {
namespace {

using Json = nlohmann::ordered_json;

/// On one line, whatever bytes a name from a file or a board has.
std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json text_or_null(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

/// JSON knows no infinity: a range without an end there says null.
Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json sensors_of(const RigFile& file) {
  const Rig<double>& rig = file.rig;
  Json sensors = Json::array();
  for (std::size_t i = 0; i < rig.layout.count; ++i) {
    const Vector3<double>& face = rig.layout.position_m[i];
    const Response<double>& response = rig.responses[i];
    // No signal is below 0 V, whatever a straight line says.
    const double near_v = std::max(response.volts(response.nearest_m), 0.);
    const double far_v = std::max(response.volts(response.farthest_m), 0.);
    sensors.push_back(
        {{"name", file.sensor_names[i]},
         {"x_m", face.x()},
         {"y_m", face.y()},
         {"z_m", face.z()},
         {"gap_range_m", {response.nearest_m, number_or_null(response.farthest_m)}},
         {"signal_range_v",
          {number_or_null(std::min(near_v, far_v)), number_or_null(std::max(near_v, far_v))}}});
  }
  return sensors;
}

/// Of one sensor in the newest sample.
Json sensor_state(const LiveSubject& subject, const Sample& sample, std::size_t i) {
  const SensorNow now = sensor_now(subject.rig.rig, subject.header->acquisition, sample, i);
  return {{"ambient_v", now.ambient_v ? Json(*now.ambient_v) : Json()},
          {"signal_v", now.signal_v ? Json(*now.signal_v) : Json()},
          {"saturated", now.saturated ? Json(*now.saturated) : Json()},
          {"out_of_range", now.out_of_range}};
}

/// The session's first sample may be the first of its start as well: that is no restart.
std::uint64_t count_of(const LiveState& state, Flags bit) {
  const std::uint64_t count = state.counts->flagged(bit);
  return bit == flag::kRestarted && state.began_with_start && count > 0 ? count - 1 : count;
}

Json flags_of(const LiveState& state) {
  Json flags = Json::array();
  for (std::size_t i = 0; i < kFlagDescriptions.size(); ++i) {
    const std::uint64_t count = count_of(state, kFlagDescriptions[i].bit);
    if (count > 0) {
      flags.push_back({{"name", kFlagDescriptions[i].name},
                       {"count", count},
                       {"latest_s", state.flag_latest_s[i]}});
    }
  }
  return flags;
}

Json ellipse_of(const PathEllipse& ellipse) {
  Json sense;
  if (ellipse.sense != 0) {
    sense = ellipse.sense > 0 ? "left" : "right";
  }
  return {{"a_m", ellipse.a_m},
          {"b_m", ellipse.b_m},
          {"x_m", ellipse.x_m},
          {"y_m", ellipse.y_m},
          {"orientation_rad", ellipse.orientation_rad},
          {"sense", std::move(sense)}};
}

std::string text_of(const RecordingEvent& event, std::string_view key) {
  return event.get<std::string>(key).value_or("");
}

}  // namespace

std::string session_json(const LiveSubject& subject, const RecordingState& recording) {
  const RecordingHeader header = subject.header.value_or(RecordingHeader());
  const auto known = [&](double value) { return subject.header ? Json(value) : Json(); };
  Json present;
  if (recording.name) {
    present = {{"name", *recording.name}, {"since_utc", recording.since_utc}};
  }
  return line_of({{"program", fmt::format("penduline {}", PENDULINE_VERSION)},
                  {"source", subject.source},
                  {"estimator", subject.estimator},
                  {"rig",
                   {{"name", subject.rig_name},
                    {"length_m", subject.rig.rig.pendulum.length_m},
                    {"disc",
                     {{"offset_m", subject.rig.rig.layout.disc_offset_m},
                      {"diameter_m", subject.rig.rig.disc_diameter_m}}},
                    {"sensors", sensors_of(subject.rig)}}},
                  {"board", text_or_null(header.board)},
                  {"firmware", text_or_null(header.firmware)},
                  {"serial", text_or_null(header.serial)},
                  {"rate_hz", known(header.acquisition.rate_hz)},
                  {"reference_v", known(header.acquisition.reference_v)},
                  {"token_needed", subject.token_needed},
                  {"can_record", recording.can_record},
                  {"recording", std::move(present)},
                  {"download", recording.latest ? Json(*recording.latest) : Json()}});
}

std::string state_json(const LiveSubject& subject, const LiveState& state,
                       std::uint64_t recorded_samples) {
  Json json = {{"connected", state.connected}};
  if (state.counts) {
    const auto rate_hz = state.counts->rate_hz();
    json["samples"] = state.counts->samples();
    json["lost"] = state.counts->lost();
    json["dropouts"] = state.counts->flagged(flag::kDropout);
    json["restarts"] = count_of(state, flag::kRestarted);
    json["rate_hz"] = rate_hz ? Json(*rate_hz) : Json();
    json["flags"] = flags_of(state);
  } else {
    json.update({{"samples", 0},
                 {"lost", 0},
                 {"dropouts", 0},
                 {"restarts", 0},
                 {"rate_hz", nullptr},
                 {"flags", Json::array()}});
  }
  json["sensors"] = Json::array();
  for (std::size_t i = 0; state.connected && state.sample && i < subject.rig.rig.layout.count;
       ++i) {
    json["sensors"].push_back(sensor_state(subject, *state.sample, i));
  }
  json["clock"] = text_or_null(state.clock);
  json["ellipse"] = state.swing ? ellipse_of(state.swing->ellipse) : Json();
  json["period_s"] = state.swing ? Json(state.swing->period_s) : Json();
  json["amplitude_rad"] = state.swing ? Json(state.swing->amplitude_rad) : Json();
  json["recorded_samples"] = recorded_samples;
  return line_of(json);
}

std::string note_json(const RecordingEvent& event, double t_s) {
  return line_of({{"t_s", t_s},
                  {"utc", event.utc_us ? Json(utc_text(*event.utc_us)) : Json()},
                  {"kind", event.kind},
                  {"text", note_text(event)}});
}

std::string error_json(std::string_view sentence) {
  return line_of({{"error", sentence}});
}

std::string note_text(const RecordingEvent& event) {
  if (event.kind == event::kConnected) {
    return fmt::format("The board is connected ({}).", text_of(event, "port"));
  }
  if (event.kind == event::kDisconnected) {
    return fmt::format("The board went away: {}.", text_of(event, "reason"));
  }
  if (event.kind == event::kBoot) {
    return "The board has started anew.";
  }
  if (event.kind == event::kRelease) {
    return "The magnet has let the pendulum go.";
  }
  if (event.kind == event::kTrigger) {
    return fmt::format("The trigger input went {}.", text_of(event, "edge"));
  }
  if (event.kind == event::kUnrecorded) {
    return fmt::format("{} samples could not be recorded.",
                       event.get<std::int64_t>("samples").value_or(0));
  }
  const std::string text = text_of(event, "text");
  return text.empty() && event.kind != event::kMark ? event.kind : text;
}

}  // namespace penduline
