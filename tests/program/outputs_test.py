# SPDX-License-Identifier: Apache-2.0
# Outputs of a live run: none holds sampling up, several at once, UDP.
import json
import os
import pty
import re
import signal
import socket
import subprocess
import time
import unittest

from program import PROGRAM, RIGS, ProgramTest, read_rows, run

LIVE = [PROGRAM, "run", "sim:", "--rig", RIGS / "paper.toml"]


def dropped_in(said, output):
    """How many rows the summary says that the output dropped."""
    found = re.search(rf"(\d+) rows by {re.escape(output)}", said)
    return int(found[1]) if found else 0


class OutputsTest(ProgramTest):
    def start(self, *arguments, **options):
        process = subprocess.Popen([*LIVE, *map(str, arguments)], stderr=subprocess.PIPE, text=True,
                                   **options)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_for(self, condition, what):
        deadline = time.monotonic() + 60
        while not condition():
            self.assertLess(time.monotonic(), deadline, what)
            time.sleep(0.02)

    def test_a_live_run_writes_what_a_replay_of_its_recording_does(self):
        recording = self.folder / "rec.csv"
        live = run("run", "sim:", "--rig", RIGS / "paper.toml", "--seconds", 1, "--rate", 500,
                   "--record", recording)
        self.assertEqual(live.stdout,
                         run("replay", recording, "--rig", RIGS / "paper.toml").stdout)

    def test_a_reader_that_stalls_costs_rows_and_no_samples(self):
        recording = self.folder / "rec.csv"
        process = self.start("--rate", 5000, "--seconds", 2, "--record", recording,
                             stdout=subprocess.PIPE)
        self.assertEqual(process.wait(timeout=60), 0)
        said = process.stderr.read()
        self.assertIn("info: 10000 samples at 5000.000 Hz, 0 lost", said)
        self.assertEqual([int(row["seq"]) for row in read_rows(recording)], list(range(10000)))
        # What the pipe took is whole lines, and the rest is counted.
        text = process.stdout.read()
        process.stdout.close()
        self.assertTrue(text.endswith("\n"))
        self.assertTrue(all(line.count(",") == 12 for line in text.splitlines()))
        dropped = dropped_in(said, "standard output")
        self.assertGreater(dropped, 1000)
        self.assertEqual(len(text.splitlines()) - 1 + dropped, 10000)

    @unittest.skipUnless(os.path.exists("/dev/pts/ptmx"),
                         "no pseudo-terminals: /dev/pts is not mounted")
    def test_a_terminal_that_is_stopped_holds_no_sample_up(self):
        source, _ = self.simulate("--rate", 2000, "--seconds", 2)
        rows = source.read_text().splitlines(keepends=True)
        del rows[-500]  # a dropout, which is warned of when the terminal has long been full
        source.write_text("".join(rows))
        recording = self.folder / "rec.csv"
        screen, terminal = pty.openpty()
        self.addCleanup(os.close, screen)
        process = subprocess.Popen([PROGRAM, "run", f"file:{source}", "--rig", RIGS / "paper.toml",
                                    "--record", recording], stdout=terminal, stderr=terminal)
        os.close(terminal)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.wait_for(lambda: recording.exists() and read_rows(recording)[-1:] and
                      int(read_rows(recording)[-1]["seq"] or 0) == 3999,
                      "all samples are recorded while nobody reads the terminal")
        shown = b""
        while b"samples at" not in shown:
            shown += os.read(screen, 65536)
        self.assertEqual(process.wait(timeout=60), 0)
        said = [line for line in shown.decode(errors="replace").splitlines() if " samples " in line]
        self.assertEqual(len(said), 3, said)
        self.assertIn("samples are lost before this one", said[0])
        self.assertIn("recorded 3999 samples", said[1])
        self.assertIn("3999 samples at 2000.000 Hz, 1 lost", said[2])

    def test_a_reader_of_stdout_that_goes_ends_the_run_as_in_any_pipeline(self):
        process = self.start(stdout=subprocess.PIPE)
        process.stdout.readline()
        process.stdout.close()
        self.assertEqual(process.wait(timeout=60), -signal.SIGPIPE)

    def test_a_reader_of_stdout_that_goes_does_not_end_what_is_recorded(self):
        recording = self.folder / "rec.csv"
        process = self.start("--rate", 200, "--seconds", 2, "--record", recording, stdout=subprocess.PIPE)
        process.stdout.readline()
        process.stdout.close()
        self.assertEqual(process.wait(timeout=60), 1)
        self.assertIn("warning: standard output: Broken pipe; this output has ended\n", process.stderr.read())
        self.assertEqual(len(read_rows(recording)), 400)

    def test_where_broken_pipes_are_ignored_it_ends_with_a_message(self):
        process = self.start(stdout=subprocess.PIPE, restore_signals=False)  # Python ignores them
        process.stdout.readline()
        process.stdout.close()
        self.assertEqual(process.wait(timeout=60), 1)
        self.assertIn("error: standard output: Broken pipe\n", process.stderr.read())

    def test_several_outputs_have_the_same_rows(self):
        first, second = self.folder / "a.csv", self.folder / "b.csv"
        done = run("run", "sim:", "--rig", RIGS / "paper.toml", "--seconds", 1, "-o", first,
                   "--output", second, "-o", "-")
        self.assertEqual(len(done.stdout.splitlines()), 21)
        self.assertEqual(first.read_text(), done.stdout)
        self.assertEqual(second.read_text(), done.stdout)

    def test_a_replay_may_have_several_outputs(self):
        recording, _ = self.simulate()
        first, second = self.folder / "a.csv", self.folder / "b.csv"
        run("replay", recording, "--rig", RIGS / "paper.toml", "-o", first, "-o", second)
        self.assertEqual(len(first.read_text().splitlines()), 201)
        self.assertEqual(first.read_text(), second.read_text())

    def test_one_file_for_two_outputs_is_refused(self):
        path = self.folder / "a.csv"
        done = run("run", "sim:", "--rig", RIGS / "paper.toml", "-o", path, "-o", path, status=1)
        self.assertEqual(done.stderr, f"error: {path}: stands for two files of this run, expected two "
                         "names\n")

    def test_an_output_that_fails_is_said_and_the_others_go_on(self):
        path = self.folder / "a.csv"
        done = run("run", "sim:", "--rig", RIGS / "paper.toml", "--seconds", 1, "-o", "/dev/full",
                   "-o", path, status=1)
        self.assertEqual(len(path.read_text().splitlines()), 21)
        self.assertIn("warning: /dev/full: No space left on device; this output has ended\n",
                      done.stderr)
        self.assertEqual(dropped_in(done.stderr, "/dev/full"), 20)

    def test_the_last_output_that_fails_ends_a_run_that_is_not_recorded(self):
        done = run("run", "sim:", "--rig", RIGS / "paper.toml", "-o", "/dev/full", status=1)
        self.assertIn("error: /dev/full: No space left on device\n", done.stderr)

    def test_a_run_that_is_recorded_goes_on_without_outputs(self):
        recording = self.folder / "rec.csv"
        run("run", "sim:", "--rig", RIGS / "paper.toml", "--seconds", 1, "-o", "/dev/full",
            "--record", recording, status=1)
        self.assertEqual(len(read_rows(recording)), 20)

    def test_bytes_of_a_board_in_a_file_lose_no_row(self):
        stream = self.folder / "stream.bin"
        board = PROGRAM.parent / "penduline-sim-board"
        with open(stream, "wb") as file:
            subprocess.run([board, "--rig", RIGS / "paper.toml", "--link", "stdout", "--fast",
                            "--seconds", "500"], stdin=subprocess.DEVNULL, stdout=file,
                           stderr=subprocess.DEVNULL, check=True, timeout=120)
        done = run("run", f"serial:{stream}", "--rig", RIGS / "paper.toml")
        samples = int(re.search(r"(\d+) samples", done.stderr)[1])
        self.assertGreater(samples, 2 * 4096)
        self.assertEqual(len(done.stdout.splitlines()) - 1, samples)


