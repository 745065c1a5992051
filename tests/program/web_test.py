# SPDX-License-Identifier: Apache-2.0
# `penduline run --web` as who watches sees it: the stream, the actions, the recordings.
import math
import pathlib
import re
import resource
import shutil
import subprocess
import time
import unittest

from live_run import LiveRunTest
from program import PROGRAM, RIGS, ProgramTest, read_rows, run
from sim_board import WITHOUT_PTS, SimBoard
from web_client import Viewer, act, address_of, ask, joined

RIG = RIGS / "paper.toml"


class WebTest(LiveRunTest, ProgramTest):
    def start(self, *options, source="sim:"):
        started = self.start_run("--web", "0", "--web-recordings", self.folder,
                                 "--case", "conical", "--theta-deg", "8", *options,
                                 source=source, rig=RIG)
        _, port, _ = address_of(started)
        return started, port

    def viewer(self, port):
        viewer = Viewer(port)
        self.addCleanup(viewer.close)
        return viewer

    def test_the_page_comes_with_headers_that_let_nothing_else_run(self):
        _, port = self.start()
        for target in ("/", "/page.js", "/page.css"):
            status, (head, body) = ask(port, target)
            self.assertEqual(status, 200)
            self.assertIn("Content-Security-Policy: default-src 'none'; script-src 'self';", head)
            self.assertIn("X-Content-Type-Options: nosniff", head)
            self.assertIn("Cache-Control: no-store", head)
            self.assertNotEqual(body, "")

    def test_a_viewer_gets_session_points_state_and_then_all_rows_as_they_are(self):
        started, port = self.start()
        started.wait_for_rows(30)
        viewer = self.viewer(port)
        self.assertIn("Content-Type: text/event-stream", viewer.head)
        name, session = viewer.next()
        self.assertEqual((name, session["source"], session["rate_hz"]), ("session", "sim:", 20))
        self.assertEqual(session["rig"]["name"], "paper")
        name, points = viewer.next()
        self.assertEqual(name, "points")
        self.assertLess(points["t_s"][-1] - points["t_s"][0], 1)
        while len(points["t_s"]) < 60:
            points = joined(points, viewer.wait_for("points"))
        started.wait_for_rows(70)
        rows = started.rows()
        by_time = {round(float(row["t_s"]), 4): row for row in rows}
        for i, t_s in enumerate(points["t_s"]):
            row = by_time[round(t_s, 4)]
            if row["theta1_rad"] == "":
                self.assertIsNone(points["theta1_rad"][i])
            else:
                self.assertAlmostEqual(points["theta1_rad"][i], float(row["theta1_rad"]), 6)
                self.assertAlmostEqual(points["x_m"][i], float(row["x_m"]), 6)
            self.assertEqual(points["flags"][i], int(row["flags"]))
        self.assertEqual(len(points["t_s"]), len({round(t_s, 4) for t_s in points["t_s"]}))

    def test_the_state_tells_the_swing(self):
        _, port = self.start("--estimator", "ekf")
        state = self.viewer(port).wait_for("state", lambda data: data["samples"] >= 100)
        # A conical pendulum of 0.3 m and 8 degrees: 2 pi sqrt(0.3 cos(8 deg) / 9.8).
        self.assertAlmostEqual(state["period_s"], 1.0940, delta=0.01)
        # The rig's damping is 0.01 /s, of which an amplitude loses half.
        decay = math.exp(-0.01 / 2 * state["samples"] / 20)
        self.assertAlmostEqual(state["amplitude_rad"], 0.1396 * decay, delta=0.003)
        self.assertAlmostEqual(state["ellipse"]["a_m"], 0.0418 * decay, delta=0.001)
        self.assertAlmostEqual(state["ellipse"]["b_m"], 0.0418 * decay, delta=0.002)
        self.assertIn(state["ellipse"]["sense"], ("left", "right"))
        self.assertEqual(state["lost"], 0)
        self.assertTrue(state["connected"])

    def test_a_recording_begun_on_the_page_replays_to_the_rows_of_the_run(self):
        started, port = self.start()
        started.wait_for_rows(10)
        viewer = self.viewer(port)
        self.assertEqual(act(port, "/recording/start"), (200, {}))
        session = viewer.wait_for("session", lambda data: data["recording"])
        name = session["recording"]["name"]
        self.assertRegex(name, r"^penduline-\d{8}T\d{6}Z\.csv$")
        self.assertEqual(session["download"], name)
        status, said = act(port, "/recording/start")
        self.assertEqual(status, 409)
        self.assertIn("under way already", said["error"])
        started.wait_for_rows(started.count() + 20)
        self.assertEqual(act(port, "/mark", {"text": "here\nit is"}), (200, {}))
        self.assertEqual(viewer.wait_for("note", lambda data: data["kind"] == "mark")["text"],
                         "here it is")
        started.wait_for_rows(started.count() + 30)
        self.assertEqual(act(port, "/recording/stop"), (200, {}))
        self.assertEqual(act(port, "/recording/stop")[0], 409)
        status, (head, body) = ask(port, "/recording")
        self.assertEqual(status, 200)
        self.assertIn(f'Content-Disposition: attachment; filename="{name}"', head)
        recording = self.folder / name
        self.assertEqual(body, recording.read_text())
        self.assertRegex(body, r'# event = \{ kind = "mark", utc = \S+, host_us = \d+, '
                               r'text = "here it is" \}')
        self.finish(started)
        replayed = self.folder / "replayed.csv"
        run("replay", recording, "--rig", RIG, "-o", replayed)
        live = {row["seq"]: row for row in started.rows()}
        filled = [row for row in read_rows(replayed) if not int(row["flags"]) & 2048]
        self.assertGreater(len(filled), 30)
        for row in filled:
            self.assertEqual(row, live[row["seq"]])

    def record_on_a_small_disk(self):
        """A run whose recording soon finds no more room, its port, a viewer."""
        started, port = self.start("--rate", "1000", "-o", "/dev/null")
        resource.prlimit(started.process.pid, resource.RLIMIT_FSIZE,
                         (20_000, resource.RLIM_INFINITY))
        viewer = self.viewer(port)
        self.assertEqual(act(port, "/recording/start"), (200, {}))
        return started, port, viewer

    def test_a_full_disk_is_told_to_viewers(self):
        started, port, viewer = self.record_on_a_small_disk()
        path = rf"{self.folder}/penduline-\S+\.csv"
        full = viewer.wait_for("note", lambda data: data["kind"] == "warning")
        self.assertRegex(full["text"], f"^{path}: File too large; sampling goes on, and recording "
                                       "will when it can$")
        resource.prlimit(started.process.pid, resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY,) * 2)
        again = viewer.wait_for("note", lambda data: data["kind"] == "warning")
        self.assertRegex(again["text"], f"^{path}: recording goes on; 0 samples are missing in it$")
        self.finish(started)

    def test_why_a_recording_failed_stands_in_its_last_note(self):
        started, port, viewer = self.record_on_a_small_disk()
        viewer.wait_for("note", lambda data: data["kind"] == "warning")
        status, said = act(port, "/recording/stop")
        self.assertEqual(status, 409)
        self.assertRegex(said["error"], "File too large$")
        ended = viewer.wait_for("note", lambda data: data["text"].startswith("Recording has ended"))
        self.assertRegex(ended["text"], r"^Recording has ended: recorded \d+ samples in \S+, lost "
                                        rf"\d+; {said['error']}\.$")
        self.finish(started)

    def test_without_a_network_the_address_of_this_machine_is_printed(self):
        alone = ["unshare", "--map-root-user", "--net"]
        if not shutil.which("unshare") or subprocess.run([*alone, "true"], check=False,
                                                         capture_output=True).returncode != 0:
            self.skipTest("found no right to a network of one's own (unshare --net)")
        done = subprocess.run([*alone, PROGRAM, "run", "sim:", "--rig", RIG, "--seconds", "0.2",
                               "--web", "0.0.0.0:8080"], check=True, capture_output=True, text=True)
        self.assertRegex(done.stderr, r"live page: http://127\.0\.0\.1:8080/#token=")

    def test_the_recording_of_the_command_line_is_the_one_shown_and_goes_on_from_there(self):
        path = self.folder / "rec.csv"
        started, port = self.start("--record", path)
        viewer = self.viewer(port)
        session = viewer.wait_for("session", lambda data: data["recording"])
        self.assertEqual(session["recording"]["name"], "rec.csv")
        started.wait_for_rows(10)
        self.assertEqual(act(port, "/recording/stop"), (200, {}))
        self.assertIsNone(viewer.wait_for("session")["recording"])
        self.assertEqual(act(port, "/recording/start"), (200, {}))
        self.assertEqual(viewer.wait_for("session")["recording"]["name"], "rec-0002.csv")
        said = self.finish(started)
        self.assertTrue(any(re.search(r"recorded \d+ samples in .*rec-0002.csv$", line)
                            for line in said), said)
        self.assertGreaterEqual(len(read_rows(path)), 9)

    def test_a_recording_on_the_standard_output_is_not_the_pages(self):
        started, port = self.start("--record", "-", "-o", self.folder / "angles.csv")
        self.assertFalse(self.viewer(port).wait_for("session")["can_record"])
        self.assertEqual(act(port, "/recording/stop")[0], 409)
        self.assertEqual(ask(port, "/recording")[0], 404)
        self.finish(started)

    def test_the_download_of_a_recording_that_grows_has_whole_lines(self):
        started, port = self.start("--rate", "1000")
        self.assertEqual(act(port, "/recording/start"), (200, {}))
        columns = None
        for _ in range(10):
            time.sleep(0.2)
            status, (_, body) = ask(port, "/recording")
            self.assertEqual(status, 200)
            self.assertTrue(body.endswith("\n"))
            rows = [line for line in body.splitlines() if line and not line.startswith("#")]
            columns = columns or rows[0].count(",")
            self.assertEqual({row.count(",") for row in rows}, {columns})
        self.finish(started)

    def test_at_1_khz_the_stream_is_thinned_and_every_extreme_is_there(self):
        started, port = self.start("--rate", "1000", "--noise", "0.01")
        viewer = self.viewer(port)
        viewer.wait_for("state", lambda data: data["samples"] > 3000)
        points, _ = self.viewer(port).greeting()
        started.wait_for_rows(2500)
        thinned = {round(t_s, 4): i for i, t_s in enumerate(points["t_s"])}
        self.assertLess(len(thinned), 0.7 * 1000 * points["t_s"][-1])
        bins = {}
        for row in started.rows():
            t_s = round(float(row["t_s"]), 4)
            if row["theta1_rad"] != "" and 0.5 <= t_s < 2:
                bins.setdefault(int(t_s / 0.02 + 1e-6), []).append((t_s, float(row["theta1_rad"])))
        self.assertGreater(len(bins), 70)
        for rows in bins.values():
            for t_s, _ in (min(rows, key=lambda row: row[1]), max(rows, key=lambda row: row[1])):
                self.assertIn(t_s, thinned)

    def test_a_port_that_is_taken_and_a_wrong_one_are_told(self):
        _, port = self.start()
        said = run("run", "sim:", "--rig", RIG, "--web", port, status=1).stderr
        self.assertEqual(said, f"error: --web 127.0.0.1:{port}: Address already in use\n")
        said = run("run", "sim:", "--rig", RIG, "--web", "http", status=2).stderr
        self.assertIn("--web: found 'http', expected [ADDR:]PORT", said)
        said = run("run", "sim:", "--rig", RIG, "--web", "0", "--estimator", "paper",
                   status=2).stderr
        self.assertIn("--web: shows rows as they come", said)

    def test_what_runs_as_fast_as_it_can_is_shown_in_bounded_memory(self):
        started, port = self.start("--fast", "-o", "/dev/null")
        viewer = self.viewer(port)
        viewer.wait_for("state", lambda data: data["samples"] > 500000)
        status = pathlib.Path(f"/proc/{started.process.pid}/status").read_text()
        # A sanitizer keeps 256 MB of what was freed.
        most_kb = 450000 if b"__asan_init" in PROGRAM.read_bytes() else 150000
        self.assertLess(int(re.search(r"VmRSS:\s+(\d+) kB", status)[1]), most_kb)
        points, _ = self.viewer(port).greeting()
        self.assertLessEqual(points["t_s"][-1] - points["t_s"][0], 60)
        started.interrupt()
        self.assertEqual(started.end()[0], 0)


