# SPDX-License-Identifier: Apache-2.0
# `penduline replay` as a user meets it: rows, messages, exit statuses, memory.
import json
import os
import subprocess
import unittest

from program import PROGRAM, RIGS, ProgramTest, read_rows, run

HEAD = """# penduline_recording = 1
# rate_hz = 20.0
# full_scale_counts = 65535
# reference_v = 3.3
seq,t_us,x_on,x_off,y_on,y_off,flags
"""
ROW = "{},{},33000,0,33000,0,0\n"


def recording(seqs):
    """A recording of a pendulum at rest with the sequence numbers given."""
    return HEAD + "".join(ROW.format(seq, 50000 * seq) for seq in seqs)


class ReplayTest(ProgramTest):
    def replay(self, text, *arguments, status=0):
        path = self.write("rec.csv", text)
        done = run("replay", path, "--rig", RIGS / "paper.toml", *arguments, status=status)
        done.stderr = done.stderr.replace(str(self.folder) + "/", "")
        return done

    def assert_message(self, text, message):
        done = self.replay(text, status=1)
        self.assertEqual(done.stderr.strip().splitlines()[-1], "error: " + message)

    def test_writes_one_row_a_sample(self):
        done = self.replay(recording(range(20)))
        lines = done.stdout.splitlines()
        self.assertEqual(lines[0], "t_s,seq,theta1_rad,theta2_rad,x_m,y_m,z_m,omega1_rad_s,"
                         "omega2_rad_s,sigma1_rad,sigma2_rad,residual_m,flags")
        self.assertEqual(len(lines), 21)
        self.assertEqual(lines[1], "-0.375000,0,,,,,,,,,,,2048")

    def test_summary_goes_to_stderr(self):
        done = self.replay(recording(range(20)))
        self.assertEqual(done.stderr, "info: 20 samples at 20.000 Hz, 0 lost, 5 with angles; "
                         "flagged: 15 filling\n")

    def test_json_lines_have_the_names_and_numbers_of_the_csv(self):
        text = recording(range(20))
        rows = self.replay(text).stdout.splitlines()
        names, cells = rows[0].split(","), rows[-1].split(",")
        last = json.loads(self.replay(text, "--format", "jsonl").stdout.splitlines()[-1])
        self.assertEqual(list(last), names)
        for name, cell in zip(names, cells):
            self.assertEqual(last[name], float(cell) if cell else None)

    def test_reads_the_standard_input(self):
        text = recording(range(20))
        done = run("replay", "-", "--rig", RIGS / "paper.toml", input=text)
        self.assertEqual(done.stdout, self.replay(text).stdout)

    def test_a_dropout_is_flagged_counted_and_not_bridged(self):
        done = self.replay(recording([*range(20), *range(23, 43)]))
        self.assertIn("rec.csv:26: seq 23, t_us 1150000: samples are lost before this one, or "
                      "sampling paused [dropout]",
                      done.stderr)
        self.assertIn("40 samples at 20.000 Hz, 3 lost, 10 with angles", done.stderr)
        rows = done.stdout.splitlines()
        self.assertTrue(rows[21].endswith(",,,,,,,,,,,2304"))  # dropout 256, filling 2048

    def test_a_seq_that_goes_back_is_flagged_with_its_line(self):
        done = self.replay(recording([*range(20), *range(5)]))
        self.assertIn("rec.csv:26: seq 0, t_us 0: seq or t_us went back although the device did not "
                      "restart [out_of_order]", done.stderr)

    def test_a_reading_that_is_missing_is_flagged_and_costs_its_window(self):
        text = recording(range(40)).replace("20,1000000,33000,0,", "20,1000000,nan,0,")
        done = self.replay(text)
        self.assertIn("rec.csv:26: seq 20, t_us 1000000: the sample lacks a sensor's reading "
                      "[missing]", done.stderr)
        empty = [row for row in done.stdout.splitlines()[1:] if row.split(",")[2] == ""]
        self.assertEqual(len(empty), 15 + 1 + 15)

    def test_strict_ends_with_3_where_the_data_is_doubtful(self):
        self.replay(recording([0, 1, 3]), "--strict", status=3)

    def test_strict_ends_with_0_where_it_is_not(self):
        self.replay(recording(range(20)), "--strict", status=0)

    def test_a_last_line_cut_short_is_said_and_not_used(self):
        done = self.replay(recording(range(20))[:-4], "--strict", status=3)
        self.assertIn("warning: rec.csv:25: the last line is cut short ('19,950000,33000,0,33000,') "
                      "and not used", done.stderr)
        self.assertIn("19 samples", done.stderr)

    def test_text_in_a_number(self):
        self.assert_message(recording(range(3)).replace("2,100000,33000", "2,100000,abc"),
                            "rec.csv:8: field 'x_on': found 'abc', expected a whole number from 0 "
                            "to 65535")

    def test_rows_before_a_failure_are_written(self):
        text = recording(range(20)) + "20,abc,1,1,1,1,0\n"
        done = self.replay(text, status=1)
        self.assertEqual(len(done.stdout.splitlines()), 21)
        self.assertIn("info: 20 samples at 20.000 Hz", done.stderr)

    def test_missing_column(self):
        self.assert_message(recording([0]).replace("y_on,y_off", "y_on,z"),
                            "rec.csv:5: column 'y_off' is missing, expected "
                            "seq,t_us,x_on,x_off,y_on,y_off,flags; found "
                            "'seq,t_us,x_on,x_off,y_on,z,flags'")

    def test_bad_header(self):
        self.assert_message(recording([0]).replace("= 20.0", "= fast"),
                            "rec.csv:2: the header is not TOML behind '# ': Error while parsing "
                            "boolean: expected 'false', saw 'fas'")

    def test_empty_file(self):
        self.assert_message("", "rec.csv: the file is empty, expected a recording that begins with "
                            "'# penduline_recording = 1'")

    def test_a_line_of_one_megabyte(self):
        self.assert_message(HEAD + "1" * 1_000_000 + "\n",
                            "rec.csv:6: the line is longer than 4096 bytes; is this the right file?")

    def test_a_binary_file(self):
        path = self.folder / "image"
        path.write_bytes(bytes(range(256)))
        done = run("replay", path, "--rig", RIGS / "paper.toml", status=1)
        self.assertRegex(done.stderr, r"error: .*:1: found a NUL byte, expected text")

    def test_a_file_that_is_not_there(self):
        done = run("replay", "nowhere.csv", "--rig", RIGS / "paper.toml", status=1)
        self.assertEqual(done.stderr, "error: nowhere.csv: No such file or directory\n")

    def test_a_full_disk_fails_with_its_name(self):
        done = self.replay(recording(range(20)), "-o", "/dev/full", status=1)
        self.assertIn("error: /dev/full: No space left on device", done.stderr)

    def test_an_output_that_would_overwrite_the_recording_is_refused(self):
        path = self.write("rec.csv", recording(range(20)))
        done = run("replay", path, "--rig", RIGS / "paper.toml", "-o", path, status=1)
        self.assertEqual(done.stderr, f"error: {path}: stands for two files of this run, expected two "
                         "names\n")
        self.assertEqual(path.read_text(), recording(range(20)))

    def test_rig_and_recording_may_come_and_angles_go_by_pipes(self):
        path = self.write("rec.csv", recording(range(20)))
        done = run("replay", path, "--rig", "-", input=(RIGS / "paper.toml").read_text())
        self.assertEqual(done.stdout, self.replay(recording(range(20))).stdout)

    def test_a_rig_with_other_sensors_is_refused(self):
        text = recording([0]).replace("y_off,", "y_off,s3_on,s3_off,").replace(",0,0\n", ",0,1,1,0\n")
        done = self.replay(text, status=1)
        self.assertEqual(done.stderr, "error: the rig has 2 sensors, the samples have 3\n")

    def test_wrong_usage_ends_with_2(self):
        for arguments in ([], ["replay"], ["replay", "x.csv"], ["fly"],
                          ["replay", "x.csv", "--rig", "r", "--estimator", "magic"],
                          ["replay", "x.csv", "--rig", "r", "--rate", "20"],
                          ["replay", "x.csv", "--rig", "r", "--import", "x,y", "--rate", "nan"],
                          ["replay", "x.csv", "--rig", "r", "--import", "x,y", "--rate", "2e6"],
                          ["replay", "x.csv", "--rig", "r", "--align"]):
            with self.subTest(arguments):
                run(*arguments, status=2)

    def test_a_command_that_is_none_is_named(self):
        self.assertEqual(run("fly", status=2).stderr,
                         "error: found command 'fly', expected analyze, calibrate, devices, doctor, plot, "
                         "replay, report, run, simulate\n")

    def test_a_recording_may_begin_with_a_byte_order_mark(self):
        self.replay("\ufeff" + recording(range(20)), "--strict")

    def test_help_teaches_and_ends_with_0(self):
        self.assertIn("penduline replay rec.csv --rig rig.toml", run("replay", "--help").stdout)
        self.assertRegex(run("--version").stdout, r"^penduline \d+\.\d+\.\d+\n$")

    def test_imports_a_log_of_voltages_as_the_paper_writes_it(self):
        rows = "".join(f"{0.05 * i:.2f},1.661691,1.661691\n" for i in range(20))
        path = self.write("daq.csv", "Time,ai0,ai1\n" + rows)
        imported = run("replay", path, "--import", "t_s,x,y", "--rig", RIGS / "paper.toml").stdout
        recorded = self.replay(recording(range(20))).stdout
        for ours, theirs in zip(imported.splitlines()[-1].split(","),
                                recorded.splitlines()[-1].split(",")):
            self.assertAlmostEqual(float(ours or 0), float(theirs or 0), places=5)

    def test_an_import_without_columns_is_refused(self):
        done = self.replay("1,2\n", "--import", "", status=2)
        self.assertIn("--import: found column ''", done.stderr)

    def test_a_log_whose_last_line_does_not_end_is_doubtful(self):
        done = self.replay("1,2\n" * 20 + "1,2", "--import", "x,y", "--rate", 20, "--strict",
                           status=3)
        self.assertIn("rec.csv:21: the last line ('1,2') does not end", done.stderr)
        self.assertIn("21 samples", done.stderr)

    def test_imports_a_log_without_times(self):
        path = self.write("daq.csv", "1.66\t1.66\n" * 20)
        done = run("replay", path, "--import", "x,y", "--rate", 20, "--rig", RIGS / "paper.toml")
        self.assertIn("20 samples at 20.000 Hz, 0 lost, 5 with angles", done.stderr)

    def test_memory_does_not_grow_with_the_recording(self):
        def peak_kib(samples):
            path = self.folder / "long.csv"
            run("simulate", "--ideal", "--rate", 1000, "--seconds", samples / 1000, "--rig",
                RIGS / "paper.toml", "-o", path)
            process = subprocess.Popen([PROGRAM, "replay", path, "--rig", RIGS / "paper.toml", "-o",
                                        os.devnull], stderr=subprocess.DEVNULL)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            self.assertEqual(process.returncode, 0)
            return usage.ru_maxrss

        # The recordings are 0.4 and 8 MB; under a sanitizer the allocator adds its own noise.
        self.assertLess(peak_kib(200_000) - peak_kib(10_000), 2048)


if __name__ == "__main__":
    unittest.main()
