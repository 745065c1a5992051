# SPDX-License-Identifier: Apache-2.0
# Recordings of `penduline run`: whole lines after kill -9 and on full disks, files in series.
import datetime
import random
import resource
import shutil
import signal
import subprocess
import time
import tomllib
import unittest

from program import PROGRAM, RIGS, ProgramTest, read_rows, run
import wire

RIG = RIGS / "tcrt5000.toml"
NAMES = "seq,t_us,x_on,x_off,y_on,y_off,flags"
PATIENCE_S = 60


class RecordTest(ProgramTest):
    def start(self, *arguments, **options):
        """Starts an endless simulation that records to rec.csv."""
        process = subprocess.Popen(
            [PROGRAM, "run", "sim:", "--rig", RIG, "--record", self.folder / "rec.csv", "-o",
             "/dev/null", *map(str, arguments)], stderr=subprocess.PIPE, text=True, **options)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_for(self, condition):
        deadline = time.monotonic() + PATIENCE_S
        while not condition():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.002)

    def assert_whole(self, path):
        """Checks a recording byte by byte; returns how many samples it has."""
        text = path.read_text()
        self.assertTrue(text.startswith("# penduline_recording = 1\n"))
        head, rows = text.split(NAMES + "\n")
        self.assertIn('# firmware = "', head)
        self.assertTrue(text.endswith("\n"), f"ends with {text[-50:]!r}")
        lines = [line for line in rows.splitlines() if line and not line.startswith("#")]
        for seq, line in enumerate(lines):
            cells = line.split(",")
            self.assertEqual((len(cells), cells[0]), (7, str(seq)), line)
        return len(lines)

    def test_every_line_is_whole_after_kill_9_at_any_moment(self):
        rng = random.Random(4)
        path = self.folder / "rec.csv"
        samples = 0
        for fast in [True] * 20 + [False] * 10:
            process = self.start("--rate", 1000, *["--fast"] * fast)
            self.wait_for(path.exists)
            time.sleep(rng.uniform(0, 0.05))
            process.kill()
            process.wait()
            samples += self.assert_whole(path)
            path.unlink()
        self.assertGreater(samples, 1000)

    def test_a_recording_is_there_with_its_whole_head_or_not_at_all(self):
        rng = random.Random(5)
        path = self.folder / "rec.csv"
        for _ in range(30):
            process = self.start()
            time.sleep(rng.uniform(0, 0.02))
            process.kill()
            process.wait()
            if path.exists():
                self.assert_whole(path)
                path.unlink()
            self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_disk_that_is_full_for_a_while_stops_nothing(self):
        path = self.folder / "rec.csv"
        process = self.start("--rate", 1000, preexec_fn=lambda: resource.setrlimit(
            resource.RLIMIT_FSIZE, (20_000, resource.RLIM_INFINITY)))
        self.assertEqual(process.stderr.readline(),
                         f"warning: {path}: File too large; sampling goes on, and recording will "
                         "when it can\n")
        full = self.assert_whole(path)
        time.sleep(0.2)
        self.assertEqual(self.assert_whole(path), full)
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY,) * 2)
        self.wait_for(lambda: path.stat().st_size > 40_000)
        time.sleep(1.1)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=PATIENCE_S)
        self.assertIn(f"warning: {path}: recording goes on; 0 samples are missing in it\n", said)
        recorded = self.assert_whole(path)
        self.assertIn(f"info: recorded {recorded} samples in {path}\n", said)
        self.assertIn(f"info: {recorded} samples at 1000.000 Hz, 0 lost", said)

    def test_a_small_file_system_that_fills_up_and_is_cleared(self):
        if not shutil.which("unshare") or subprocess.run(
                ["unshare", "--map-root-user", "--mount", "true"], check=False,
                capture_output=True).returncode != 0:
            self.skipTest("found no right to mount a file system of one's own (unshare --mount)")
        small = self.folder / "small"
        small.mkdir()
        done = subprocess.run(
            ["unshare", "--map-root-user", "--mount", "bash", "-euc", """
                mount -t tmpfs -o size=1m tmpfs "$1"
                cd "$1"
                head -c 1000000 /dev/zero > ballast
                "$2" run sim: --rig "$3" --rate 1000 --record rec.csv -o /dev/null 2> "$4" &
                trap 'kill -9 $!' EXIT
                until grep -q "No space left on device" "$4"; do sleep 0.01; done
                tail -c 1 rec.csv | od -An -c
                rm ballast
                until [ "$(wc -c < rec.csv)" -gt 100000 ]; do sleep 0.01; done
                sleep 1.2
                kill -TERM $!
                wait $!
                trap - EXIT
                echo rows:
                grep -c '^[0-9]' rec.csv
                grep '^[0-9]' rec.csv | cut -d, -f1 | awk '$1 != NR - 1 { exit 1 }'
            """, "bash", small, PROGRAM, RIG, self.folder / "said"],
            capture_output=True, text=True, check=False, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, 0, done.stderr)
        last_byte, rows = done.stdout.split("rows:\n")
        self.assertEqual(last_byte.strip(), "\\n")
        said = (self.folder / "said").read_text()
        self.assertEqual(said.count("No space left on device"), 1)
        self.assertIn(f"recorded {int(rows)} samples in rec.csv", said)

    def test_a_full_disk_ends_a_simulation_as_fast_as_possible(self):
        done = run("run", "sim:", "--rig", RIG, "--fast", "--seconds", 1000, "--record", "rec.csv",
                   "-o", "/dev/null", status=1, cwd=self.folder, preexec_fn=lambda:
                   resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000)))
        self.assertTrue(done.stderr.endswith("error: rec.csv: File too large\n"), done.stderr)
        self.assert_whole(self.folder / "rec.csv")

    def test_a_recording_that_is_there_is_kept(self):
        first = self.write("rec.csv", "years of work\n")
        done = run("run", "sim:", "--rig", RIG, "--fast", "--seconds", 1, "--record", "rec.csv",
                   cwd=self.folder)
        self.assertEqual(first.read_text(), "years of work\n")
        self.assertIn("info: recording in rec-0002.csv\n", done.stderr)
        self.assertEqual(self.assert_whole(self.folder / "rec-0002.csv"), 20)

    def test_files_of_a_series_replay_together_as_the_run_was(self):
        live = run("run", "sim:", "--rig", RIG, "--fast", "--seconds", 60, "--record", "rec.csv",
                   "--record-every", "20s,20kB", cwd=self.folder)
        parts = sorted(self.folder.glob("rec-*.csv"))
        self.assertEqual([part.name for part in parts],
                         ["rec-0001.csv", "rec-0002.csv", "rec-0003.csv"])
        self.assertEqual([len(read_rows(part)) for part in parts], [400] * 3)
        joined = "".join(part.read_text() for part in parts)
        self.assertEqual(run("replay", "-", "--rig", RIG, input=joined).stdout, live.stdout)

    def test_pandas_reads_a_recording_with_fillers_and_events(self):
        try:
            import pandas  # pylint: disable=import-outside-toplevel
        except ImportError:
            self.skipTest("found no pandas (Debian's python3-pandas)")
        path = self.folder / "rec.csv"
        run("run", "sim:", "--rig", RIG, "--fast", "--seconds", 60, "--record", path)
        text = path.read_text()
        self.assertIn("\n#   ", text)
        with_event = self.write("event.csv", text.replace(
            "\n500,", '\n# event = { kind = "release", note = "x, \\"y\\" #" }\n500,'))
        for recording in (path, with_event):
            table = pandas.read_csv(recording, comment="#")
            self.assertEqual(",".join(table.columns), NAMES)
            self.assertEqual(list(table.seq), list(range(1200)))
            self.assertEqual({str(kind) for kind in table.dtypes}, {"int64"})

    def test_a_board_that_starts_anew_replays_as_it_ran(self):
        recording, _ = self.simulate("--seconds", 5, rig="tcrt5000.toml")
        head, rows = recording.read_text().split(NAMES + "\n")
        rows = rows.splitlines(keepends=True)
        # The host missed the first three samples after the start.
        text = "".join([head, NAMES, "\n", *rows[40:], '# event = { kind = "boot", boot_id = 8 }\n',
                        *rows[3:50]])
        path = self.write("restarted.csv", text)
        live = run("run", f"file:{path}", "--fast", "--rig", RIG, "--record", "copy.csv",
                   cwd=self.folder)
        self.assertIn("flagged: 1 restarted, ", live.stderr)
        self.assertEqual(run("replay", path, "--rig", RIG).stdout, live.stdout)
        self.assertEqual(run("replay", self.folder / "copy.csv", "--rig", RIG).stdout, live.stdout)

    def test_the_recording_of_a_board_says_which_and_when_where_that_is_known(self):
        frames = self.folder / "frames"
        frames.write_bytes(subprocess.run(
            [PROGRAM.parent / "penduline-sim-board", "--rig", RIG, "--link", "stdout", "--fast",
             "--seconds", "3"], stdin=subprocess.DEVNULL, capture_output=True, check=True,
            timeout=PATIENCE_S).stdout)
        stored = run("run", f"serial:{frames}", "--rig", RIG, "--record", self.folder / "rec.csv")
        path = self.folder / "rec.csv"
        self.assertEqual(self.assert_whole(path), 59)
        head = tomllib.loads(path.read_text().split(NAMES)[0].replace("# ", ""))
        hello = wire.Splitter().messages(frames.read_bytes())[0]
        self.assertEqual(head["serial"], bytes(hello.unique_id).hex().upper())
        self.assertEqual(head["boot_id"], hello.boot_id)
        self.assertNotIn("started", head)  # nobody knows when the bytes were stored
        self.assertEqual(run("replay", path, "--rig", RIG).stdout, stored.stdout)

        before = datetime.datetime.now(datetime.timezone.utc).replace(microsecond=0)
        with subprocess.Popen(["cat", frames], stdout=subprocess.PIPE) as pipe:
            run("run", "serial:-", "--rig", RIG, "--record", self.folder / "live.csv",
                stdin=pipe.stdout)
        text = (self.folder / "live.csv").read_text()
        started = tomllib.loads(text.split(NAMES)[0].replace("# ", ""))["started"]
        self.assertLessEqual(before, started)
        self.assertLess(started - before, datetime.timedelta(seconds=60))

    def test_wrong_options_of_a_recording_are_told(self):
        for option, value in (("--record-every", "1"), ("--record-every", "1h,2h"),
                              ("--record-every", "5kB"), ("--fsync", "0s")):
            done = run("run", "sim:", "--rig", RIG, "--record", "rec.csv", option, value, status=2)
            self.assertIn(f"{option}: found '{value.split(',')[-1]}', expected ", done.stderr)
        done = run("run", "sim:", "--rig", RIG, "--fsync", "1s", status=2)
        self.assertIn("--fsync requires --record", done.stderr)

    def test_the_standard_output_can_be_recorded_to(self):
        done = run("run", "sim:", "--rig", RIG, "--fast", "--seconds", 10, "--record", "-", "-o",
                   self.folder / "angles.csv")
        path = self.write("rec.csv", done.stdout)
        self.assertEqual(self.assert_whole(path), 200)


if __name__ == "__main__":
    unittest.main()
