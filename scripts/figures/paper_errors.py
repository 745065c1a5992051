#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
# Errors of the paper's pipeline and of gn against the simulated truth (docs/paper.md).
"""Needs numpy and the program."""

import pathlib
import tempfile

import numpy as np

from program_runs import (angles, filter_section, interpolated_truth_at, replay, rig_file, rms,
                          simulate, truth_at)

CASES = (("case 1", ("--case", 1)),
         ("case 2, 2 rad/s", ("--case", 2, "--seconds", 10)),
         ("conical", ("--case", "conical")))


def error_deg(rows, truth):
    return rms(angles(rows) - truth_at(rows, truth))


def low(rows, truth):
    """How many per cent the angles are too small, by least squares."""
    true = truth_at(rows, truth)
    return 100 * (1 - np.sum(angles(rows) * true) / np.sum(true * true))


def gain_at(hz, order, cutoff=0.15, rate_hz=20):
    """Of fir1(order, cutoff): Hamming-windowed sinc, 1 at DC."""
    taps = np.arange(order + 1)
    b = np.sinc(cutoff * (taps - order / 2)) * np.hamming(order + 1)
    return abs(np.sum(b * np.exp(-2j * np.pi * hz / rate_hz * taps))) / np.sum(b)


def print_theory():
    hz = np.sqrt(9.8 / 0.3) / (2 * np.pi)
    for order in (15, 5):
        gain = gain_at(hz, order)
        delay_s = order / 2 / 20
        print(f"fir1({order}, 0.15) at {hz:.4f} Hz: gain {gain:.4f}, {100 * (1 - gain):.1f} % low,"
              f" {1e3 * delay_s:.0f} ms late, {360 * hz * delay_s:.0f} degrees of a period")


def print_estimators(folder):
    rig = rig_file(folder, "rig.toml")
    print("Perfect sensors, RMS error in degrees over both angles")
    for name, options in CASES:
        recording, truth = simulate(folder, rig, "--ideal", *options)
        printed = replay(recording, rig, "--estimator", "paper")
        aligned = replay(recording, rig, "--estimator", "paper", "--align")
        interpolated = rms(angles(aligned) - interpolated_truth_at(aligned, truth))
        print(f"  {name:15s} as printed {error_deg(printed, truth):6.3f}"
              f"   aligned {error_deg(aligned, truth):.3f} (truth interpolated {interpolated:.3f}),"
              f" {low(aligned, truth):.1f} % low"
              f"   gn {error_deg(replay(recording, rig), truth):.3f}")


def print_filters(folder):
    print("The same with other filters in the paper's pipeline")
    for words, section in (("order 5, sec. 5", filter_section(5, 0.15)),
                           ("no filter", filter_section(0, 1))):
        rig = rig_file(folder, "filter.toml", then=section)
        for name, options in CASES:
            recording, truth = simulate(folder, rig, "--ideal", *options)
            printed = replay(recording, rig, "--estimator", "paper")
            aligned = replay(recording, rig, "--estimator", "paper", "--align")
            print(f"  {words:15s} {name:15s} as printed {error_deg(printed, truth):6.3f}"
                  f"   aligned {error_deg(aligned, truth):.3f}, {low(aligned, truth):.1f} % low")


def print_noise(folder):
    rig = rig_file(folder, "rig.toml")
    print("The same with 50 um of gap noise, seed 1")
    for name, options in CASES:
        recording, truth = simulate(folder, rig, "--gap-noise", 50e-6, *options)
        aligned = replay(recording, rig, "--estimator", "paper", "--align")
        print(f"  {name:15s} aligned {error_deg(aligned, truth):.3f}"
              f"   gn {error_deg(replay(recording, rig), truth):.3f}")


def print_figures(folder):
    """What figures 12 and 15 show, as docs/paper.md puts it in words."""
    rig = rig_file(folder, "rig.toml")
    print("Measured with the same noise, mm: x and y in the first and the last period; z")
    for psi in (0, 2, 6):
        recording, truth = simulate(folder, rig, "--gap-noise", 50e-6, "--psi", psi)
        rows = replay(recording, rig, "--estimator", "paper", "--align")
        sides = []
        for axis in ("x_m", "y_m"):
            first, last = (1e3 * np.max(np.abs(truth[axis][part]))
                           for part in (slice(0, 45), slice(-45, None)))
            sides.append(f"{first:.1f} to {last:.1f}")
        true = truth[np.rint(rows["t_s"] * 40).astype(int)]
        depth = 1e3 * np.mean(true["z_m"] - rows["z_m"])
        ratio = np.ptp(rows["z_m"][:22]) / np.ptp(true["z_m"][:22])
        print(f"  {psi} rad/s: truth x {sides[0]}, y {sides[1]},"
              f" z over {1e3 * np.ptp(true['z_m'][:22]):.1f};"
              f" Appendix A's z {depth:.1f} below it and over {100 * ratio:.0f} % of that")


def main():
    print_theory()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        print_estimators(folder)
        print_filters(folder)
        print_noise(folder)
        print_figures(folder)


if __name__ == "__main__":
    main()
