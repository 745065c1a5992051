#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
# What the paper's contradictions cost, in degrees (docs/paper.md, the table).
"""Needs numpy and the program."""

import pathlib
import tempfile
import tomllib

import numpy as np

from program_runs import (ROOT, angles, filter_section, replay, rig_file, rms, simulate,
                          truth_at)

CASES = (("case 1", ("--case", 1)), ("conical", ("--case", "conical")))
LENGTH_M = 0.3
TILT = np.radians(10)


def print_disc_offset(folder):
    print("Row 1, no filter, lp taken for 0.03 m where it is 0.02 m")
    for name, options in CASES:
        recording, truth = simulate(folder, rig_file(folder, "rig.toml"), "--ideal", *options)
        for offset in ("0.02", "0.03"):
            rig = rig_file(folder, "offset.toml", ("offset_m = 0.02", f"offset_m = {offset}"),
                           then=filter_section(0, 1))
            rows = replay(recording, rig, "--estimator", "paper")
            errors = angles(rows) - truth_at(rows, truth)
            print(f"  {name:8s} lp {offset}: {rms(errors):.3f} RMS,"
                  f" {np.max(np.abs(errors)):.2f} at worst")


def turn_x(angle):
    sine, cosine = np.sin(angle), np.cos(angle)
    return np.array([[1, 0, 0], [0, cosine, -sine], [0, sine, cosine]])


def turn_y(angle):
    sine, cosine = np.sin(angle), np.cos(angle)
    return np.array([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])


def print_positions():
    """Over every azimuth, against the rod that has the angles."""
    down = np.array([0, 0, -1])
    misses = {"row 3, Eqs. 25 and 26": [], "row 4, Appendix A": [], "row 10, fixed axes": []}
    for azimuth in np.radians(np.arange(360)):
        rod = np.array([np.sin(TILT) * np.cos(azimuth), np.sin(TILT) * np.sin(azimuth),
                        -np.cos(TILT)])
        theta1, theta2 = np.arctan2(rod[1], -rod[2]), -np.arcsin(rod[0])
        assert np.allclose(turn_x(theta1) @ turn_y(theta2) @ down, rod)
        height = -np.cos(theta1) * np.cos(theta2)
        others = (np.array([np.sin(theta1), np.sin(theta2), height]),
                  np.array([-np.sin(theta2), np.sin(theta1), height]),
                  turn_y(theta2) @ turn_x(theta1) @ down)
        for miss, other in zip(misses.values(), others):
            miss.append(np.linalg.norm(other - rod))
    print("Where the mass comes out at a tilt of 10 deg, at worst over all directions")
    for words, miss in misses.items():
        print(f"  {words:22s} {1e3 * LENGTH_M * max(miss):6.2f} mm off,"
              f" {np.degrees(2 * np.arcsin(max(miss) / 2)):5.2f} deg")


def straight_lines(table_rig, recording, truth):
    """The [[sensor]] responses that fit gap over volts best as lines, in the swing itself."""
    sensors = tomllib.loads(table_rig.read_text())["sensor"]
    counts = np.genfromtxt(recording, delimiter=",", names=True, skip_header=sum(
        line.startswith("#") for line in recording.read_text().splitlines()))
    true = truth[::2][:len(counts)]
    a = -np.tan(true["theta2_rad"]) / np.cos(true["theta1_rad"])
    b = np.tan(true["theta1_rad"])
    lines = []
    for sensor, name in zip(sensors, ("x", "y")):
        x, y, face_m = sensor["position_m"]
        gap_m = face_m - (a * x + b * y - 0.02 * np.sqrt(1 + a**2 + b**2))
        volts = (counts[name + "_on"] - counts[name + "_off"]) / 65535 * 3.3
        slope, at_zero = np.polyfit(volts, gap_m, 1)
        lines.append((sensor["position_m"], at_zero, slope))
    return lines


def print_curve(folder):
    print("Row 7, TCRT5000 sensors read by their best straight lines, delay taken out")
    table_rig = ROOT / "docs/rigs/tcrt5000.toml"
    for name, options in CASES:
        recording, truth = simulate(folder, table_rig, "--ideal", *options)
        lines = straight_lines(table_rig, recording, truth)
        head = rig_file(folder, "line.toml").read_text().split("[[sensor]]")[0]
        body = "".join(f"[[sensor]]\nposition_m = {list(position)}\nresponse = {{"
                       f' model = "linear", gap_at_zero_m = {at_zero}, slope_m_per_v = {slope} }}\n'
                       for position, at_zero, slope in lines)
        words = []
        for filter_words, section in (("as printed", ""), ("no filter", filter_section(0, 1))):
            line_rig = folder / "line.toml"
            line_rig.write_text(head + body + section)
            rows = replay(recording, line_rig, "--estimator", "paper", "--align")
            words.append(f"paper, {filter_words} {rms(angles(rows) - truth_at(rows, truth)):.3f}")
        rows = replay(recording, table_rig)
        words.append(f"gn with the curves {rms(angles(rows) - truth_at(rows, truth)):.3f}")
        slopes = ", ".join(f"{1e3 * slope:.1f}" for _, _, slope in lines)
        print(f"  {name:8s} {'; '.join(words)} (lines of {slopes} mm/V)")


def print_scales(folder):
    recording, truth = simulate(folder, rig_file(folder, "rig.toml"), "--ideal", "--case", 1)
    first, second = (folder / "rig.toml").read_text().rsplit("slope_m_per_v = 0.006", 1)
    rig = folder / "scales.toml"
    rig.write_text(first + "slope_m_per_v = 0.4" + second)
    rows = replay(recording, rig, "--estimator", "paper", "--align")
    print(f"Row 8, Sy's scale 0.4 m/V where it is 0.006: a root in {len(rows)} of 172 samples of"
          f" case 1, {rms(angles(rows) - truth_at(rows, truth)):.0f} deg off")
    step_v = 20 / 2**16
    print(f"  a step of {1e6 * step_v:.0f} uV (16 bits over +-10 V) is"
          f" {np.degrees(step_v * 0.4 / 0.02):.2f} deg with 0.4 m/V,"
          f" {np.degrees(step_v * 0.006 / 0.02):.4f} deg with 0.006 m/V")


def print_range():
    """Of a tilt straight at a sensor level with the pivot: gap = 20 mm tan(45 deg +- tilt / 2)."""
    near, far = (20 * np.tan(np.pi / 4 + sign * TILT / 2) for sign in (-1, 1))
    print(f"Row 11, gaps in a swing of 10 deg: {near:.1f} to {far:.1f} mm;"
          f" 25 mm at a tilt of {np.degrees(2 * (np.arctan(25 / 20) - np.pi / 4)):.1f} deg")


def main():
    with tempfile.TemporaryDirectory() as name:
        print_disc_offset(pathlib.Path(name))
        print_positions()
        print_curve(pathlib.Path(name))
        print_scales(pathlib.Path(name))
    print_range()


if __name__ == "__main__":
    main()
