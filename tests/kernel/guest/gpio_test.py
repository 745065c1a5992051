# SPDX-License-Identifier: Apache-2.0
# `penduline run` at work with GPIO lines: the magnet's release, the light, and the trigger's edges.
import pathlib
import signal
import subprocess
import time
import tomllib
import unittest

import bench
import lines


def recorded():
    """The events and the samples of the recording."""
    events, samples = [], []
    for line in lines.RECORDING.read_text(encoding="utf-8").splitlines():
        if line.startswith("# event = "):
            events.append(tomllib.loads(line[2:])["event"])
        elif line[0].isdigit():
            samples.append([int(cell) for cell in line.split(",")])
    return events, samples


def of_kind(events, kind):
    return [event for event in events if event["kind"] == kind]


def link_before(events, event):
    """The events of the link to the board that stand before this one."""
    link = []
    for other in events[:events.index(event)]:
        link = [] if other["kind"] == "disconnected" else [*link, other]
    return link


class RunWithLinesTest(lines.LinesTest):
    def assert_board_time_is_right(self, events, event):
        """The event's t_us is its host_us by the quickest Pong before it, whose way back may have taken all the
        round trip or none, within the uncertainty that it states."""
        pong = min(of_kind(link_before(events, event), "pong"),
                   key=lambda pong: pong["received_us"] - pong["sent_us"])
        t_us = event["host_us"] + pong["t_us"] - (pong["sent_us"] + pong["received_us"]) // 2
        round_trip_us = pong["received_us"] - pong["sent_us"]
        # Of a guest that is slow to wake up at its first Pong; usually it is below a millisecond.
        self.assertLess(event["t_uncertainty_us"], 50e3)
        # The simulated board is a process: its clock lags by some milliseconds where the guest is busy.
        lag_us = 20e3
        self.assertAlmostEqual(event["t_us"], t_us,
                               delta=event["t_uncertainty_us"] + round_trip_us / 2 + lag_us)


class ReleaseTest(RunWithLinesTest):
    def test_the_magnet_holds_from_the_start_and_lets_go_at_the_moment_that_is_recorded(self):
        run = self.run_with_lines("--release", "2", "--record", lines.RECORDING)
        bench.wait_until(self.magnet.level, "the magnet")
        watch = self.start(lines.Watch, self.magnet)
        self.start(bench.SimulatedBoard)
        run.wait_for_rows(60)
        self.assertIn("info: the magnet has let go", self.interrupt(run))
        self.assertEqual(watch.levels(), [0])
        events, samples = recorded()
        (release,) = of_kind(events, "release")
        seen_us = watch.changes[0][0] * 1e6
        self.assertAlmostEqual(release["host_us"], seen_us, delta=50e3)
        self.assert_board_time_is_right(events, release)
        # A sample is on its way for some milliseconds, for longer in a guest that is slow to wake up.
        self.assertAlmostEqual(release["t_us"] - samples[0][1], 2e6, delta=100e3)
        self.assertAlmostEqual(release["utc"].timestamp() - release["host_us"] / 1e6,
                               time.time() - time.monotonic(), delta=20e-3)

    def test_without_the_option_the_magnet_is_left_alone(self):
        watch = self.start(lines.Watch, self.magnet)
        self.start(bench.SimulatedBoard)
        run = self.run_with_lines()
        run.wait_for_rows(5)
        self.interrupt(run)
        self.assertEqual(watch.changes, [])


class LightTest(lines.LinesTest):
    def test_the_light_is_lit_while_samples_come(self):
        watch = self.start(lines.Watch, self.led)
        run = self.run_with_lines()
        time.sleep(1)
        self.assertEqual(watch.levels(), [])
        self.start(bench.SimulatedBoard)
        run.wait_for_rows(40)
        self.assertEqual(watch.levels(), [1])
        bench.unplug()
        bench.wait_until(lambda: watch.levels() == [1, 0], "the light to go out")
        time.sleep(1)
        self.plug()
        self.start(bench.SimulatedBoard)
        bench.wait_until(lambda: watch.levels() == [1, 0, 1], "the light to come back")
        self.interrupt(run)
        bench.wait_until(lambda: watch.levels() == [1, 0, 1, 0], "the light to go out")


