#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What viewers of the live page cost a run: live_viewers.py BUILD.

The runs sample a simulated rig in real time, without recording; each viewer takes all events of /live, as a
browser does, and throws them away. The share of a core is that of the whole run, sampling and estimating
included."""
import json
import os
import pathlib
import select
import sys
import time

BUILD = pathlib.Path(sys.argv[1]).resolve()
os.environ["PENDULINE"] = str(BUILD / "penduline")
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "program"))

from core_time import core_seconds  # noqa: E402: it wants to know the program
from live_run import Run  # noqa: E402
from program import RIGS  # noqa: E402
from web_client import address_of, connect  # noqa: E402

SETTLING_S = 3
MEASURED_S = 30


def take(connections, for_s):
    """Bytes that all connections brought in that time."""
    poll, by_number, count = select.poll(), {}, 0
    for connection in connections:
        by_number[connection.fileno()] = connection
        poll.register(connection, select.POLLIN)
    end = time.monotonic() + for_s
    while (left := end - time.monotonic()) > 0:
        for number, _ in poll.poll(left * 1e3):
            piece = by_number[number].recv(1 << 20)
            if not piece:
                sys.exit("the run has sent a viewer away")
            count += len(piece)
    return count


def measure(rate_hz, viewers):
    run = Run("--web", "0", "--rate", str(rate_hz), "--case", "conical", "--output", "/dev/null",
              source="sim:", rig=RIGS / "paper.toml")
    _, port, _ = address_of(run)
    connections = [connect(port) for _ in range(viewers)]
    for connection in connections:
        connection.sendall(f"GET /live HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
        if not connection.recv(1 << 20).startswith(b"HTTP/1.1 200 "):
            sys.exit("the run has refused a viewer")
    take(connections, SETTLING_S)
    begin_s, core_s = time.monotonic(), core_seconds(run.process)
    received = take(connections, MEASURED_S)
    taken_s = time.monotonic() - begin_s
    share = (core_seconds(run.process) - core_s) / taken_s
    for connection in connections:
        connection.close()
    run.process.terminate()
    status, said = run.end()
    if status != 0 or not any(" 0 lost, " in line for line in said):
        sys.exit("\n".join(["the run did not end well:", *said]))
    name = f"{rate_hz} Hz, {viewers} viewer{'s' * (viewers != 1)}"
    return {"name": name, "rate_hz": rate_hz, "viewers": viewers, "core_share": share,
            "bytes_per_viewer_s": received / taken_s / max(viewers, 1)}


def main():
    for rate_hz in (20, 1000):
        for viewers in (0, 1, 10):
            print(json.dumps(measure(rate_hz, viewers)), flush=True)


if __name__ == "__main__":
    main()
