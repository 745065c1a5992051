# SPDX-License-Identifier: Apache-2.0
# The Nucleo's image on QEMU's netduinoplus2 (an STM32F405), its wire and its ADC held from outside.
import os
import pathlib
import queue
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/program"))
import wire  # noqa: E402
IMAGE = pathlib.Path(os.environ.get("NUCLEO_ELF", ROOT / "build/stm32f4/penduline-nucleo.elf"))
QEMU = shutil.which("qemu-system-arm")

INJECTED_RESULTS = (0x4001203C, 0x40012040)  # ADC1_JDR1 and JDR2: the channels PA0 and PA1
STORE_ADDRESS = 0x0800C000
TOP_CODE = 4095


def missing():
    """What the test cannot do without, or nothing."""
    if QEMU is None:
        return "qemu-system-arm is not installed (Debian: qemu-system-arm)"
    if not IMAGE.exists():
        return f"{IMAGE} is not built (cmake --preset stm32f4, cmake --build --preset stm32f4)"
    return None


def counts(code):
    """The reading that conversions of one code become."""
    return (code * 65535 + TOP_CODE // 2) // TOP_CODE


class Machine:
    """A board in QEMU. While it works its time goes by the instructions it runs, 8 ns each, so that
    a busy host slows it down; while it sleeps it follows the host's clock, and wakes as late as
    the host does: by some milliseconds, which cost no sample at 50 Hz and below."""

    def __init__(self, store=None):
        self.folder = tempfile.TemporaryDirectory(prefix="penduline-")
        folder = pathlib.Path(self.folder.name)
        self.splitter = wire.Splitter()
        self.token = 0
        self.log = folder / "errors"
        options = []
        if store is not None:
            (folder / "store").write_bytes(store)
            options = ["-device",
                       f"loader,file={folder}/store,addr={STORE_ADDRESS:#x},force-raw=on"]
        # It listens to us, so that it waits with its start until all is connected.
        listeners = [listen(folder / name) for name in ("wire", "qtest")]
        self.process = subprocess.Popen(
            [QEMU, "-M", "netduinoplus2", "-kernel", IMAGE, "-accel", "tcg", "-icount", "shift=3",
             "-display", "none",
             "-monitor", "none", "-d", "guest_errors", "-D", self.log,
             "-chardev", f"socket,id=wire,path={folder}/wire", "-serial", "null",
             "-serial", "chardev:wire", "-qtest", f"unix:{folder}/qtest", *options],
            stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.port, qtest = (accept(listener) for listener in listeners)
        self.qtest = qtest.makefile("rw")
        qtest.close()
        self.port.settimeout(10)  # a board that does not read is a failure, not a wait for ever
        # QEMU stands still while what it has sent is not read, whatever we are doing.
        self.arrived = queue.Queue()
        self.reader = threading.Thread(target=self.read)
        self.reader.start()

    def close(self):
        self.process.terminate()
        self.process.wait(timeout=10)
        self.reader.join(timeout=10)
        self.port.close()
        self.qtest.close()
        self.folder.cleanup()

    def inject(self, *codes):
        """Sets what the ADC's next conversions give."""
        for address, code in zip(INJECTED_RESULTS, codes):
            self.qtest.write(f"writel {address:#x} {code:#x}\n")
        self.qtest.flush()
        for _ in codes:
            answer = self.qtest.readline()
            if not answer.startswith("OK"):
                raise AssertionError(f"QEMU answered {answer!r} to an injection")

    def read(self):
        while True:
            try:
                data = self.port.recv(4096)
            except TimeoutError:
                continue
            if not data:
                return
            self.arrived.put(data)

    def send(self, data):
        self.port.sendall(data)

    def receive(self, wait_s):
        """Messages that have come, after at most so long a wait for the first bytes."""
        try:
            return self.splitter.messages(self.arrived.get(timeout=wait_s))
        except queue.Empty:
            return []

    def run(self, seconds, until=None):
        """Messages of so many seconds, or up to one of which `until` is true."""
        messages, end = [], time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            messages += (new := self.receive(left))
            if until is not None and any(map(until, new)):
                break
        return messages

    def wait_for(self, name, seconds=10):
        """The next message of a name."""
        found = only(name, self.run(seconds, lambda message: type(message).__name__ == name))
        if not found:
            raise AssertionError(f"found no {name} within {seconds} s")
        return found[0]

    def command(self, name, *fields):
        """Sends a command with a new token; its result's name and all that came meanwhile."""
        self.token = self.token % 255 + 1
        self.send(wire.encode(name, self.token, *fields))
        kind = wire.COMMANDS[name][0]
        messages = self.run(10, lambda message: message[:2] == (kind, self.token))
        replies = [reply for reply in only("Reply", messages) if reply.token == self.token]
        if not replies:
            raise AssertionError(f"found no Reply to {name} within 10 s")
        return wire.RESULTS[replies[0].result], messages

    def status(self):
        return only("Status", self.command("AskStatus")[1])[-1]


def listen(path):
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(str(path))
    listener.listen(1)
    return listener


def accept(listener):
    listener.settimeout(10)
    connection, _ = listener.accept()
    listener.close()
    return connection


def only(name, messages):
    """Those of one name."""
    return [message for message in messages if type(message).__name__ == name]
