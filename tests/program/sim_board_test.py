# SPDX-License-Identifier: Apache-2.0
# `penduline-sim-board`: the firmware as a process, on stdout, on a terminal, and its end.
import os
import re
import select
import signal
import subprocess
import tempfile
import termios
import time
import unittest

from program import RIGS, ProgramTest
from sim_board import BOARD, WITHOUT_PTS
import wire

PAPER = ["--rig", RIGS / "paper.toml"]


def run_board(*arguments, commands=b"", status=0):
    """Runs the board to its end; its stdout and stderr."""
    with tempfile.TemporaryFile() as file:  # seconds of virtual time pass before a pipe is filled
        file.write(commands)
        file.seek(0)
        done = subprocess.run([BOARD, *map(str, arguments)], stdin=file, capture_output=True,
                              check=False, timeout=120)
    if done.returncode != status:
        raise AssertionError(f"ended with {done.returncode}, expected {status}: {done.stderr}")
    return done.stdout, done.stderr.decode()


def stream_of(seconds, *arguments, commands=b""):
    """What it sends on stdout in so many seconds of virtual time."""
    return run_board(*PAPER, "--link", "stdout", "--fast", "--seconds", seconds, *arguments,
                     commands=commands)[0]


def messages(stream):
    return wire.Splitter().messages(stream)


def only(name, found):
    return [message for message in found if type(message).__name__ == name]


