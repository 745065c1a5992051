# SPDX-License-Identifier: Apache-2.0
# Runs the program on simulated swings and lays its estimates over the truth, for docs/paper.md.
"""Needs numpy. The program is build/release/penduline or $PENDULINE."""

import os
import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("PENDULINE", str(ROOT / "build/release/penduline"))
PAPER_RIG = (ROOT / "docs/rigs/paper.toml").read_text()


def run(*arguments):
    """Runs the program; ends with its own message where it fails."""
    command = [PROGRAM, *map(str, arguments)]
    try:
        result = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        sys.exit(f"{PROGRAM}: not there, scripts/demo builds it; or set PENDULINE")
    if result.returncode != 0:
        sys.exit(f"{' '.join(command)}: {result.stderr.strip()}")


def rig_file(folder, name, *replacements, then=""):
    """The paper's rig with some of its text replaced and some added, as a file."""
    text = PAPER_RIG
    for old, new in replacements:
        if old not in text:
            sys.exit(f"docs/rigs/paper.toml: expected '{old}' in it")
        text = text.replace(old, new)
    path = folder / name
    path.write_text(text + then)
    return path


def read_table(path):
    """Columns by name; an empty cell is NaN."""
    return np.genfromtxt(path, delimiter=",", names=True)


def filter_section(order, cutoff):
    """A rig file's [filter]; order 0 is none."""
    return f"\n[filter]\norder = {order}\ncutoff_of_nyquist = {cutoff}\n"


def simulate(folder, rig, *options):
    """A recording and the exact truth at its samples and midway between them."""
    recording, truth = folder / "recording.csv", folder / "truth.csv"
    run("simulate", "--rig", rig, "-o", recording, *options)
    run("simulate", "--rig", rig, "-o", folder / "unused.csv", "--truth", truth, "--rate", 40,
        *options)
    return recording, read_table(truth)


def replay(recording, rig, *options):
    """The rows that have angles."""
    estimates = recording.with_name("estimates.csv")
    run("replay", recording, "--rig", rig, "-o", estimates, *options)
    table = read_table(estimates)
    return table[np.isfinite(table["theta1_rad"])]


def angles(table):
    """theta1 and theta2 of each row, in degrees."""
    return np.degrees(np.column_stack([table["theta1_rad"], table["theta2_rad"]]))


def truth_at(rows, truth):
    """The exact angles at the rows' own times, in degrees."""
    places = np.rint(rows["t_s"] * 40).astype(int)
    assert np.allclose(places / 40, rows["t_s"], atol=1e-6)
    return angles(truth)[places]


def interpolated_truth_at(rows, truth):
    """The same, interpolated linearly between the truth at the 20 Hz samples."""
    known = truth[::2]
    return np.column_stack([np.interp(rows["t_s"], known["t_us"] / 1e6, column)
                            for column in angles(known).T])


def rms(errors):
    """Over all rows and both angles."""
    return float(np.sqrt(np.mean(np.square(errors))))
