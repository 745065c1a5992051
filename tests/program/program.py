# SPDX-License-Identifier: Apache-2.0
# Runs the built program as a user would, for the tests in Python.
import bisect
import csv
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("PENDULINE", ROOT / "build/release/penduline")).resolve()
RIGS = ROOT / "docs/rigs"
SHARED_DATA = ROOT.parent / "shared/data"


def run(*arguments, status=0, **options):
    """Runs the program; fails unless it ends with `status`."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          check=False, timeout=300, **options)
    if done.returncode != status:
        raise AssertionError(f"ended with {done.returncode}, expected {status}: {done.stderr}")
    return done


def read_rows(path):
    """Rows of a CSV file as dictionaries, without what stands behind '#'."""
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def rms_error_deg(estimates, truth, from_s=0.0):
    """RMS error of both angles in degrees, the truth interpolated linearly."""
    times = [int(row["t_us"]) / 1e6 for row in truth]
    squares = []
    for row in estimates:
        now = float(row["t_s"])
        if row["theta1_rad"] == "" or now < from_s or not times[0] <= now <= times[-1]:
            continue
        after = max(1, bisect.bisect_left(times, now))
        share = (now - times[after - 1]) / (times[after] - times[after - 1])
        for angle in ("theta1_rad", "theta2_rad"):
            low, high = float(truth[after - 1][angle]), float(truth[after][angle])
            squares.append((float(row[angle]) - low - share * (high - low)) ** 2)
    return math.degrees(math.sqrt(sum(squares) / len(squares)))


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def simulate(self, *arguments, rig="paper.toml"):
        """Simulates into the test's folder; returns the paths of recording and truth."""
        recording, truth = self.folder / "recording.csv", self.folder / "truth.csv"
        run("simulate", "--rig", RIGS / rig, "-o", recording, "--truth", truth, *arguments)
        return recording, truth