class StreamTest(ProgramTest):
    def test_a_minute_of_samples_comes_whole_and_at_its_rate(self):
        found = messages(stream_of(60))
        self.assertEqual([type(message).__name__ for message in found[:2]], ["Hello", "Status"])
        self.assertEqual(len(only("Status", found)), 61)
        samples = only("Sample", found)
        self.assertEqual(len(samples), 1199)
        for number, sample in enumerate(samples):
            self.assertEqual((sample.seq, sample.t_us), (number, (number + 1) * 50000 + 278))
        self.assertEqual({sample.flags for sample in samples[1:]}, {0})

    def test_one_seed_gives_one_stream(self):
        first = stream_of(5, "--seed", 7)
        self.assertEqual(stream_of(5, "--seed", 7), first)
        self.assertNotEqual(stream_of(5, "--seed", 8), first)

    def test_emitters_add_to_the_rooms_light(self):
        found = messages(stream_of(2, "--theta-deg", 0, "--noise", 0, "--ambient", 0.25))
        sample = only("Sample", found)[0]
        self.assertAlmostEqual(sample.x_off / 65535 * 3.3, 0.25, delta=3.3 / 4095)
        self.assertGreater(sample.x_on, sample.x_off + 1000)

    def test_commands_come_on_stdin_and_a_restart_is_told(self):
        commands = wire.encode("AskHello", 5) + wire.encode("Reboot", 6, 0)
        found = messages(stream_of(3, commands=commands))
        self.assertEqual([(reply.token, reply.result) for reply in only("Reply", found)],
                         [(5, 0), (6, 0)])
        self.assertEqual(len({hello.boot_id for hello in only("Hello", found)}), 2)
        last = only("Status", found)[-1]
        self.assertEqual((last.reset_cause, last.resets), (3, 1))  # by software, once

    def test_the_store_is_a_file(self):
        store = self.folder / "store"
        stream_of(1, "--store", store, commands=wire.encode("EraseRig", 1))
        self.assertEqual(store.read_bytes(), b"\xff" * 4096)
        store.write_bytes(b"not a rig")
        status = only("Status", messages(stream_of(1, "--store", store)))[0]
        self.assertEqual(status.store, wire.STORE_DAMAGED)

    def test_a_reader_that_goes_ends_it(self):
        process = subprocess.Popen([BOARD, *PAPER, "--link", "stdout", "--fast"],
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        process.stdout.read(1000)
        process.stdout.close()
        self.assertEqual(process.wait(timeout=30), 0)
        process.stderr.close()


class TerminalTest(ProgramTest):
    def start(self, *options):
        self.process = subprocess.Popen([BOARD, *PAPER, *options], stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end)
        self.path = re.fullmatch(r"info: link (/dev/pts/\d+)\n",
                                 self.process.stderr.readline()).group(1)

    def end(self):
        self.process.kill()
        self.process.wait()
        self.process.stderr.close()

    def read_until(self, port, enough):
        """Reads until `enough` says so of the messages that came, ten seconds at most."""
        stream = b""
        until = time.monotonic() + 10
        while not enough(messages(stream)):
            self.assertLess(time.monotonic(), until, "it takes too long")
            if select.select([port], [], [], 1)[0]:
                stream += os.read(port, 4096)
        return messages(stream)


@unittest.skipIf(WITHOUT_PTS, "no pseudo-terminals: /dev/pts is not mounted")
class DeviceTest(TerminalTest):
    def test_a_device_that_is_there_is_its_link_until_it_hangs_up(self):
        port, device = os.openpty()
        self.start("--link", os.ttyname(device))
        self.assertEqual(self.path, os.ttyname(device))
        os.close(device)
        os.write(port, wire.encode("AskHello", 10))  # a terminal that is not raw takes 10 for a new line
        found = self.read_until(port, lambda found: only("Reply", found) and only("Sample", found))
        self.assertEqual([reply.token for reply in only("Reply", found)], [10])
        os.close(port)
        self.assertEqual(self.process.wait(timeout=30), 0)


@unittest.skipIf(WITHOUT_PTS, "no pseudo-terminals: /dev/pts is not mounted")
class PseudoTerminalTest(TerminalTest):
    def setUp(self):
        super().setUp()
        self.start()

    def test_it_streams_in_real_time_and_answers(self):
        port = os.open(self.path, os.O_RDWR | os.O_NOCTTY)
        self.addCleanup(os.close, port)
        os.write(port, wire.encode("AskHello", 9))
        start = time.monotonic()
        found = self.read_until(port, lambda found: len(only("Sample", found)) > 20)
        self.assertGreater(time.monotonic() - start, 0.7)
        self.assertEqual([reply.token for reply in only("Reply", found)], [9])

    def test_it_may_be_opened_again(self):
        for _ in range(2):
            port = os.open(self.path, os.O_RDWR | os.O_NOCTTY)
            self.read_until(port, lambda found: only("Sample", found))
            os.close(port)
            time.sleep(0.1)

    def test_ctrl_c_ends_it(self):
        time.sleep(0.2)
        self.process.send_signal(signal.SIGINT)
        self.assertEqual(self.process.wait(timeout=30), 0)
        self.assertRegex(self.process.stderr.read(),
                         r"^info: time 0 at \d+\.\d{6} s of CLOCK_MONOTONIC\n"
                         r"info: \d\.\d{3} s of virtual time\n$")

    def test_the_touch_at_1200_baud_ends_it_in_the_bootloader(self):
        port = os.open(self.path, os.O_RDWR | os.O_NOCTTY)
        attributes = termios.tcgetattr(port)
        attributes[4] = attributes[5] = termios.B1200
        termios.tcsetattr(port, termios.TCSANOW, attributes)
        os.close(port)
        self.assertEqual(self.process.wait(timeout=30), 0)
        self.assertIn("info: in the bootloader", self.process.stderr.read())


class RefusalTest(ProgramTest):
    def refusal(self, *arguments, status=1):
        return run_board("--link", "stdout", *arguments, status=status)[1]

    def test_a_rig_of_three_sensors_is_refused(self):
        text = (RIGS / "paper.toml").read_text(encoding="utf-8")
        last = text[text.rindex("[[sensor]]"):]
        third = re.sub(r"position_m = .*", "position_m = [-0.02, 0.0, 0.0]", last)
        third = third.replace('name = "Sy"', 'name = "Sz"')
        filter_at = third.find("[filter]")
        rig = self.write("three.toml", text + "\n" + (third if filter_at < 0 else
                                                      third[:filter_at]))
        self.assertIn("found 3 sensors, expected 2", self.refusal("--rig", rig, "--seconds", 1))

    def test_a_store_that_is_no_store_is_refused(self):
        self.assertIn("Is a directory", self.refusal(*PAPER, "--store", self.folder))
        too_long = self.write("long", "x" * 5000)
        self.assertIn("expected a store of 4096 bytes", self.refusal(*PAPER, "--store", too_long))

    def test_a_link_that_is_no_serial_device_is_refused(self):
        for path, why in (("/dev/null", "Inappropriate ioctl for device"),
                          ("nothing", "No such file or directory")):
            said = run_board(*PAPER, "--link", path, status=1)[1]
            self.assertEqual(said, f"error: {path}: {why}\n")

    def test_what_the_firmware_decides_is_no_option(self):
        for option in ("--rate", "--adc-bits"):
            self.refusal(*PAPER, option, 10, status=2)


if __name__ == "__main__":
    unittest.main()
