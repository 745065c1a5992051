#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Times `penduline replay`, CSV in, CSV out, on one core: replay_throughput.py PENDULINE RIG."""
import json
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

RUNS = {100_000: 5, 1_000_000: 5, 10_000_000: 1}  # by rows of the recording
RATE_HZ = 1000
MEMORY_DISK = "/dev/shm"
BYTES_PER_ROW = 160  # recording and estimates together, amply


def record(program, rig, rows, path):
    swing = ["--theta-deg", "10", "--phi-deg", "30", "--psi", "3"]
    length = ["--seconds", str(rows / RATE_HZ), "--rate", str(RATE_HZ)]
    subprocess.run(
        [program, "simulate", "--ideal", *swing, *length, "--rig", rig, "--output", path],
        check=True, stderr=subprocess.DEVNULL)


def core_seconds():
    """What the children that have ended took of the processor."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def replay(program, rig, recording, output):
    """One replay: seconds by the clock, seconds of its core, peak memory in KiB."""
    core = str(max(os.sched_getaffinity(0)))
    with tempfile.NamedTemporaryFile("r") as report:
        # GNU time, because the peak that getrusage gives begins with that of the parent.
        time_it = ["/usr/bin/time", "--format", "%M", "--output", report.name]
        clock_before, core_before = time.monotonic(), core_seconds()
        subprocess.run(
            [*time_it, "taskset", "--cpu-list", core,
             program, "replay", recording, "--rig", rig, "--output", output],
            check=True, stderr=subprocess.DEVNULL)
        return time.monotonic() - clock_before, core_seconds() - core_before, int(report.read())


def measure(program, rig, rows, folder):
    recording = os.path.join(folder, "recording.csv")
    record(program, rig, rows, recording)
    outputs = {"memory_disk": os.path.join(folder, "estimates.csv"), "dev_null": "/dev/null"}
    for kind, output in outputs.items():
        outcomes = [replay(program, rig, recording, output) for _ in range(RUNS[rows])]
        clock_s, core_s, peaks_kib = zip(*outcomes)
        yield {
            "name": f"{rows}/{kind}",
            "samples_per_clock_s": rows / statistics.median(clock_s),
            "samples_per_core_s": rows / statistics.median(core_s),
            "peak_kib": max(peaks_kib),
        }


def main():
    program, rig = sys.argv[1:]
    for rows in RUNS:
        free = shutil.disk_usage(MEMORY_DISK).free
        if free < rows * BYTES_PER_ROW:
            print(f"{rows} rows are left out: found {free} bytes free in {MEMORY_DISK}, "
                  f"expected {rows * BYTES_PER_ROW}", file=sys.stderr)
            continue
        with tempfile.TemporaryDirectory(dir=MEMORY_DISK) as folder:
            for outcome in measure(program, rig, rows, folder):
                print(json.dumps(outcome), flush=True)


if __name__ == "__main__":
    main()