class TriggerTest(RunWithLinesTest):
    def edges(self, count, width_s=0.02):
        """Pulses of the trigger; the moments before and after each one's rising edge, in us."""
        moments = []
        for _ in range(count):
            before = time.monotonic()
            self.trigger.pull("up")
            moments.append((before * 1e6 - 1, time.monotonic() * 1e6))
            time.sleep(width_s)
            self.trigger.pull("down")
            time.sleep(width_s)
        return moments

    def test_each_rising_edge_is_recorded_with_its_moment_also_while_the_board_is_away(self):
        run = self.run_with_lines("--record", lines.RECORDING)
        self.start(bench.SimulatedBoard)
        run.wait_for_rows(30)
        moments = self.edges(5)
        bench.unplug()
        bench.wait_until(lambda: not bench.PORT.exists(), "the port to go")
        time.sleep(0.5)
        moments += self.edges(40)
        self.plug()
        self.start(bench.SimulatedBoard)
        run.wait_for_rows(len(run.rows()) + 30)
        moments += self.edges(5)
        run.wait_for_rows(len(run.rows()) + 5)
        said = self.interrupt(run)
        self.assertFalse([line for line in said if "trigger" in line])
        events, _ = recorded()
        triggers = of_kind(events, "trigger")
        self.assertEqual(len(triggers), 50)
        for event, (before, after) in zip(triggers, moments):
            self.assertEqual(event["edge"], "rising")
            self.assertNotIn("queue", event)
            self.assertTrue(before <= event["host_us"] <= after, (before, event, after))
        for event in triggers[:5] + triggers[45:]:
            self.assert_board_time_is_right(events, event)
        self.assertFalse([event for event in triggers[5:45] if "t_us" in event])
        kinds = [event["kind"] for event in events]
        self.assertEqual(kinds[kinds.index("disconnected") + 1:][:40], ["trigger"] * 40)
        self.assert_replay_is(run)

    def assert_replay_is(self, run):
        """A replay gives the live run's rows, whatever events stand among the samples."""
        replayed = subprocess.run([bench.PROGRAM, "replay", lines.RECORDING, "--rig", lines.RIG],
                                  capture_output=True, check=True, timeout=30)
        self.assertEqual(replayed.stdout, run.output)

    def test_of_a_trigger_that_is_active_low_the_falling_edges_are_recorded(self):
        lines.write_rig('[gpio]\ntrigger = { line = "penduline-trigger", active_low = true }\n')
        self.trigger.pull("up")
        self.start(bench.SimulatedBoard)
        run = self.run_with_lines("--record", lines.RECORDING)
        run.wait_for_rows(5)
        before = time.monotonic() * 1e6 - 1
        self.trigger.pull("down")
        after = time.monotonic() * 1e6
        time.sleep(0.2)
        self.trigger.pull("up")
        time.sleep(0.2)
        self.interrupt(run)
        (event,) = of_kind(recorded()[0], "trigger")
        self.assertEqual(event["edge"], "falling")
        self.assertTrue(before <= event["host_us"] <= after)

    def test_edges_that_the_kernel_has_no_room_for_are_told_and_marked(self):
        self.start(bench.SimulatedBoard)
        run = self.run_with_lines("--record", lines.RECORDING)
        run.wait_for_rows(5)
        run.process.send_signal(signal.SIGSTOP)
        tasks = pathlib.Path(f"/proc/{run.process.pid}/task")
        bench.wait_until(lambda: all(") T " in status.read_text(encoding="utf-8")
                                     for status in tasks.glob("*/stat")), "all threads to stop")
        self.edges(20, width_s=0.001)
        run.process.send_signal(signal.SIGCONT)
        run.wait_for_rows(len(run.rows()) + 20)
        self.edges(1)
        run.wait_for_rows(len(run.rows()) + 5)
        said = self.interrupt(run)
        self.assertEqual(len([line for line in said if line.startswith(
            "warning: trigger edges came faster than they were taken")]), 1)
        triggers = of_kind(recorded()[0], "trigger")
        self.assertEqual([event.get("queue") for event in triggers], [None] * 15 + ["full", None])


if __name__ == "__main__":
    unittest.main()
