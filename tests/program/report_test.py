# SPDX-License-Identifier: Apache-2.0
# `penduline report`: what of a recording stands in its page, how it ends, and what it refuses.
import base64
import hashlib
import json
import math
import os
import re
import signal
import subprocess
import unittest

from program import PROGRAM, RIGS, ProgramTest, run

RIG = RIGS / "tcrt5000.toml"
SATURATED = 1


class ReportTest(ProgramTest):
    def recording(self, *arguments, seconds=10):
        return self.simulate("--theta-deg", 6, "--seconds", seconds, *arguments, rig=RIG.name)[0]

    def report(self, recording, *options, status=0):
        """The page's text, and what the program said."""
        page = self.folder / "report.html"
        done = run("report", recording, "--rig", RIG, "--estimator", "ekf", "-o", page, *options,
                   status=status)
        self.assertEqual(done.stdout, "")
        return page.read_text(encoding="utf-8"), done.stderr

    def data(self, recording, *options, status=0):
        """What the page has inside."""
        html, _ = self.report(recording, *options, status=status)
        return json.loads(re.search(r'<script type="application/json" id="recording">(.*?)</script>',
                                    html).group(1))

    def edited(self, recording, change):
        """The recording with its lines changed by `change(row numbers by line, lines)`."""
        lines = recording.read_text().splitlines()
        rows = [i for i, line in enumerate(lines) if re.match(r"\d", line)]
        change(rows, lines)
        return self.write("edited.csv", "\n".join(lines) + "\n")

    def start(self, *arguments):
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.kill)
        return process

    def test_the_whole_recording_counts_not_its_last_sample(self):
        def saturate(rows, lines):
            for i in rows[20:32]:
                cells = lines[i].split(",")
                lines[i] = ",".join([*cells[:2], "65535", *cells[3:-1], str(int(cells[-1]) | SATURATED)])
            cells = lines[rows[40]].split(",")
            lines[rows[40]] = ",".join([*cells[:-1], str(int(cells[-1]) | SATURATED)])
            del lines[rows[100]:rows[105]]
        data = self.data(self.edited(self.recording(), saturate))
        sx, sy = data["recorded"]["sensors"]
        self.assertEqual((sx["saturated"], sy["saturated"]), (12, 0))
        self.assertEqual((sx["maybe_saturated"], sy["maybe_saturated"]), (1, 1))
        self.assertGreaterEqual(sx["out_of_range"], 12)
        self.assertEqual((sx["missing"], sy["missing"]), (0, 0))
        self.assertEqual((data["state"]["samples"], data["state"]["lost"]), (195, 5))
        self.assertEqual(data["state"]["dropouts"], 1)
        self.assertLessEqual(data["recorded"]["with_angles"], 195)
        self.assertEqual(data["state"]["sensors"], [])

    def test_ambient_light_is_told_from_the_least_to_the_greatest(self):
        def shine(rows, lines):
            for number, i in enumerate(rows):
                cells = lines[i].split(",")
                cells[3] = str(1000 + 10 * number)
                lines[i] = ",".join(cells)
        least, greatest = self.data(self.edited(self.recording(), shine))["recorded"]["sensors"][0]["ambient_v"]
        self.assertAlmostEqual(least, 1000 * 3.3 / 65535, places=9)
        self.assertAlmostEqual(greatest, 2990 * 3.3 / 65535, places=9)

    def test_events_stand_at_their_own_times(self):
        def add(rows, lines):
            first_us = int(lines[rows[0]].split(",")[1])
            lines[rows[60]] += (
                f'\n# event = {{ kind = "trigger", utc = 2026-11-21T07:00:03.1Z, host_us = 5, '
                f't_us = {first_us + 1234567}, t_uncertainty_us = 90, edge = "rising" }}'
                f'\n# event = {{ kind = "mark", utc = 2026-11-21T07:00:03.15Z, host_us = 6, '
                f't_us = {first_us + 2100000}, t_uncertainty_us = 90, text = "here" }}')
            lines[rows[0]] = (
                f'# event = {{ kind = "release", utc = 2026-11-21T07:00:00Z, host_us = 4, '
                f't_us = {first_us - 20000}, t_uncertainty_us = 90 }}\n' + lines[rows[0]])
        notes = self.data(self.edited(self.recording(), add))["notes"]
        self.assertEqual([(note["kind"], round(note["t_s"], 6)) for note in notes],
                         [("release", -0.02), ("trigger", 1.234567), ("mark", 2.1)])

    def test_an_event_after_a_restart_is_of_the_new_clock(self):
        def restart(rows, lines):
            for number, i in enumerate(rows[100:]):
                cells = lines[i].split(",")
                lines[i] = ",".join([str(number), str(50000 * (number + 1)), *cells[2:]])
            lines[rows[0]] = ('# event = { kind = "connected", utc = 2026-11-21T07:00:00Z }\n' + lines[rows[0]])
            lines[rows[100]] = (
                '# event = { kind = "boot", utc = 2026-11-21T07:00:08Z }\n'
                '# event = { kind = "release", utc = 2026-11-21T07:00:08.1Z, t_us = 150000 }\n'
                + lines[rows[100]])
        notes = self.data(self.edited(self.recording(), restart))["notes"]
        # The boot is 8 s after the first sample; the next one, at 50 ms of its clock, counts as then.
        self.assertEqual([(note["kind"], round(note["t_s"], 6)) for note in notes],
                         [("connected", 0), ("boot", 8), ("release", 8.1)])

    def test_every_note_is_kept(self):
        def mark(rows, lines):
            lines[rows[50]] += "".join(f'\n# event = {{ kind = "mark", text = "{i}" }}' for i in range(300))
        notes = self.data(self.edited(self.recording(), mark))["notes"]
        self.assertEqual([note["text"] for note in notes], [str(i) for i in range(300)])

    def test_the_first_swing_is_said_to_be_that(self):
        data = self.data(self.recording("--phi-deg", 150, seconds=30))
        span = data["recorded"]["analysed"]
        self.assertAlmostEqual(span["first_swing_to_s"] - span["from_s"], data["state"]["period_s"], places=6)
        self.assertLess(span["to_s"], 30)
        self.assertAlmostEqual(math.degrees(data["state"]["ellipse"]["orientation_rad"]), -30, delta=3)

    def test_the_page_may_run_its_own_script_and_style_and_nothing_else(self):
        html, _ = self.report(self.recording())
        policy = re.search(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">', html).group(1)
        self.assertLess(html.index("Content-Security-Policy"), html.index("<style>"))

        def source(pattern):
            text = re.search(pattern, html, re.S).group(1)
            digest = hashlib.sha256(text.encode()).digest()
            return f"'sha256-{base64.b64encode(digest).decode()}'"
        self.assertEqual(dict(part.split(" ", 1) for part in policy.split("; ")), {
            "default-src": "'none'", "script-src": source(r"<script>(.*?)</script>"),
            "style-src": source(r"<style>(.*?)</style>"), "img-src": "data:", "base-uri": "'none'",
            "form-action": "'none'"})

    def test_strict_ends_with_3_where_the_data_are_doubtful_and_writes_the_page(self):
        recording = self.edited(self.recording(), lambda rows, lines: lines.__delitem__(slice(rows[50], rows[60])))
        self.report(recording)
        (self.folder / "report.html").unlink()
        html, said = self.report(recording, "--strict", status=3)
        self.assertIn("</html>", html)
        self.assertIn("10 lost", said)
        self.report(self.recording(), "--strict")

    def test_ctrl_c_while_a_recording_is_measured_ends_at_once_without_a_page(self):
        pipe, page = self.folder / "pipe.csv", self.folder / "report.html"
        os.mkfifo(pipe)
        process = self.start("report", pipe, "--rig", RIG, "-o", page)
        with open(pipe, "w", encoding="utf-8") as file:
            file.write(self.recording().read_text())
            file.flush()
            with self.assertRaises(subprocess.TimeoutExpired):
                process.wait(timeout=1)
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(timeout=10), 1)
        self.assertIn("stopped: no report was written\n", process.stderr.read())
        self.assertFalse(page.exists())

    def test_ctrl_c_during_the_analysis_ends_soon_without_a_page(self):
        page = self.folder / "report.html"
        recording = self.recording("--rate", 39, "--psi", 3, seconds=3600)
        process = self.start("report", recording, "--rig", RIG, "--estimator", "ekf", "-o", page)
        said = ""
        while "analysing" not in said:
            said = process.stderr.readline()
            self.assertNotEqual(said, "", "it ended before the analysis")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=20), 1)
        self.assertTrue(process.stderr.read().endswith("stopped: no report was written\n"))
        self.assertFalse(page.exists())

    def test_a_page_that_cannot_be_written_is_said(self):
        recording = self.recording()
        for path, words in ((self.folder, "Is a directory"), ("/dev/full", "No space left on device")):
            with self.subTest(path=path):
                said = run("report", recording, "--rig", RIG, "-o", path, status=1).stderr
                self.assertTrue(said.endswith(f"{path}: {words}\n"), said)

    def test_what_cannot_be_reported_is_refused_in_one_line(self):
        recording = self.recording()
        before = recording.read_bytes()
        for arguments, words in (
                (("-", "--rig", RIG, "-o", "page.html"),
                 "found the standard input, expected a file: it is read more than once"),
                ((recording, "--rig", RIG, "-o", recording), "stands for two files of this run"),
                (("missing.csv", "--rig", RIG, "-o", "page.html"), "missing.csv: "),
                ((recording, "--rig", "missing.toml", "-o", "page.html"), "missing.toml: "),
                ((recording, "--rig", RIG, "-o", "none/page.html"),
                 "none/page.html: there is no folder none")):
            with self.subTest(arguments=arguments):
                said = run("report", *arguments, status=1, cwd=self.folder, stdin=subprocess.DEVNULL).stderr
                self.assertEqual(said.count("\n"), 1, said)
                self.assertIn(words, said)
        self.assertEqual(recording.read_bytes(), before)
        self.assertFalse((self.folder / "page.html").exists())


if __name__ == "__main__":
    unittest.main()
