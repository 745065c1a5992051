# SPDX-License-Identifier: Apache-2.0
# The guest's GPIO lines as the world at the other end of their wires sees them, and runs that hold them.
import fcntl
import os
import pathlib
import struct
import threading
import time

import bench
from program import RIGS

RIG = pathlib.Path("/tmp/lines.toml")
RECORDING = pathlib.Path("/tmp/rec.csv")
NAMES = [f"penduline-{name}" for name in ("reset", "magnet", "status-led", "trigger")]
KEYS = """
[gpio]
reset = "penduline-reset"
release = "penduline-magnet"
status_led = "penduline-status-led"
trigger = "penduline-trigger"
"""


def write_rig(keys=KEYS):
    """The paper's rig with these lines."""
    RIG.write_text((RIGS / "paper.toml").read_text(encoding="utf-8") + keys, encoding="utf-8")
    return RIG


class Wire:
    """What is at a line's end."""

    def __init__(self, offset, pull):
        self.folder = pathlib.Path(os.environ["GPIO_SIM"]) / f"sim_gpio{offset}"
        self.pull(pull)

    def level(self):
        return int((self.folder / "value").read_text(encoding="utf-8"))

    def pull(self, direction):
        """Pulls it "up" or "down"."""
        (self.folder / "pull").write_text(f"pull-{direction}", encoding="utf-8")


def flags_of(name):
    """How the line of that name is held: "kernel" where it is, "active_low", "open_drain" and so on."""
    known = ("kernel", "is_out", "active_low", "open_drain", "open_source")
    get_line_info, layout = 0xC048B402, struct.Struct("II32s32s")  # linux/gpio.h
    for chip in pathlib.Path("/dev").glob("gpiochip*"):
        with open(chip, "rb") as device:
            for offset in range(4):
                answer = fcntl.ioctl(device, get_line_info, layout.pack(offset, 0, b"", b""))
                _, flags, found, _ = layout.unpack(answer)
                if found.rstrip(b"\0").decode() == name:
                    return {flag for bit, flag in enumerate(known) if flags & 1 << bit}
    raise AssertionError(f"found no line {name}")


class Watch:
    """Notes each change of a wire with its moment, by looking every so often."""

    def __init__(self, wire, period_s=0.002):
        self.changes = []  # (CLOCK_MONOTONIC in s, level)
        self.wire, self.period_s = wire, period_s
        self.ended = False
        self.level = wire.level()
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        while not self.ended:
            level = self.wire.level()
            if level != self.level:
                self.changes.append((time.monotonic(), level))
                self.level = level
            time.sleep(self.period_s)

    def levels(self):
        return [level for _, level in self.changes]

    def close(self):
        self.ended = True
        self.thread.join()


class LinesTest(bench.BenchTest):
    def setUp(self):
        super().setUp()
        self.reset, self.magnet, self.led, self.trigger = (
            Wire(offset, pull) for offset, pull in enumerate(["down"] * 4))
        write_rig()
        RECORDING.unlink(missing_ok=True)

    def run_with_lines(self, *options):
        return self.start(bench.Run, *options, rig=RIG)

    def interrupt(self, run):
        run.interrupt()
        status, said = run.end()
        self.assertEqual(status, 0, said)
        return said
