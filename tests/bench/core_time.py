# SPDX-License-Identifier: Apache-2.0
# How much of the processor another process has taken.
import os
import pathlib

TICKS_PER_S = os.sysconf("SC_CLK_TCK")


def core_seconds(process):
    """What a process has taken of the processor so far, all its threads."""
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICKS_PER_S
