#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Prints what scripts/bench measured, as ratios and against the bars: summary.py FOLDER."""
import json
import os
import sys

OURS = "gauss_newton_2/double"
IN_TURN = "/in_turn"
NANO = 1e9


def aggregates(path, kind):
    """One aggregate of all benchmarks in a file of Google Benchmark, in the order of the source."""
    with open(path) as file:
        runs = json.load(file)["benchmarks"]
    runs.sort(key=lambda run: (run["family_index"], run["per_family_instance_index"]))
    return {run["run_name"]: run for run in runs if run["aggregate_name"] == kind}


def lines(path):
    with open(path) as file:
        return {row["name"]: row for row in map(json.loads, file)}


def times(value):
    return f"{value:,.1f}" if value < 100 else f"{value:,.0f}"


def print_table(title, head, rows):
    """The first column to the left, the others to the right, each as wide as it must be."""
    widths = [max(map(len, column)) for column in zip(head, *rows)]
    print(f"\n{title}")
    for row in [head, *rows]:
        cells = [cell.rjust(width) for cell, width in zip(row, widths)]
        print("  " + "  ".join([row[0].ljust(widths[0])] + cells[1:]))


def print_inverse(solvers):
    ours, ours_in_turn = (solvers[name]["s_per_solve"] for name in (OURS, OURS + IN_TURN))
    rows = []
    for name, run in solvers.items():
        if name.endswith(IN_TURN):
            continue
        # An interpreter begins nothing before the last solve has ended.
        in_turn = solvers.get(name + IN_TURN, run)["s_per_solve"]
        in_range = run.get("wrong_roots_in_range")
        rows.append([
            name,
            times(run["s_per_solve"] / ours),
            times(in_turn / ours_in_turn),
            f"{run['s_per_solve'] * NANO:,.0f}",
            f"{in_turn * NANO:,.0f}",
            f"{run['wrong_roots']:.0f}",
            "-" if in_range is None else f"{in_range:,.0f}",
            f"{run['worst_rad']:.0e}",
        ])
    print_table(
        f"Inverse: a solve's time, as a multiple of {OURS} and in ns; wrong roots of "
        f"{solvers[OURS]['samples']:,.0f} in a swing\nand of "
        f"{solvers[OURS]['samples_in_range']:,.0f} over the whole range",
        ["solver", "times", "in turn", "ns", "in turn", "wrong", "in range", "worst rad"], rows)


def print_fir(filters):
    print_table(
        "FIR: a sample's time, as a multiple of our float filter of as many taps and in ns",
        ["filter/taps", "times", "ns", "worst error"],
        [[name,
          times(run["s_per_sample"] / filters[f"ours/float/{name.split('/')[-1]}"]["s_per_sample"]),
          f"{run['s_per_sample'] * NANO:.1f}", f"{run['worst_error']:.0e}"]
         for name, run in filters.items()])


def print_replay(parts, replays):
    print_table(
        "Pipeline and the parts of a replay: a row's time in ns", ["part", "ns"],
        [[name, f"{run['s_per_row'] * NANO:.0f}"] for name, run in parts.items()])
    print_table(
        "Replay, CSV in, CSV out: million samples for a second of the core and of the clock",
        ["rows/output", "core", "clock", "peak MiB"],
        [[name, f"{run['samples_per_core_s'] / 1e6:.2f}", f"{run['samples_per_clock_s'] / 1e6:.2f}",
          f"{run['peak_kib'] / 1024:.1f}"] for name, run in replays.items()])


def print_live(runs):
    print_table(
        "Live, over pseudo-terminals: from a window's end to its row, in ms; a run's share of a core",
        ["boards and rate", "median", "99 %", "worst", "share", "samples", "lost"],
        [[name, *(f"{run[key] * 1e3:.2f}" for key in ("p50_s", "p99_s", "worst_s")),
          f"{run['core_share'] / run['rigs']:.2%}", f"{run['samples']:,}",
          f"{run['lost'] + run['rows_missing']:,}"] for name, run in runs.items()])


