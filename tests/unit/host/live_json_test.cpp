// SPDX-License-Identifier: Apache-2.0
// Tests of what the page is told of session, state and notes.
#include "host/web/live_json.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/unit/host/headers.hpp"
#include "tests/unit/host/rig_text.hpp"
#include "tests/unit/host/scripted_source.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;
using Json = nlohmann::json;

const RigFile kRig =
    parse_rig(rig_with_response("{ model = \"linear\", gap_at_zero_m = 0.031, "
                                "slope_m_per_v = -0.006, range_m = [0.013, 0.025] }"),
              "rig.toml")
        .value();

LiveSubject subject() {
  return {.rig = kRig,
          .rig_name = "rig",
          .source = "auto",
          .estimator = "ekf",
          .header = header_of("pico"),
          .token_needed = true};
}

TEST_CASE("A session tells source, rig, board and rights", "[web]") {
  const auto json = Json::parse(session_json(subject(), {.can_record = true}));
  CHECK(json["source"] == "auto");
  CHECK(json["estimator"] == "ekf");
  CHECK(json["rig"]["name"] == "rig");
  CHECK(json["rig"]["length_m"] == 0.3);
  CHECK(json["rig"]["disc"]["offset_m"] == 0.02);
  CHECK(json["board"] == "pico");
  CHECK(json["serial"].is_null());
  CHECK(json["rate_hz"] == 20.0);
  CHECK(json["reference_v"] == 3.3);
  CHECK(json["token_needed"] == true);
  CHECK(json["can_record"] == true);
  CHECK(json["recording"].is_null());
  CHECK(json["download"].is_null());
}

TEST_CASE("A sensor's ranges are told, and null where there is no end", "[web]") {
  const auto sensors = Json::parse(session_json(subject(), {}))["rig"]["sensors"];
  CHECK(sensors[0]["name"] == "Sx");
  CHECK(sensors[0]["x_m"] == 0.02);
  CHECK(sensors[0]["gap_range_m"] == Json::parse("[0.013, 0.025]"));
  CHECK(sensors[0]["signal_range_v"][0].get<double>() == Approx(1.0));
  CHECK(sensors[0]["signal_range_v"][1].get<double>() == Approx(3.0));
  CHECK(sensors[1]["gap_range_m"][1].is_null());
  CHECK(sensors[1]["signal_range_v"][0] == 0.0);  // no signal is below 0 V
}

TEST_CASE("A recording under way has name and start", "[web]") {
  const auto json = Json::parse(session_json(subject(), {.can_record = true,
                                                         .name = "a.csv",
                                                         .since_utc = "2026-11-21T07:00:00Z",
                                                         .latest = "a.csv"}));
  CHECK(json["recording"] ==
        Json::parse(R"({"name": "a.csv", "since_utc": "2026-11-21T07:00:00Z"})"));
  CHECK(json["download"] == "a.csv");
}

TEST_CASE("Names that are no UTF-8 are still JSON, on one line", "[web]") {
  LiveSubject odd = subject();
  odd.header->board = "a\xff\n</script>";
  const std::string text = session_json(odd, {});
  CHECK(text.find('\n') == std::string::npos);
  CHECK(Json::parse(text)["board"] == "a\xef\xbf\xbd\n</script>");
}

TEST_CASE("Before there is a board its rate is not known", "[web]") {
  LiveSubject waiting = subject();
  waiting.header.reset();
  const auto json = Json::parse(session_json(waiting, {}));
  for (const char* key : {"board", "firmware", "serial", "rate_hz", "reference_v"}) {
    CHECK(json[key].is_null());
  }
}

TEST_CASE("Before the first sample nothing is claimed", "[web]") {
  const auto json = Json::parse(state_json(subject(), {}, 0));
  CHECK(json["samples"] == 0);
  CHECK(json["rate_hz"].is_null());
  CHECK(json["sensors"].empty());
  CHECK(json["clock"].is_null());
  CHECK(json["ellipse"].is_null());
  CHECK(json["period_s"].is_null());
  CHECK(json["amplitude_rad"].is_null());
}

TEST_CASE("A state has counts, flags with their last moment, and each sensor's signal", "[web]") {
  LiveState state;
  Summary counts(Acquisition<double>{});
  counts.count(rest_sample(0));
  counts.count(rest_sample(1));
  counts.count(rest_sample(4));
  counts.count(Estimate<double>{.flags = flag::kSaturated});
  counts.count(Estimate<double>{.flags = flag::kSaturated | flag::kDropout});
  state.counts = counts;
  state.flag_latest_s[0] = 12.5;
  state.sample = Sample{.flags = flag::kSaturated};
  state.sample->readings[0] = {.on = 65535, .off = 13107};
  state.sample->readings[1] = {.on = 33099, .off = 0};
  const auto json = Json::parse(state_json(subject(), state, 7));
  CHECK(json["samples"] == 3);
  CHECK(json["lost"] == 2);
  CHECK(json["dropouts"] == 1);
  CHECK(json["restarts"] == 0);
  CHECK(json["rate_hz"].get<double>() == Approx(20.0));
  CHECK(json["flags"][0] == Json::parse(R"({"name": "saturated", "count": 2, "latest_s": 12.5})"));
  CHECK(json["sensors"][0]["ambient_v"].get<double>() == Approx(0.66));
  CHECK(json["sensors"][0]["signal_v"].get<double>() == Approx(2.64));
  CHECK(json["sensors"][0]["saturated"] == true);
  CHECK(json["sensors"][0]["out_of_range"] == false);
  CHECK(json["sensors"][1]["ambient_v"].is_null());
  CHECK(json["sensors"][1]["saturated"] == false);
  CHECK(json["recorded_samples"] == 7);
}

TEST_CASE("A swing's ellipse is told with its sense, null for a plane one", "[web]") {
  LiveState state{.swing = SwingNow{.period_s = 1.42,
                                    .amplitude_rad = 0.1,
                                    .ellipse = {.a_m = 0.05, .b_m = 0.02, .sense = 1}}};
  auto json = Json::parse(state_json(subject(), state, 0));
  CHECK(json["ellipse"]["sense"] == "left");
  CHECK(json["period_s"] == 1.42);
  state.swing->ellipse.sense = -1;
  CHECK(Json::parse(state_json(subject(), state, 0))["ellipse"]["sense"] == "right");
  state.swing->ellipse.sense = 0;
  CHECK(Json::parse(state_json(subject(), state, 0))["ellipse"]["sense"].is_null());
}

TEST_CASE("Notes are sentences", "[web]") {
  const auto text = [](std::string_view kind, RecordingEvent::Field field) {
    return note_text({.kind = std::string(kind), .fields = {std::move(field)}});
  };
  CHECK(text("connected", {"port", std::string("/dev/ttyACM0")}) ==
        "The board is connected (/dev/ttyACM0).");
  CHECK(text("disconnected", {"reason", std::string("unplugged")}) ==
        "The board went away: unplugged.");
  CHECK(text("trigger", {"edge", std::string("rising")}) == "The trigger input went rising.");
  CHECK(text("mark", {"text", std::string("<b>")}) == "<b>");
  const auto json = Json::parse(note_json({.kind = "boot", .utc_us = 0}, 1.5));
  CHECK(json == Json::parse(R"({"t_s": 1.5, "utc": "1970-01-01T00:00:00.000000Z", "kind": "boot",
                                "text": "The board has started anew."})"));
}

}  // namespace
