#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Times `penduline run` on boards that sample in real time: live_latency.py BUILD [--hour].

The boards are the firmware as processes on pseudo-terminals. A row's latency is from the end of the board's
window, by the clock that the board runs on, to the moment in which a reader of the run's standard output has
the row; the recording is written meanwhile."""
import csv
import json
import os
import pathlib
import select
import signal
import sys
import tempfile
import time

BUILD = pathlib.Path(sys.argv[1]).resolve()
os.environ["PENDULINE"] = str(BUILD / "penduline")
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "program"))

from core_time import core_seconds  # noqa: E402: it wants to know the program
from live_run import Run  # noqa: E402
from program import RIGS  # noqa: E402
from sim_board import SimBoard  # noqa: E402

WINDOW_S = 556e-6
SETTLING_S = 2


class Rig:
    """A board, a run on it, and when each row came."""

    def __init__(self, folder, number, rate_hz):
        self.rate_hz = rate_hz
        self.board = SimBoard(folder / f"port{number}", "--case", "conical", "--tick-us", "5000")
        self.recording = folder / f"{number}.csv"
        self.run = Run("--rate", str(rate_hz), "--record", self.recording,
                       source=f"serial:{self.board.port}", rig=RIGS / "paper.toml")
        self.pipe = self.run.process.stdout.fileno()
        self.arrivals = {}  # by seq
        self.text = b""

    def take(self):
        """Reads what has come."""
        self.text += os.read(self.pipe, 65536)
        now = time.monotonic()
        *rows, self.text = self.text.split(b"\n")
        for row in rows:
            if not row.startswith(b"t_s"):
                self.arrivals[int(row.split(b",", 2)[1])] = now

    def end(self, measured_from):
        """Ends the run, then the board; latencies in seconds of the rows from then on, samples lost, rows that
        are missing, samples recorded."""
        self.run.process.send_signal(signal.SIGTERM)
        while select.select([self.pipe], [], [], 5)[0]:
            before = len(self.text), len(self.arrivals)
            self.take()
            if (len(self.text), len(self.arrivals)) == before:
                break
        status = self.run.process.wait()
        said = "\n".join(self.run.lines_said())
        if status != 0 or " 0 lost, " not in said:
            print(said, file=sys.stderr)
        with open(self.recording, encoding="utf-8") as file:
            t_us = {int(row["seq"]): int(row["t_us"])
                    for row in csv.DictReader(line for line in file if not line.startswith("#"))}
        self.run.close()
        self.board.close()
        numbers = sorted(t_us)
        lost = numbers[-1] - numbers[0] + 1 - len(numbers)
        missing = sum(seq not in self.arrivals for seq in numbers)
        ends = {seq: self.board.time_0_s + t_us[seq] / 1e6 + WINDOW_S / 2 for seq in numbers}
        latencies = [self.arrivals[seq] - end for seq, end in ends.items()
                     if seq in self.arrivals and end >= measured_from]
        return latencies, lost, missing, len(numbers)


def quantile(values, share):
    return sorted(values)[min(int(share * len(values)), len(values) - 1)]


def measure(name, rigs, rate_hz, seconds):
    with tempfile.TemporaryDirectory() as folder:
        by_pipe, poll = {}, select.poll()

        def listen(for_s):
            left, end = for_s, time.monotonic() + for_s
            while left >= 0:
                for pipe, _ in poll.poll(left * 1e3):
                    by_pipe[pipe].take()
                left = end - time.monotonic()

        for number in range(rigs):
            rig = Rig(pathlib.Path(folder), number, rate_hz)
            by_pipe[rig.pipe] = rig
            poll.register(rig.pipe, select.POLLIN)
            listen(0)
        running = list(by_pipe.values())
        listen(SETTLING_S)
        begin, core = time.monotonic(), [core_seconds(rig.run.process) for rig in running]
        listen(seconds)
        share = (sum(core_seconds(rig.run.process) for rig in running) - sum(core)) / (
            time.monotonic() - begin)
        outcomes = [rig.end(begin) for rig in running]
    latencies = [latency for outcome in outcomes for latency in outcome[0]]
    lost, missing, recorded = (sum(outcome[i] for outcome in outcomes) for i in (1, 2, 3))
    return {"name": name, "rigs": rigs, "rate_hz": rate_hz, "seconds": seconds,
            "p50_s": quantile(latencies, 0.5), "p99_s": quantile(latencies, 0.99),
            "worst_s": max(latencies), "core_share": share, "samples": recorded, "lost": lost,
            "rows_missing": missing}


def main():
    if "--hour" in sys.argv:
        runs = [("1 at 1 kHz, an hour", 1, 1000, 3600)]
    else:
        runs = [("1 at 20 Hz", 1, 20, 60), ("1 at 1 kHz", 1, 1000, 60), ("64 at 20 Hz", 64, 20, 30)]
    for run in runs:
        print(json.dumps(measure(*run)), flush=True)


if __name__ == "__main__":
    main()
