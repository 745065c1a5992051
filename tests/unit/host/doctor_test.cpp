// SPDX-License-Identifier: Apache-2.0
// What `penduline doctor` makes of samples.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <string>

#include "common/wire/text.hpp"
#include "host/doctor/board_checks.hpp"
#include "host/doctor/signal_checks.hpp"
#include "host/doctor/stream_checks.hpp"
#include "host/doctor/typed_commands.hpp"
#include "tests/unit/host/rig_text.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace penduline::test {
namespace {

/// One sensor's five seconds at 20 Hz: steady but for a noise of `noise_v` RMS.
SensorSurvey steady(double signal_v, double ambient_v, double noise_v = 1e-3) {
  SensorSurvey sensor;
  for (int i = 0; i < 100; ++i) {
    // A sequence that does not repeat, of mean 0 and RMS 1.
    const double unit = std::sqrt(12.0) * (std::fmod(i * 0.6180339887 + 0.25, 1.0) - 0.5);
    sensor.signal_v.push_back(signal_v + noise_v * unit);
    sensor.ambient_v.push_back(ambient_v + 1e-4 * unit);
  }
  return sensor;
}

Survey good_survey() {
  Survey survey{.acquisition = {.rate_hz = 20}, .samples = 100};
  survey.sensors[0] = steady(1.5, 0.1);
  survey.sensors[1] = steady(1.5, 0.1);
  return survey;
}

Finding about(const Findings& findings, const std::string& subject) {
  const auto found = std::ranges::find(findings, subject, &Finding::subject);
  REQUIRE(found != findings.end());
  return *found;
}

TEST_CASE("A board whose processor is busy for more than 90 % of the time is doubtful",
          "[doctor]") {
  const wire::Hello hello{.board = wire::text_of("pico")};
  const auto at = [&](std::uint16_t load_permille) {
    return check_health(hello, wire::Status{.load_permille = load_permille, .rate_millihz = 50000},
                        {.rig = "my.toml"});
  };
  CHECK(at(900).health == Health::kGood);
  CHECK(at(900).found ==
        "it has not failed since it was plugged in; its processor is busy 90 % of the time");
  CHECK(at(901).health == Health::kDoubtful);
  CHECK_THAT(at(901).found, Catch::EndsWith("its processor is busy 90.1 % of the time"));
  CHECK(at(901).advice ==
        "samples may come late: sample more slowly: 'penduline run auto --rig my.toml --rate 25'");
}

TEST_CASE("Nothing is said of a simulated board's load", "[doctor]") {
  const wire::Hello hello{.board = wire::text_of("sim")};
  const Finding health =
      check_health(hello, wire::Status{.load_permille = 1000, .temperature_cdeg = 2500}, {});
  CHECK(health.health == Health::kGood);
  CHECK(health.found == "it has not failed since it was plugged in; it has 25 degrees Celsius");
}

TEST_CASE("A good stream is good, in numbers", "[doctor]") {
  const Findings findings = check_stream(good_survey(), {});
  CHECK(about(findings, "rate").health == Health::kGood);
  CHECK(about(findings, "rate").found == "100 samples at 20 Hz, none lost, none late");
  CHECK(about(check_sensors(good_survey(), std::nullopt, {}), "saturation").found == "none");
}

TEST_CASE("A stream without samples is bad, and its sensors are not judged", "[doctor]") {
  const Survey none{.acquisition = {.rate_hz = 20}};
  CHECK(about(check_stream(none, {}), "rate").health == Health::kBad);
  CHECK(check_sensors(none, std::nullopt, {}).empty());
}

TEST_CASE("Lost and late samples, a wrong rate and complaints are doubtful", "[doctor]") {
  Survey survey = good_survey();
  survey.lost = 3;
  survey.late = 2;
  survey.complaints = {"port: 4 damaged frames"};
  CHECK(about(check_stream(survey, {}), "rate").found == "of 103 samples 3 lost, 2 late");
  CHECK(about(check_stream(survey, {}), "rate").health == Health::kDoubtful);
  CHECK(about(check_stream(survey, {}), "stream").found == "port: 4 damaged frames");
  survey.rate_complaint = "the samples come at 18 Hz";
  CHECK(about(check_stream(survey, {}), "rate").found == "the samples come at 18 Hz");
}

TEST_CASE("Some saturated samples are doubtful, more than 1 % are bad", "[doctor]") {
  Survey survey = good_survey();
  survey.samples = 1000;
  survey.saturated = 9;
  survey.sensors[1].saturated = 8;
  const auto saturation = [&] {
    return about(check_sensors(survey, std::nullopt, {}), "saturation");
  };
  CHECK(saturation().health == Health::kDoubtful);
  CHECK(saturation().found == "9 of 1000 samples reach the end of the ADC's range: sensor 2 in 8");
  survey.saturated = 10;
  CHECK(saturation().health == Health::kBad);
}

TEST_CASE("Ambient light is judged by its share of the ADC's range", "[doctor]") {
  const auto [ambient_v, health] =
      GENERATE(std::pair{0.6, Health::kGood},  // 18 % of 3.3 V
               std::pair{0.7, Health::kDoubtful}, std::pair{1.9, Health::kDoubtful},
               std::pair{2.0, Health::kBad});
  Survey survey = good_survey();
  survey.sensors[1] = steady(1.0, ambient_v);
  const Findings findings = check_sensors(survey, std::nullopt, {});
  CHECK(about(findings, "sensor 1 ambient light").health == Health::kGood);
  CHECK(about(findings, "sensor 2 ambient light").health == health);
}

TEST_CASE("Ambient light that is never measured is doubtful", "[doctor]") {
  Survey survey = good_survey();
  std::ranges::fill(survey.sensors[0].ambient_v, 0.0);
  CHECK(about(check_sensors(survey, std::nullopt, {}), "sensor 1 ambient light").found ==
        "not measured: the dark phase always reads 0");
}

TEST_CASE("No signal is bad, a weak one doubtful, and says what to look at", "[doctor]") {
  Survey survey = good_survey();
  survey.sensors[0] = steady(0.005, 0.1);
  survey.sensors[1] = steady(0.05, 0.1);
  const Findings findings = check_sensors(survey, std::nullopt, {});
  CHECK(about(findings, "sensor 1 signal").health == Health::kBad);
  CHECK(about(findings, "sensor 1 signal").advice.find("phone's camera") != std::string::npos);
  CHECK(about(findings, "sensor 2 signal").health == Health::kDoubtful);
}

TEST_CASE("A sensor of which every sample is saturated has no signal", "[doctor]") {
  Survey survey = good_survey();
  survey.sensors[0].signal_v.clear();
  CHECK(about(check_sensors(survey, std::nullopt, {}), "sensor 1 signal").found ==
        "no reading without saturation");
}

/// Lets a sensor's signal go up and down with 1.3 Hz.
void swing(SensorSurvey& sensor, double amplitude_v) {
  for (std::size_t i = 0; i < sensor.signal_v.size(); ++i) {
    sensor.signal_v[i] += amplitude_v * std::sin(0.4 * static_cast<double>(i));
  }
}

bool has(const Findings& findings, const std::string& subject) {
  return std::ranges::find(findings, subject, &Finding::subject) != findings.end();
}

TEST_CASE("Noise is told in volts; where one sensor sees motion, of none", "[doctor]") {
  Survey survey = good_survey();
  const Findings still = check_sensors(survey, std::nullopt, {});
  CHECK(about(still, "pendulum").found ==
        "hangs still: no sensor sees it move by 0.5 % of its signal");
  CHECK(about(still, "sensor 1 noise").found == "1.00 mV RMS from sample to sample");
  swing(survey.sensors[1], 0.1);
  const Findings moving = check_sensors(survey, std::nullopt, {});
  CHECK(about(moving, "pendulum").health == Health::kDoubtful);
  CHECK(about(moving, "pendulum").found ==
        "it is not at rest: sensor 2 sees it swing by 4.57 % of its signal RMS at 1.30 Hz, so "
        "neither its zero nor its noise can be judged");
  CHECK_THAT(about(moving, "pendulum").advice, Catch::Contains("'penduline doctor auto'"));
  CHECK_FALSE(has(moving, "sensor 1 noise"));
  CHECK_FALSE(has(moving, "sensor 2 noise"));
}

TEST_CASE("Whether it hangs still is one verdict, with little noise and with some", "[doctor]") {
  const RigFile rig = parse_rig(std::string(kRigText), "rig.toml").value();
  const double rms_deg = GENERATE(0.05, 0.2);
  const double noise_deg = GENERATE(0.001, 0.1);
  const double v_per_deg = 0.02 * 0.01745329 / 0.006;
  Survey survey = good_survey();
  survey.sensors[0] = steady(1.8333, 0.1, noise_deg * v_per_deg);
  survey.sensors[1] = steady(1.8333, 0.1, noise_deg * v_per_deg);
  swing(survey.sensors[0], rms_deg * std::sqrt(2) * v_per_deg);
  const Findings findings = check_sensors(survey, rig, {.rig = "rig.toml"});
  const bool still = rms_deg < 0.1;
  CHECK(about(findings, "pendulum").health == (still ? Health::kGood : Health::kDoubtful));
  CHECK(has(findings, "sensor Sx noise") == still);
  CHECK((about(findings, "sensor Sx gap").found.find("zero") != std::string::npos) == still);
  CHECK((about(findings, "sensor Sy gap").found.find("zero") != std::string::npos) == still);
}

TEST_CASE("Where noise may hide motion, the noise is doubtful and the zero not judged",
          "[doctor]") {
  const RigFile rig = parse_rig(std::string(kRigText), "rig.toml").value();
  const double v_per_deg = 0.02 * 0.01745329 / 0.006;
  Survey survey = good_survey();
  // Of 100 samples, noise of 0.2 deg hides 0.16 deg; sensor Sx is off by 1 deg.
  survey.sensors[0] = steady(1.8333 + v_per_deg, 0.1, 0.05 * v_per_deg);
  survey.sensors[1] = steady(1.8333, 0.1, 0.2 * v_per_deg);
  const Findings findings = check_sensors(survey, rig, {.rig = "my.toml"});
  const Finding pendulum = about(findings, "pendulum");
  CHECK(pendulum.health == Health::kDoubtful);
  CHECK_THAT(pendulum.found,
             Catch::StartsWith("whether it hangs still is hidden by noise: sensor Sy has 0.20 deg "
                               "RMS from sample to sample, behind which it may move by 0.16; "));
  CHECK(pendulum.advice ==
        "look for loose wires, a lamp that flickers and a noisy supply; or look for longer: "
        "'penduline doctor auto --rig my.toml --seconds 16'");
  CHECK(about(findings, "sensor Sx gap").health == Health::kGood);
  CHECK_THAT(about(findings, "sensor Sx gap").found, !Catch::Contains("zero"));
  CHECK(about(findings, "sensor Sy noise").health == Health::kDoubtful);
  CHECK(about(findings, "sensor Sy noise").advice ==
        "look for loose wires, a lamp that flickers and a noisy supply");
}

TEST_CASE("A sensor without signal does not hide whether the others hang still", "[doctor]") {
  Survey survey = good_survey();
  survey.sensors[0] = steady(0.005, 0.1);
  CHECK(about(check_sensors(survey, std::nullopt, {}), "pendulum").health == Health::kGood);
}

TEST_CASE("A pendulum that turns slowly is not at rest", "[doctor]") {
  const RigFile rig = parse_rig(std::string(kRigText), "rig.toml").value();
  Survey survey = good_survey();
  for (std::size_t i = 0; i < 100; ++i) {  // 0.2 deg in five seconds
    survey.sensors[1].signal_v[i] += 0.2 * 0.0582 * 1.5 * static_cast<double>(i) / 100;
  }
  const Findings findings = check_sensors(survey, rig, {});
  CHECK_THAT(about(findings, "pendulum").found,
             Catch::Contains("sensor Sy sees it turn or drift by 0.20 deg"));
}

TEST_CASE("Of a few samples neither rest nor noise is told, but what to do", "[doctor]") {
  Survey survey = good_survey();
  survey.acquisition.rate_hz = 1;
  survey.samples = 5;
  for (SensorSurvey& sensor : survey.sensors) {
    sensor.signal_v.resize(std::min<std::size_t>(sensor.signal_v.size(), 5));
  }
  const Findings findings = check_sensors(survey, std::nullopt, {});
  CHECK(about(findings, "pendulum").health == Health::kDoubtful);
  CHECK_THAT(about(findings, "pendulum").found, Catch::StartsWith("found 5 unsaturated samples"));
  CHECK(about(findings, "pendulum").advice ==
        "look for longer while it hangs still: 'penduline doctor auto --seconds 40'");
  CHECK_FALSE(has(findings, "sensor 1 noise"));
}

TEST_CASE("A sensor that always reads the same is doubtful, and says how to find out", "[doctor]") {
  Survey survey = good_survey();
  std::ranges::fill(survey.sensors[0].signal_v, 1.5);
  const Finding noise = about(check_sensors(survey, std::nullopt, {}), "sensor 1 noise");
  CHECK(noise.health == Health::kDoubtful);
  CHECK(noise.found == "it reads 1.5000 V in each of 100 samples");
  CHECK_THAT(noise.advice, Catch::StartsWith("tilt the pendulum by hand"));
}

TEST_CASE("Noise that means no gap says what to do first", "[doctor]") {
  RigFile rig = parse_rig(std::string(kRigText), "rig.toml").value();
  // A peak at 2 V, above which the square root has no value.
  rig.rig.responses[0].model =
      InverseSquareResponse<double>{.a_v_m2 = 1e-4, .b_m = 0.001, .c_v = 2};
  rig.rig.noise[0] = {};
  Survey survey = good_survey();
  const Finding noise = about(check_sensors(survey, rig, {}), "sensor Sx noise");
  CHECK(noise.health == Health::kDoubtful);
  CHECK_THAT(noise.found, Catch::Contains("does not say which gap 1.500 V is"));
  CHECK_FALSE(noise.advice.empty());
  CHECK(about(check_sensors(survey, rig, {}), "sensor Sx gap").health == Health::kBad);
}

TEST_CASE("A sensor on the axis is told to be moved, and its noise is judged", "[doctor]") {
  RigFile rig = parse_rig(std::string(kRigText), "rig.toml").value();
  rig.rig.layout.position_m[1] = {0, 0, 0};
  const Findings findings = check_sensors(good_survey(), rig, {.rig = "my.toml"});
  CHECK(about(findings, "pendulum").health == Health::kGood);
  const Finding gap = about(findings, "sensor Sy gap");
  CHECK(gap.health == Health::kDoubtful);
  CHECK_THAT(gap.found, Catch::EndsWith("by the rig it is 0.0 mm from the axis, where a tilt does "
                                        "not change the gap"));
  CHECK_THAT(gap.advice, Catch::EndsWith("else correct its position_m in my.toml"));
}

TEST_CASE("Advice names commands as they are typed, with the user's names", "[doctor]") {
  const TypedNames names{.source = "serial:/dev/ttyACM0", .rig = "my rig.toml"};
  CHECK(names.run("--rate 10") ==
        "'penduline run serial:/dev/ttyACM0 --rig \"my rig.toml\" --rate 10'");
  CHECK(TypedNames{}.again() == "'penduline doctor auto'");
  CHECK(TypedNames{.seconds = 60}.again() == "'penduline doctor auto --seconds 60'");
  const TemporaryFolder folder;
  CHECK(TypedNames{.source = "file:rec.csv", .recorded = true, .folder = folder.path()}.again() ==
        "'penduline run auto --rig rig.toml --record still.csv -o /dev/null' for 10 s (Ctrl-C ends "
        "it), then 'penduline doctor file:still.csv'");
  CHECK_THAT(TypedNames{.recorded = true}.again_for(40),
             Catch::Contains("' for 40 s (Ctrl-C ends it)") && Catch::EndsWith(" --seconds 40'"));
  CHECK(TypedNames{.rig = "a.toml", .folder = folder.path()}.calibrate("rest", "20 s") ==
        "'penduline run auto --rig a.toml --record still.csv -o /dev/null' for 20 s (Ctrl-C ends "
        "it), then 'penduline calibrate rest still.csv --rig a.toml -o new.toml'");
  Survey survey = good_survey();
  survey.late = 1;
  CHECK_THAT(about(check_stream(survey, names), "rate").advice, Catch::Contains("--rate 10'"));
  std::ranges::fill(survey.sensors[0].ambient_v, 0.0);
  CHECK_THAT(about(check_sensors(survey, std::nullopt, names), "sensor 1 ambient light").advice,
             Catch::EndsWith("toml\" --emitter switched'"));
}

TEST_CASE("What advised commands write has a name that no file has yet", "[doctor]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path("still.csv")) << "old";
  const TypedNames names{.rig = "a.toml", .recorded = true, .folder = folder.path()};
  CHECK(names.calibrate("rest", "20 s") ==
        "'penduline run auto --rig a.toml --record still-2.csv -o /dev/null' for 20 s (Ctrl-C ends "
        "it), then 'penduline calibrate rest still-2.csv --rig a.toml -o new.toml'");
  std::ofstream(folder.path("still-2.csv")) << "old, too";
  CHECK(names.again() ==
        "'penduline run auto --rig a.toml --record still-3.csv -o /dev/null' for 10 s (Ctrl-C ends "
        "it), then 'penduline doctor file:still-3.csv --rig a.toml'");
  CHECK_THAT(names.calibrate("swing", "60 s"), Catch::Contains("calibrate swing swing.csv"));
  std::ofstream(folder.path("new.toml")) << "that of the last calibration";
  CHECK_THAT(names.calibrate("rest", "20 s"), Catch::EndsWith("--rig a.toml -o new-2.toml'"));
}

TEST_CASE("With a rig, a still pendulum's zero and noise are held against it", "[doctor]") {
  const RigFile rig = parse_rig(std::string(kRigText), "rig.toml").value();
  const Response<double>& response = rig.rig.responses[0];
  const double rest_v =
      response.volts(DiscPlane<double>(Slopes<double>{}).gap_m(rig.rig.layout, 0));
  const double arm_m = rig.rig.layout.position_m[0].head<2>().norm();
  const double v_per_deg = arm_m * 0.01745329 / response.slope_m_per_v(rest_v);
  Survey survey = good_survey();
  const auto of_first = [&](double signal_v, double noise_v) {
    survey.sensors[0] = steady(signal_v, 0.1, noise_v);
    survey.sensors[1] = survey.sensors[0];
    return check_sensors(survey, rig, {});
  };
  const std::string gap = "sensor " + rig.sensor_names[0] + " gap";
  const std::string noise = "sensor " + rig.sensor_names[0] + " noise";
  const double told_v =
      std::hypot(rig.rig.noise[0].volts, rig.rig.noise[0].gap_m / response.slope_m_per_v(rest_v));

  CHECK(about(of_first(rest_v, told_v), gap).health == Health::kGood);
  CHECK(about(of_first(rest_v, told_v), noise).health == Health::kGood);
  CHECK(about(of_first(rest_v + 0.5 * v_per_deg, told_v), gap).health == Health::kDoubtful);
  CHECK(about(of_first(rest_v, 3 * told_v), noise).health == Health::kDoubtful);
}

TEST_CASE("A zero that is off by more than 5 deg is not to be zeroed", "[doctor]") {
  const RigFile rig = parse_rig(std::string(kRigText), "rig.toml").value();
  const double v_per_deg = 0.02 * 0.01745329 / 0.006;
  const auto [off_deg, gross] = GENERATE(std::pair{4.9, false}, std::pair{5.1, true},
                                         std::pair{-4.9, false}, std::pair{-15.0, true});
  Survey survey = good_survey();
  // The linear response falls: more signal, less gap. Sensor Sy is off by 1 deg and noisy.
  survey.sensors[0] = steady(11.0 / 6 - off_deg * v_per_deg, 0.1);
  survey.sensors[1] = steady(11.0 / 6 - 1 * v_per_deg, 0.1, 0.1 * v_per_deg);
  const Findings findings = check_sensors(survey, rig, {.rig = "my.toml"});
  const Finding gap = about(findings, "sensor Sx gap");
  CHECK(gap.health == Health::kDoubtful);
  CHECK_THAT(gap.found, Catch::EndsWith(fmt::format("off by {:.2f} deg", off_deg)));
  CHECK(gap.advice.starts_with("that is more than a zero drifts: is this the rig file of this") ==
        gross);
  const std::string calibrate = "penduline calibrate rest";
  CHECK((gap.advice.find(calibrate) == std::string::npos) == gross);
  const Finding other = about(findings, "sensor Sy gap");
  CHECK((other.advice == "see first to the sensor whose zero is off by much more") == gross);
  const Finding noise = about(findings, "sensor Sy noise");
  CHECK(noise.health == Health::kDoubtful);
  CHECK((noise.advice.find(calibrate) == std::string::npos) == gross);
}

TEST_CASE("A signal that the rig's response does not have is bad", "[doctor]") {
  RigFile rig = parse_rig(std::string(kRigText), "rig.toml").value();
  rig.rig.responses[0].nearest_m = 0.015;
  Survey survey = good_survey();
  survey.sensors[0] = steady(2.9, 0.1);  // 13.6 mm
  CHECK(about(check_sensors(survey, rig, {}), "sensor " + rig.sensor_names[0] + " gap").health ==
        Health::kBad);
}

TEST_CASE("A rig of another number of sensors is bad, and the light is judged all the same",
          "[doctor]") {
  RigFile rig = parse_rig(std::string(kRigText), "rig.toml").value();
  Survey survey = good_survey();
  survey.acquisition.sensor_count = 3;
  survey.sensors[2] = steady(1.5, 0.1);
  const Findings findings = check_sensors(survey, rig, {});
  CHECK(about(findings, "rig").found == "the rig has 2 sensors, the samples have 3");
  CHECK(about(findings, "sensor 3 signal").health == Health::kGood);
}

}  // namespace
}  // namespace penduline::test