@unittest.skipIf(WITHOUT_PTS, "needs pseudo-terminals")
class BoardTest(LiveRunTest, ProgramTest):
    def test_the_page_is_there_before_the_board(self):
        port = self.folder / "board"
        started = self.start_run("--web", "0", "--web-recordings", self.folder,
                                 source=f"serial:{port}", rig=RIG)
        _, web, _ = address_of(started)
        viewer = Viewer(web)
        self.addCleanup(viewer.close)
        session = viewer.wait_for("session")
        self.assertEqual([session[key] for key in ("board", "rate_hz", "reference_v", "recording")],
                         [None] * 4)
        state = viewer.wait_for("state")
        self.assertEqual((state["connected"], state["samples"], state["sensors"]), (False, 0, []))
        refusal = {"error": "There are no samples yet: the board is not there."}
        self.assertEqual(act(web, "/recording/start"), (409, refusal))
        self.assertEqual(act(web, "/mark", {"text": "too early"}), (409, refusal))
        board = SimBoard(port)
        self.addCleanup(board.close)
        self.assertEqual(viewer.wait_for("session", lambda data: data["board"])["rate_hz"], 20)
        self.assertTrue(viewer.wait_for("state", lambda data: data["samples"])["connected"])
        self.assertEqual(act(web, "/recording/start"), (200, {}))
        self.assertEqual(act(web, "/mark", {"text": "now"}), (200, {}))
        self.assertEqual(viewer.wait_for("note", lambda data: data["kind"] == "mark")["text"], "now")
        self.finish(started)

    def test_a_run_that_is_stopped_while_it_waits_has_ended_well(self):
        started = self.start_run("--web", "0", source=f"serial:{self.folder / 'none'}", rig=RIG)
        address_of(started)
        self.finish(started)

    def test_a_board_that_starts_anew_is_told_and_the_time_goes_on(self):
        port = self.folder / "board"
        board = SimBoard(port)
        self.addCleanup(board.close)
        started = self.start_run("--web", "0", "--web-recordings", self.folder,
                                 source=f"serial:{port}", rig=RIG)
        _, web, _ = address_of(started)
        viewer = Viewer(web)
        self.addCleanup(viewer.close)
        session = viewer.wait_for("session", lambda data: data["board"])
        self.assertEqual((session["board"], session["rate_hz"]), ("sim", 20))
        self.assertRegex(viewer.wait_for("state", lambda data: data["clock"])["clock"],
                         "^the board's clock is ")
        self.assertEqual(act(web, "/recording/start"), (200, {}))
        self.assertEqual(act(web, "/mark", {"text": "before"}), (200, {}))
        viewer.wait_for("note", lambda data: data["kind"] == "mark")  # while the board is there
        last_s = viewer.wait_for("points")["t_s"][-1]
        board.close()
        self.assertFalse(viewer.wait_for("state", lambda data: not data["connected"])["connected"])
        again = SimBoard(port)
        self.addCleanup(again.close)
        restarted = viewer.wait_for("state", lambda data: data["restarts"] == 1 and data["samples"])
        self.assertTrue(restarted["connected"])
        points = viewer.wait_for("points", lambda data: data["t_s"][-1] > last_s + 1)
        self.assertEqual(points["t_s"], sorted(points["t_s"]))
        greeting = Viewer(web)
        self.addCleanup(greeting.close)
        points, notes = greeting.greeting()
        self.assertEqual(points["t_s"], sorted(set(points["t_s"])))
        kinds = [note["kind"] for note in notes]
        self.assertEqual(kinds.count("connected"), 2)  # at the beginning, and again
        self.assertIn("mark", kinds)
        self.assertIn("disconnected", kinds)
        self.assertEqual(act(web, "/recording/stop"), (200, {}))
        body = ask(web, "/recording")[1][1]
        # As a trigger's: the host's time and the board's.
        self.assertRegex(body, r'kind = "mark", utc = \S+, host_us = \d+, t_us = \d+, '
                               r't_uncertainty_us = \d+, text = "before"')
        self.finish(started)


if __name__ == "__main__":
    unittest.main()
