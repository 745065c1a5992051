# SPDX-License-Identifier: Apache-2.0
# What nobody should do to `penduline run --web` is refused, while not one sample is lost.
import resource
import time
import unittest

from live_run import LiveRunTest
from program import RIGS, ProgramTest, read_rows, run
from web_client import Viewer, act, address_of, ask, connect, received

RIG = RIGS / "paper.toml"
JSON = {"X-Penduline": "1", "Content-Type": "application/json"}


class WebAbuseTest(LiveRunTest, ProgramTest):
    def setUp(self):
        super().setUp()
        self.started = self.start_run("--web", "0", "--web-recordings", self.folder, "--rate",
                                      "200", source="sim:", rig=RIG)
        _, self.port, _ = address_of(self.started)

    def tearDown(self):
        """Whatever was done: the samples are all there, one after the other."""
        self.started.wait_for_rows(self.started.count() + 20)
        said = self.finish(self.started)
        self.assertTrue(any(", 0 lost, " in line for line in said), said)
        seqs = [int(row["seq"]) for row in self.started.rows()]
        self.assertEqual(seqs, list(range(len(seqs))))
        super().tearDown()

    def status(self, *arguments, **options):
        return ask(self.port, *arguments, **options)[0]

    def test_no_path_leads_out_of_the_page(self):
        for target in ("/../etc/passwd", "/%2e%2e/etc/passwd", "/..%2fetc/passwd", "//etc/passwd",
                       "/page.js/../../x", "/./", "/recording/../mark", "/%00", "/index.html",
                       "/recording?name=/etc/passwd", "/recording/rec.csv", "*", "etc/passwd",
                       f"http://127.0.0.1:{self.port}/etc/passwd"):
            with self.subTest(target):
                status, (_, body) = ask(self.port, target)
                self.assertEqual((status, body), (404, "There is nothing here; the page is at /.\n"))

    def test_another_host_is_refused(self):
        for host in ("evil.example", f"evil.example:{self.port}", None, "", "127.0.0.2",
                     f"127.0.0.1.evil.example:{self.port}"):
            for target in ("/", "/live", "/recording"):
                with self.subTest(host=host, target=target):
                    self.assertEqual(self.status(target, headers={"Host": host}), 403)
        self.assertEqual(self.status("/", headers={"Host": f"localhost:{self.port}"}), 200)

    def test_two_hosts_are_refused(self):
        with connect(self.port) as connection:
            connection.sendall(f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{self.port}\r\n"
                               "Host: evil.example\r\nConnection: close\r\n\r\n".encode())
            self.assertIn(b" 403 ", received(connection).split(b"\r\n")[0])

    def test_another_sites_page_is_refused(self):
        for origin in ("http://evil.example", "null", "", f"https://127.0.0.1:{self.port}"):
            with self.subTest(origin):
                self.assertEqual(self.status("/live", headers={"Origin": origin}), 403)
                self.assertEqual(act(self.port, "/recording/start", headers={"Origin": origin})[0],
                                 403)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_an_action_without_its_header_or_as_a_form_is_refused(self):
        for headers, status in (({"Content-Type": "application/json"}, 403),
                                ({"X-Penduline": "0", "Content-Type": "application/json"}, 403),
                                ({"X-Penduline": "1"}, 415),
                                ({"X-Penduline": "1",
                                  "Content-Type": "application/x-www-form-urlencoded"}, 415)):
            with self.subTest(headers):
                self.assertEqual(self.status("/recording/start", method="POST", headers=headers,
                                             body="{}"), status)
        self.assertEqual(self.status("/recording/start"), 404)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_bodies_that_are_no_mark_are_refused(self):
        for body in ("", "{", "[]", "{}", '{"text": 1}', '"text"', "[" * 4000):
            with self.subTest(body[:20]):
                self.assertEqual(self.status("/mark", method="POST", headers=JSON, body=body), 400)

    def test_other_methods_are_refused(self):
        for method in ("PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT"):
            with self.subTest(method):
                self.assertEqual(self.status("/", method=method), 405)

    def test_what_is_too_large_is_refused(self):
        self.assertEqual(self.status("/", headers={"X": "x" * 100000}), 431)
        self.assertEqual(self.status("/", headers={f"X{i}": "x" for i in range(2000)}), 431)
        self.assertEqual(self.status("/" + "x" * 100000), 431)
        self.assertEqual(self.status("/mark", method="POST", headers=JSON, body="x" * 100000), 413)
        self.assertEqual(self.status("/mark", method="POST",
                                     headers={**JSON, "Content-Length": "1" + "0" * 15}), 413)

    def test_what_is_no_http_is_refused(self):
        for text in (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n", b"hello\r\n\r\n",
                     b"GET / HTTP/9.9\r\n\r\n", b"\x00" * 100 + b"\r\n\r\n"):
            with connect(self.port) as connection:
                connection.sendall(text)
                self.assertIn(b" 400 ", received(connection).split(b"\r\n")[0])

    def test_a_request_that_drips_is_cut_off(self):
        with connect(self.port) as connection:
            begin = time.monotonic()
            connection.sendall(b"GET / HTTP/1.1\r\nX: ")
            with self.assertRaises(ConnectionError):
                while time.monotonic() < begin + 20:
                    connection.sendall(b"x")
                    time.sleep(0.2)
            self.assertLess(time.monotonic() - begin, 8)

    def test_1000_connections_keep_nobody_out(self):
        files = resource.getrlimit(resource.RLIMIT_NOFILE)
        resource.setrlimit(resource.RLIMIT_NOFILE, (max(files[0], min(4096, files[1])), files[1]))
        viewer = Viewer(self.port)
        viewer.wait_for("state")
        self.assertEqual(act(self.port, "/recording/start"), (200, {}))
        first = self.started.count()
        idle = [connect(self.port) for _ in range(1000)]
        self.assertEqual(self.status("/"), 200)
        dripping = [connect(self.port) for _ in range(200)]
        for connection in dripping:
            try:
                connection.sendall(b"GET / HTTP/1.1\r\nX: ")
            except ConnectionError:
                pass  # it had to make room already
        self.assertEqual(self.status("/"), 200)
        points = viewer.wait_for("points", lambda data: data["t_s"][-1] > 1)
        self.assertTrue(points["t_s"])
        self.started.wait_for_rows(first + 400)
        self.assertEqual(act(self.port, "/recording/stop"), (200, {}))
        for connection in idle + dripping:
            connection.close()
        viewer.close()
        recording, = self.folder.iterdir()
        replayed = self.folder / "replayed.csv"
        run("replay", recording, "--rig", RIG, "-o", replayed)
        self.started.wait_for_rows(int(read_rows(recording)[-1]["seq"]) + 1)
        live = {row["seq"]: row for row in self.started.rows()}
        filled = [row for row in read_rows(replayed) if not int(row["flags"]) & 2048]
        self.assertGreater(len(filled), 300)
        for row in filled:
            self.assertEqual(row, live[row["seq"]])

    def test_viewers_beyond_the_most_are_told_so(self):
        viewers = [Viewer(self.port) for _ in range(32)]
        status, (_, body) = ask(self.port, "/live")
        self.assertEqual((status, body), (503, "32 viewers watch already, which is the most there "
                                               "may be.\n"))
        viewers.pop().close()
        end = time.monotonic() + 5
        while (again := Viewer(self.port)).head[0] != "HTTP/1.1 200 OK":
            again.close()
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)
        for viewer in [*viewers, again]:
            viewer.close()

    def test_a_viewer_that_sleeps_misses_something_and_nobody_else_does(self):
        started = self.start_run("--web", "0", "--rate", "1000", "--noise", "0.01", "-o",
                                 "/dev/null", source="sim:", rig=RIG)
        _, port, _ = address_of(started)
        viewer = Viewer(port)
        times = viewer.wait_for("points", lambda data: data["t_s"])["t_s"]
        sleeping = Viewer(port, receive_buffer_bytes=4096)
        later = 0
        while later < 80:  # events, of which 64 are kept
            times += viewer.wait_for("points")["t_s"]
            later += times[-1] > 11  # when what the system keeps of them is full
            self.started.wait_for_rows(self.started.count() + 1)  # lest its pipe be full
        # All bins of 20 ms, each with a row.
        bins = {int(t_s / 0.02 + 1e-6) for t_s in times if t_s > 0.5}
        self.assertEqual(bins, set(range(min(bins), max(bins) + 1)))
        viewer.close()
        sleeping.wait_for("state")
        latest_s = 0
        while (event := sleeping.next())[0] != "session":
            latest_s = event[1]["t_s"][-1] if event[0] == "points" else latest_s
        self.assertEqual(sleeping.next()[0], "state")
        self.assertGreater(sleeping.wait_for("points")["t_s"][0], latest_s + 3)
        sleeping.close()
        self.finish(started)


class TokenTest(LiveRunTest, ProgramTest):
    def test_beyond_loopback_actions_need_the_token(self):
        started = self.start_run("--web", "0.0.0.0:0", "--web-recordings", self.folder,
                                 source="sim:", rig=RIG)
        _, port, token = address_of(started)
        self.assertRegex(token, "^[0-9a-f]{32}$")
        viewer = Viewer(port)
        self.assertTrue(viewer.wait_for("session")["token_needed"])
        viewer.close()
        for wrong in (None, "", token[:-1], "0" * 32):
            with self.subTest(wrong):
                status, said = act(port, "/recording/start", headers={"X-Penduline-Token": wrong})
                self.assertEqual(status, 403)
                self.assertIn("token", said["error"])
        self.assertEqual(list(self.folder.iterdir()), [])
        self.assertEqual(act(port, "/recording/start", headers={"X-Penduline-Token": token}),
                         (200, {}))
        self.finish(started)


if __name__ == "__main__":
    unittest.main()
