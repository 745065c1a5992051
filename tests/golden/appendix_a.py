#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
# The paper's Appendix A in SciPy, written from its print alone, to check `replay --estimator paper`.
"""Reads a recording and writes seq,theta1_rad,theta2_rad,cx_m,cy_m,cz_m, one row for each sample
after the first 28. Shares no code and no derived formula with the program: each row is a root of
the six equations as Appendix A prints them. Differs from the print in one thing, the starting
point of the solver, which is the root at rest: from the printed x0 = 0 SciPy's fsolve lands on
wrong roots (--printed-start counts them). Ends with an error where a root is wrong."""

import argparse
import csv
import sys
import warnings

import numpy as np
from scipy.optimize import fsolve
from scipy.signal import firwin, lfilter

DROPPED = 28  # me
LARGEST_RESIDUAL_M = 1e-14


def read_signals_v(path):
    """Sequence numbers and the volts of the two sensors of a recording."""
    header = {}
    rows = []
    with open(path, newline="") as file:
        for line in file:
            if line.startswith("#"):
                key, separator, value = line[1:].partition("=")
                if separator:
                    header[key.strip()] = value.strip()
            else:
                rows.append(line)
    volts_per_count = float(header["reference_v"]) / float(header["full_scale_counts"])
    samples = list(csv.DictReader(rows))

    def signal_v(name):
        counts = [int(sample[name + "_on"]) - int(sample[name + "_off"]) for sample in samples]
        return np.array(counts) * volts_per_count

    return [int(sample["seq"]) for sample in samples], signal_v("x"), signal_v("y")


def filtered_position_m(signal_v, scale_m_per_v, lp_m):
    """dz of one sensor: filter with the sign turned, drop, remove the mean, scale, add the rest
    position lPx = lPy = -0.02. That is -lp: with any other lp the equations have no root at rest."""
    b = firwin(16, 0.15)  # fir1(15, 0.15)
    filtered = -lfilter(b, 1, signal_v)
    filtered = filtered[DROPPED:]
    return (filtered - np.mean(filtered)) * scale_m_per_v - lp_m


def equations(x, dz1, dz2, arguments):
    """F of Appendix A, term by term; x is theta1, theta2, l1, l2, l3, l4."""
    lp, dx0, dy0 = arguments.lp, arguments.dx, arguments.dy
    sin, cos, pi = np.sin, np.cos, np.pi
    x1, x2, x3, x4, x5, x6 = x
    return [
        lp * cos(x2 + pi / 2) - dx0 + x4 * sin(x2 + pi / 2),
        x4 * cos(x1 + pi / 2) * cos(x2 + pi / 2)
        - x3 * sin(x1 + pi / 2)
        - lp * cos(x1 + pi / 2) * sin(x2 + pi / 2),
        x3 * cos(x1 + pi / 2)
        - dz1
        + x4 * cos(x2 + pi / 2) * sin(x1 + pi / 2)
        - lp * sin(x1 + pi / 2) * sin(x2 + pi / 2),
        lp * cos(x2 + pi / 2) + x6 * sin(x2 + pi / 2),
        x5 * sin(x1 + pi / 2)
        - dy0
        + x6 * cos(x1 + pi / 2) * cos(x2 + pi / 2)
        - lp * cos(x1 + pi / 2) * sin(x2 + pi / 2),
        x6 * cos(x2 + pi / 2) * sin(x1 + pi / 2)
        - x5 * cos(x1 + pi / 2)
        - dz2
        - lp * sin(x1 + pi / 2) * sin(x2 + pi / 2),
    ]


def rest(arguments):
    """The root at rest."""
    return np.array([0, 0, 0, arguments.dx, arguments.dy, 0])


def orientation(x, arguments):
    """Sign of the determinant of F's derivative. F depends on dz1 and dz2 by a constant only. The
    determinant vanishes where two roots meet, so the root that goes continuously back to rest has
    the sign that it has at rest."""
    step = 1e-6
    columns = []
    for i in range(6):
        there, back = np.array(x), np.array(x)
        there[i] += step
        back[i] -= step
        difference = np.subtract(equations(there, 0, 0, arguments), equations(back, 0, 0, arguments))
        columns.append(difference / (2 * step))
    return np.sign(np.linalg.det(np.transpose(columns)))


def solve(start, dz1, dz2, arguments):
    """The root that fsolve finds for one sample, with what speaks against it, if anything."""
    root = fsolve(equations, start, args=(dz1, dz2, arguments), xtol=1e-13, full_output=True)[0]
    residual = np.max(np.abs(equations(root, dz1, dz2, arguments)))
    if not residual <= LARGEST_RESIDUAL_M:
        return root, f"left a residual of {residual:.3g} m, expected at most {LARGEST_RESIDUAL_M:g}"
    hangs = np.all(np.abs(root[:2]) < np.pi / 2)
    if not hangs or orientation(root, arguments) != orientation(rest(arguments), arguments):
        return root, "found a root that does not go back to rest, theta1 = {:.6g} rad".format(*root)
    return root, None


def main():
    parser = argparse.ArgumentParser(description="The paper's Appendix A on a recording.")
    parser.add_argument("recording")
    parser.add_argument("--scale1", type=float, required=True, help="m/V, 0.006 in the paper")
    parser.add_argument("--scale2", type=float, required=True, help="m/V, 0.4 in the paper")
    parser.add_argument("--lp", type=float, default=0.02, help="pivot to disc, m")
    parser.add_argument("--dx", type=float, default=0.02, help="pivot to sensor Sx, m")
    parser.add_argument("--dy", type=float, default=0.02, help="pivot to sensor Sy, m")
    parser.add_argument("--length", type=float, default=0.3, help="pivot to mass, m")
    parser.add_argument("--printed-start", action="store_true",
                        help="start from the printed x0 = 0 and only count the wrong roots")
    arguments = parser.parse_args()

    seqs, signal1_v, signal2_v = read_signals_v(arguments.recording)
    if len(seqs) <= DROPPED:
        sys.exit(f"{arguments.recording}: found {len(seqs)} samples, expected more than {DROPPED}")
    seqs = seqs[DROPPED:]
    dz1 = filtered_position_m(signal1_v, arguments.scale1, arguments.lp)
    dz2 = filtered_position_m(signal2_v, arguments.scale2, arguments.lp)
    warnings.simplefilter("ignore", RuntimeWarning)  # fsolve's; the residual tells the same
    start = np.zeros(6) if arguments.printed_start else rest(arguments)
    roots, faults = zip(*(solve(start, *pair, arguments) for pair in zip(dz1, dz2)))
    if arguments.printed_start:
        wrong = sum(fault is not None for fault in faults)
        print(f"from x0 = 0: {wrong} wrong roots in {len(roots)} samples", file=sys.stderr)
    else:
        for seq, fault in zip(seqs, faults):
            if fault:
                sys.exit(f"seq {seq}: fsolve {fault}")

    theta1, theta2 = np.transpose(roots)[:2]
    theta1 = theta1 - np.mean(theta1)
    theta2 = theta2 - np.mean(theta2)
    cx = -arguments.length * np.sin(theta2)
    cy = arguments.length * np.sin(theta1)
    cz = -arguments.length * np.cos(theta2) * np.cos(theta1)
    print("seq,theta1_rad,theta2_rad,cx_m,cy_m,cz_m")
    for seq, *row in zip(seqs, theta1, theta2, cx, cy, cz):
        print(seq, *(f"{value:.15g}" for value in row), sep=",")


if __name__ == "__main__":
    main()
