// SPDX-License-Identifier: Apache-2.0
// Tests of Ctrl-C: one ends a session cleanly, the next gets through, afterwards all is as before.
#include "host/session/stop_signal.hpp"

#include <pthread.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <thread>

#include "host/session/session.hpp"
#include "tests/unit/hal/simulated_rigs.hpp"
#include "tests/unit/host/scripted_source.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;
using namespace std::chrono_literals;

using Clock = std::chrono::steady_clock;

/// What a signal does.
class Disposition {
 public:
  explicit Disposition(int signal) : signal_(signal) { sigaction(signal_, nullptr, &action_); }
  void restore() const { sigaction(signal_, &action_, nullptr); }
  [[nodiscard]] auto handler() const { return action_.sa_handler; }

 private:
  int signal_;
  struct sigaction action_ {};
};

/// The signals end the program, as at its start; Catch2 has set handlers of its own.
class AtStart {
 public:
  AtStart() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGHUP, SIG_DFL);
  }
  AtStart(const AtStart&) = delete;
  AtStart& operator=(const AtStart&) = delete;
  ~AtStart() {
    interrupt_.restore();
    terminate_.restore();
    hang_up_.restore();
  }

 private:
  Disposition interrupt_{SIGINT};
  Disposition terminate_{SIGTERM};
  Disposition hang_up_{SIGHUP};
};

/// Whether a signal would end the program.
bool ends_program(int signal) {
  return Disposition(signal).handler() == SIG_DFL;
}

/// Runs a source; returns how many estimates came out of it.
std::size_t estimates_of(ScriptedSource& source, const StopSignal& stop, bool paced = false,
                         EstimatorKind kind = EstimatorKind::kGaussNewton) {
  const auto estimator = make_estimator({.kind = kind}, paper_rig(), {}).value();
  KeepingSink sink;
  const SessionResult result = run_session({.source = source,
                                            .estimator = *estimator,
                                            .output = sink,
                                            .recorder = {},
                                            .warn = [](const std::string&) {}},
                                           {.paced = paced}, stop);
  CHECK_FALSE(result.error);
  return sink.estimates.size();
}

TEST_CASE("Nothing is requested at first", "[stop]") {
  CHECK_FALSE(StopSignal().requested());
}

TEST_CASE_METHOD(AtStart, "SIGINT, SIGTERM and SIGHUP are requests to stop", "[stop]") {
  const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
  const StopSignal stop;
  std::raise(signal);
  CHECK(stop.requested());
}

TEST_CASE_METHOD(AtStart, "After the first signal the next one of its kind ends the program",
                 "[stop]") {
  const StopSignal stop;
  CHECK_FALSE(ends_program(SIGINT));
  std::raise(SIGINT);
  CHECK(ends_program(SIGINT));
  CHECK_FALSE(ends_program(SIGTERM));
}

TEST_CASE_METHOD(AtStart, "Afterwards the signals end the program again", "[stop]") {
  { const StopSignal stop; }
  CHECK(ends_program(SIGINT));
  CHECK(ends_program(SIGTERM));
  CHECK(ends_program(SIGHUP));
}

TEST_CASE_METHOD(AtStart, "A signal that the program was started to ignore stays ignored",
                 "[stop]") {
  // As under nohup and for a shell's background jobs.
  std::signal(SIGINT, SIG_IGN);
  {
    const StopSignal stop;
    std::raise(SIGINT);
    CHECK_FALSE(stop.requested());
  }
  CHECK(Disposition(SIGINT).handler() == SIG_IGN);
}

TEST_CASE_METHOD(AtStart, "An earlier request does not count for the next session", "[stop]") {
  {
    const StopSignal stop;
    std::raise(SIGINT);
  }
  CHECK_FALSE(StopSignal().requested());
}

TEST_CASE("Sleeping until a moment that has passed returns at once", "[stop]") {
  const auto start = Clock::now();
  StopSignal().sleep_until(start - 1h);
  CHECK(Clock::now() - start < 1s);
}

TEST_CASE("Sleeping lasts until its moment", "[stop]") {
  const auto moment = Clock::now() + 30ms;
  StopSignal().sleep_until(moment);
  CHECK(Clock::now() >= moment);
}

TEST_CASE_METHOD(AtStart, "A request while reading ends the session after that sample", "[stop]") {
  ScriptedSource source(rest_samples(50));
  source.on_read = [](std::size_t count) {
    if (count == 9) {
      std::raise(SIGINT);
    }
  };
  CHECK(estimates_of(source, StopSignal()) == 10);
}

TEST_CASE_METHOD(AtStart, "A request ends an offline estimator with all its rows", "[stop]") {
  ScriptedSource source(rest_samples(50));
  source.on_read = [](std::size_t count) {
    if (count == 39) {
      std::raise(SIGTERM);
    }
  };
  CHECK(estimates_of(source, StopSignal(), false, EstimatorKind::kPaper) == 40);
}

TEST_CASE_METHOD(AtStart, "A request before the start makes an empty session", "[stop]") {
  ScriptedSource source(rest_samples(50));
  const StopSignal stop;
  std::raise(SIGINT);
  CHECK(estimates_of(source, stop) == 0);
}

TEST_CASE("A paced session takes as long as its samples' times", "[stop]") {
  ScriptedSource source(rest_samples(4));
  const auto start = Clock::now();
  CHECK(estimates_of(source, StopSignal(), true) == 4);
  CHECK(Clock::now() - start >= 150ms);
}

TEST_CASE("A paced session starts at its first sample's time and again at a step back", "[stop]") {
  std::vector<Sample> samples = {rest_sample(100'000), rest_sample(100'001), rest_sample(0),
                                 rest_sample(1)};
  ScriptedSource source(samples);
  const auto start = Clock::now();
  CHECK(estimates_of(source, StopSignal(), true) == 4);
  const auto taken = Clock::now() - start;
  CHECK(taken >= 100ms);
  CHECK(taken < 30s);
}

TEST_CASE_METHOD(AtStart, "A request ends a session that waits for a sample's time", "[stop]") {
  ScriptedSource source({rest_sample(0), rest_sample(100'000'000)});
  const StopSignal stop;
  std::thread user([session = pthread_self()] {
    std::this_thread::sleep_for(100ms);
    pthread_kill(session, SIGINT);
  });
  const std::size_t count = estimates_of(source, stop, true);
  user.join();
  CHECK(count == 1);
}

}  // namespace
