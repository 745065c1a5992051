# SPDX-License-Identifier: Apache-2.0
# end_to_end.py SOURCE SECONDS: reads a board that is not the guest's own, hands the angles out by /dev/ttyS1, and
# reads it once more after it has restarted.
import sys
import tty

import bench
import wire
from program import RIGS

OUTPUT = "/dev/ttyS1"
RESTART = 0  # a kind of Reboot


def open_raw(path):
    """A terminal that passes bytes as they are."""
    terminal = open(path, "wb", buffering=0)
    tty.setraw(terminal)
    return terminal


def read(source, rows):
    """What the program wrote of so many rows and more."""
    run = bench.Run(source=source, rig=RIGS / "tcrt5000.toml")
    run.wait_for_rows(rows, seconds=30 + rows / 20)
    run.interrupt()
    status, said = run.end()
    print("\n".join(said))
    if status != 0:
        raise AssertionError(f"ended with {status}")
    return run.output


def restart():
    """Has the board restart; its port goes and comes back."""
    with open_raw(bench.PORT) as port:
        port.write(wire.encode("Reboot", 1, RESTART))
        bench.wait_until(lambda: not bench.PORT.exists(), "the board to go")
    bench.wait_until(bench.PORT.exists, "the board to come back")


def main(source, seconds):
    bench.wait_until(bench.PORT.exists, f"{bench.PORT} to come", seconds=30)
    angles = read(source, 20 * seconds)
    with open_raw(OUTPUT) as output:
        output.write(angles)
    restart()
    read(source, 1)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