class UdpTest(ProgramTest):
    def listen(self):
        listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(listener.close)
        listener.bind(("127.0.0.1", 0))
        listener.settimeout(30)
        return listener, f"udp:127.0.0.1:{listener.getsockname()[1]}"

    def test_each_row_is_a_datagram_with_a_timestamp(self):
        listener, address = self.listen()
        before = time.time()
        done = run("run", "sim:", "--rig", RIGS / "paper.toml", "--seconds", 1, "-o", address, "-o",
                   "-", "--format", "jsonl")
        self.assertNotIn("dropped", done.stderr)
        messages = [json.loads(listener.recv(2048)) for _ in range(20)]
        timestamps = [message.pop("timestamp") for message in messages]
        self.assertEqual(messages, [json.loads(line) for line in done.stdout.splitlines()])
        self.assertEqual(timestamps, sorted(timestamps))
        self.assertGreaterEqual(timestamps[0], before - 0.001)
        self.assertLessEqual(timestamps[-1], time.time() + 0.001)
        # 19 periods of 50 ms; a busy machine may be late.
        self.assertGreater(timestamps[-1] - timestamps[0], 0.9)

    def test_what_nobody_hears_is_counted_and_ends_nothing(self):
        listener, address = self.listen()
        listener.close()
        done = run("run", "sim:", "--rig", RIGS / "paper.toml", "--seconds", 1, "-o", address)
        self.assertEqual(dropped_in(done.stderr, address), 20)
        self.assertEqual(done.stdout, "")

    def test_network_outputs_are_for_estimates_at_their_own_pace(self):
        recording, _ = self.simulate()
        rig = ["--rig", RIGS / "paper.toml", "-o", "udp:localhost:1"]
        for arguments in (["replay", recording], ["run", "sim:", "--fast"],
                          ["run", "sim:", "--estimator", "paper"]):
            with self.subTest(arguments):
                done = run(*arguments, *rig, status=2)
                self.assertIn("--output: udp: and mqtt: are for estimates that come at their own "
                              "pace", done.stderr)

    def test_an_address_that_is_none_is_refused(self):
        done = run("run", "sim:", "--rig", "r", "-o", "udp:localhost", status=2)
        self.assertIn("--output: found 'udp:localhost', expected udp:HOST:PORT\n", done.stderr)


if __name__ == "__main__":
    unittest.main()
