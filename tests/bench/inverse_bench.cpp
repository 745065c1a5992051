// SPDX-License-Identifier: Apache-2.0
// The inverse against general solvers on the paper's six equations: time for a solve, wrong roots.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "tests/bench/known_tilts.hpp"
#include "tests/bench/solvers.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::bench {
namespace {

/// How a solver's answers stand to the true angles; whole turns do not count.
struct Verdict {
  int wrong_roots = 0;  ///< answers off by more than 1e-3 rad, or none
  test::Worst worst_rad;
};

template <class Scalar, class Solver>
Verdict judge(Solver& solver, const std::vector<KnownTilt<Scalar>>& tilts) {
  constexpr double kWrongRad = 1e-3;
  constexpr double kTurnRad = 2 * std::numbers::pi;
  Verdict verdict;
  for (const KnownTilt<Scalar>& tilt : tilts) {
    test::Worst error_rad;
    if (const auto answer = solver(tilt.gap_m)) {
      error_rad.note(std::remainder(answer->theta1_rad - tilt.truth.theta1_rad, kTurnRad));
      error_rad.note(std::remainder(answer->theta2_rad - tilt.truth.theta2_rad, kTurnRad));
    } else {
      error_rad.note(HUGE_VAL);
    }
    verdict.wrong_roots += error_rad.value() <= kWrongRad ? 0 : 1;
    verdict.worst_rad.note(error_rad.value());
  }
  return verdict;
}

/// Solves that know nothing of each other: the processor may begin one before the last has ended.
template <class Scalar, class Solver>
void solve_independently(Solver& solver, const std::vector<KnownTilt<Scalar>>& tilts) {
  for (const KnownTilt<Scalar>& tilt : tilts) {
    benchmark::DoNotOptimize(solver(tilt.gap_m));
  }
}

/// Each solve waits for the answer of the one before: the delay from gaps to angles.
template <class Scalar, class Solver>
void solve_in_turn(Solver& solver, const std::vector<KnownTilt<Scalar>>& tilts) {
  Scalar nothing = 0;
  for (const KnownTilt<Scalar>& tilt : tilts) {
    Gaps<Scalar> gap_m = tilt.gap_m;
    gap_m[0] += nothing;
    gap_m[1] += nothing;
    const auto answer = solver(gap_m);
    nothing = answer ? 0 * (answer->theta1_rad + answer->theta2_rad) : Scalar(0);
  }
  benchmark::DoNotOptimize(nothing);
}

/// Registers a solver: "name" for independent solves, "name/in_turn" for the delay of one.
template <class Scalar, class Solver>
void add(const std::string& name, Solver solver, std::size_t sensors = 2) {
  const SensorLayout<Scalar> layout = layout_with<Scalar>(sensors);
  const auto tilts = swing(layout);
  const Verdict in_swing = judge(solver, tilts);
  const auto range = whole_range(layout);
  const Verdict in_range = judge(solver, range);
  const auto run = [=](benchmark::State& state, auto pass) {
    Solver own = solver;
    for ([[maybe_unused]] auto _ : state) {
      pass(own, tilts);
    }
    state.counters = {
        {"s_per_solve", benchmark::Counter(static_cast<double>(tilts.size()),
                                           benchmark::Counter::kIsIterationInvariantRate |
                                               benchmark::Counter::kInvert)},
        {"samples", static_cast<double>(tilts.size())},
        {"wrong_roots", in_swing.wrong_roots},
        {"worst_rad", in_swing.worst_rad.value()},
        {"samples_in_range", static_cast<double>(range.size())},
        {"wrong_roots_in_range", in_range.wrong_roots},
        {"worst_in_range_rad", in_range.worst_rad.value()}};
  };
  benchmark::RegisterBenchmark(name.c_str(), [run](benchmark::State& state) {
    run(state, solve_independently<Scalar, Solver>);
  });
  benchmark::RegisterBenchmark((name + "/in_turn").c_str(), [run](benchmark::State& state) {
    run(state, solve_in_turn<Scalar, Solver>);
  });
}

template <class Scalar>
void add_ours(const std::string& scalar) {
  add<Scalar>("closed_form/" + scalar, ClosedFormSolver<Scalar>(layout_with<Scalar>(2)));
  for (const std::size_t sensors : {2U, 3U, 8U}) {
    add<Scalar>("gauss_newton_" + std::to_string(sensors) + "/" + scalar,
                GaussNewtonSolver<Scalar>(layout_with<Scalar>(sensors)), sensors);
  }
}

void add_peers() {
  add<double>("tiny_solver/from_zero", TinySolver(Start::kZero, Tolerance::kDefault));
  add<double>("tiny_solver/from_rest", TinySolver(Start::kRest, Tolerance::kDefault));
  add<double>("tiny_solver_tight/from_zero", TinySolver(Start::kZero, Tolerance::kTight));
  add<double>("tiny_solver_tight/from_rest", TinySolver(Start::kRest, Tolerance::kTight));
  add<double>("eigen_hybrid/from_zero", HybridSolver(Start::kZero));
  add<double>("eigen_hybrid/from_rest", HybridSolver(Start::kRest));
}

}  // namespace
}  // namespace penduline::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 2;
  }
  penduline::bench::add_ours<double>("double");
  penduline::bench::add_ours<float>("float");
  penduline::bench::add_peers();
  benchmark::RunSpecifiedBenchmarks();
}