def print_viewers(runs):
    print_table(
        "Live page: a run's share of a core, all included; what a viewer gets",
        ["rate, viewers", "share", "kB/s each"],
        [[name, f"{run['core_share']:.2%}",
          f"{run['bytes_per_viewer_s'] / 1e3:.1f}" if run["viewers"] else "-"]
         for name, run in runs.items()])


def print_bars(solvers, parts, replays, watched):
    def ratio_to(name, mode=""):
        return solvers[name + mode]["s_per_solve"] / solvers[OURS + mode]["s_per_solve"]

    tiny_solvers = [name for name in solvers
                    if name.startswith("tiny_solver") and not name.endswith(IN_TURN)]
    tiny = min(map(ratio_to, tiny_solvers))
    tiny_in_turn = min(ratio_to(name, IN_TURN) for name in tiny_solvers)
    wrong = sum(run["wrong_roots"] + run["wrong_roots_in_range"]
                for name, run in solvers.items() if name.startswith("gauss_newton"))
    rate = min(run["samples_per_core_s"] for name, run in replays.items()
               if name.startswith("1000000/"))
    step_s = max(run["s_per_row"] for name, run in parts.items() if name.startswith("ekf/"))
    peaks = [run["peak_kib"] / 1024 for run in replays.values()]
    ten_viewers = watched["20 Hz, 10 viewers"]["core_share"]
    scipy, octave = (ratio_to(f"{peer}_fsolve/from_zero") for peer in ("scipy", "octave"))
    bars = [
        ("Gauss-Newton against the fastest TinySolver", times(tiny), "10", tiny >= 10),
        ("the same, each solve waiting for the last", times(tiny_in_turn), "-", None),
        ("against SciPy's fsolve as in Appendix A", times(scipy), "1,000", scipy >= 1000),
        ("against Octave's fsolve as in Appendix A", times(octave), "10,000", octave >= 10000),
        ("wrong roots of Gauss-Newton, swing and range", f"{wrong:.0f}", "0", wrong == 0),
        ("a step of ekf, us", f"{step_s * 1e6:.2f}", "2", step_s < 2e-6),
        ("replay of a million rows, million samples/s", f"{rate / 1e6:.2f}", "1", rate >= 1e6),
        ("replay's peak memory, MiB, least and greatest", f"{min(peaks):.1f}-{max(peaks):.1f}",
         "alike", max(peaks) < 1.1 * min(peaks)),
        ("a run at 20 Hz with 10 viewers, share of a core", f"{ten_viewers:.2%}", "5%",
         ten_viewers < 0.05),
    ]
    print_table("Bars", ["", "measured", "bar", ""],
                [[what, measured, bar, {True: "holds", False: "MISSED", None: ""}[held]]
                 for what, measured, bar, held in bars])


def main():
    def path(name):
        return os.path.join(sys.argv[1], name)

    def medians(name):
        return aggregates(path(name), "median")

    def spreads(name):
        return [run["cpu_time"] for run in aggregates(path(name), "cv").values()]

    solvers = medians("inverse.json") | lines(path("fsolve.jsonl"))
    replays = lines(path("replay.jsonl"))
    print_inverse(solvers)
    print_fir(medians("fir.json"))
    parts = medians("pipeline.json")
    print_replay(parts, replays)
    print_live(lines(path("live.jsonl")))
    watched = lines(path("viewers.jsonl"))
    print_viewers(watched)
    spread = sorted(spreads("inverse.json") + spreads("fir.json") + spreads("pipeline.json"))
    print(f"\nSpread of the repetitions: {spread[len(spread) // 2]:.1%} in the middle, "
          f"{spread[-1]:.1%} at worst")
    print_bars(solvers, parts, replays, watched)


if __name__ == "__main__":
    main()
