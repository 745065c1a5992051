# SPDX-License-Identifier: Apache-2.0
# `penduline plot`: every kind in every format, the curves against the data, and what it refuses.
import math
import os
import pathlib
import re
import subprocess
import unittest

import svg_curves
from program import PROGRAM, RIGS, ROOT, ProgramTest, read_rows, run

KINDS = {
    "angles": ("Angles", "t / s", "theta1 / deg", "theta2 / deg"),
    "xyz": ("Position of the mass from the pivot", "t / s", "x / mm", "y / mm", "z / mm"),
    "top": ("Path of the mass from above", "x / mm", "y / mm"),
    "3d": ("Path of the mass in space", "x / mm", "y / mm", "z / mm", "seen from above"),
    "phase": ("Phase portrait", "theta1 / deg", "rate of theta1 / (deg/s)", "theta2 / deg",
              "rate of theta2 / (deg/s)"),
    "spectrum": ("Amplitude spectrum", "frequency / Hz", "amplitude of theta1 / deg",
                 "amplitude of theta2 / deg"),
    "residuals": ("Experiment less the fitted simulation", "t / s",
                  "residual of theta1 / deg", "residual of theta2 / deg"),
}
MAGIC = {"svg": b"<?xml", "pdf": b"%PDF", "png": b"\x89PNG\r\n"}
RIG = RIGS / "paper.toml"


class PlotTest(ProgramTest):
    def swing(self):
        return self.simulate("--theta-deg", 10, "--psi", 2, "--gap-noise", "10e-6")[0]

    def estimates(self, recording, estimator="ekf", name="estimates.csv"):
        path = self.folder / name
        run("replay", recording, "--rig", RIG, "--estimator", estimator, "-o", path)
        return path

    def draw(self, *arguments, kind="angles", status=0):
        """The SVG, and what the program said."""
        figure = self.folder / "figure.svg"
        done = run("plot", *arguments, "--what", kind, "-o", figure, status=status)
        return (figure.read_text() if figure.exists() else ""), done.stderr

    def test_every_kind_is_drawn_in_every_format_and_says_what_it_shows(self):
        table = self.estimates(self.swing())
        for kind, words in KINDS.items():
            for ending, magic in MAGIC.items():
                with self.subTest(kind=kind, ending=ending):
                    figure = self.folder / f"figure.{ending}"
                    done = run("plot", table, "--what", kind, "-o", figure)
                    self.assertEqual(done.stdout, "")
                    self.assertTrue(figure.read_bytes().startswith(magic))
                    self.assertFalse(list(self.folder.glob("*.part")))
            svg = (self.folder / "figure.svg").read_text()
            written = svg_curves.texts(svg)
            for text in words:
                self.assertIn(text, written, kind)
            self.assertNotIn("<image", svg)

    def test_the_list_of_kinds_is_that_of_the_help(self):
        text = run("plot", "--help").stdout
        for kind in KINDS:
            self.assertRegex(text, rf"(?m)^ +{kind}: ")
        self.assertIn("|".join(KINDS), text)
        document = (ROOT / "docs/figures.md").read_text()
        for kind in KINDS:
            self.assertIn(f"| `{kind}` |", document)

    def test_the_curves_are_the_data_to_a_pixel_and_break_where_there_is_none(self):
        lines = self.swing().read_text().splitlines(keepends=True)
        rows = [i for i, line in enumerate(lines) if re.match(r"\d", line)]
        dropped = set(rows[80:90])  # half a second is lost
        recording = self.write("lossy.csv", "".join(line for i, line in enumerate(lines)
                                                     if i not in dropped))
        table = self.estimates(recording)
        svg, _ = self.draw(table)
        data = read_rows(table)
        for index, angle in enumerate(("theta1", "theta2")):
            x, y = svg_curves.axes(svg, index)
            pieces = svg_curves.curve(svg, 2, index)
            self.assertEqual([len(piece) for piece in pieces], [80, len(data) - 80])
            vertices = [vertex for piece in pieces for vertex in piece]
            for (x_px, y_px), row in zip(vertices, data):
                self.assertAlmostEqual(x_px, x.pixel_of(float(row["t_s"])), delta=1)
                degrees = math.degrees(float(row[f"{angle}_rad"]))
                self.assertAlmostEqual(y_px, y.pixel_of(degrees), delta=1)

    def test_the_band_is_one_sigma_wide(self):
        rows = "".join(f"{i / 10},{0.1 * math.sin(i / 3)},{0.02 + i / 5000}\n" for i in range(50))
        table = self.write("wide.csv", "t_s,theta_rad,sigma1_rad\n" + rows)
        svg, _ = self.draw(table)
        self.assertIn("one sigma (1.4 deg)", svg_curves.texts(svg))
        _, y = svg_curves.axes(svg, 0)
        # The key's patch is the first polygon.
        polygon = re.findall(r"<polygon [^>]*points = '([^']*)'", svg)[1]
        heights = [float(pair.split(",")[1]) for pair in polygon.split()]
        upper, lower = heights[:50], heights[50:][::-1]
        for i, pair in enumerate(zip(upper, lower)):
            value, sigma = 0.1 * math.sin(i / 3), 0.02 + i / 5000
            expected = [y.pixel_of(math.degrees(value + sign * sigma)) for sign in (1, -1)]
            for found, wanted in zip(sorted(pair), sorted(expected)):
                self.assertAlmostEqual(found, wanted, delta=1)

    def test_a_recording_is_drawn_as_the_replay_of_it(self):
        recording = self.swing()
        for estimator in ("gn", "ekf", "smoother"):
            from_table, _ = self.draw(self.estimates(recording, estimator))
            from_recording, _ = self.draw(recording, "--rig", RIG, "--estimator", estimator)
            self.assertEqual(from_recording, from_table, estimator)

    def test_several_inputs_are_drawn_over_each_other_by_name(self):
        recording = self.swing()
        tables = [self.estimates(recording, kind, f"{kind}.csv") for kind in ("gn", "ekf")]
        svg, _ = self.draw(*tables, kind="top")
        written = svg_curves.texts(svg)
        for words in ("gn.csv", "ekf.csv"):
            self.assertIn(words, written)
        self.assertTrue(any(text.startswith("ekf.csv, first swing: ") for text in written))

    def test_the_spectrum_reads_amplitude_and_frequency_of_a_known_sine(self):
        rows = "".join(f"{i / 50:.2f},{math.radians(7) * math.sin(2 * math.pi * 0.91 * i / 50):.12f}\n"
                       for i in range(2000))
        svg, _ = self.draw(self.write("sine.csv", "t_s,theta_rad\n" + rows), kind="spectrum")
        self.assertTrue({"7 deg at 0.9094 Hz", "amplitude of theta / deg"}
                        <= set(svg_curves.texts(svg)))

    def test_a_part_a_title_and_a_size_can_be_asked_for(self):
        table = self.estimates(self.swing())
        svg, _ = self.draw(table, "--from-s", 2, "--to-s", 4, "--title", "Größe & 'Art' <2>",
                           "--size", "500x400")
        self.assertEqual(len(svg_curves.curve(svg, 2, 0)[0]), 41)
        self.assertIn('width="500" height="400"', svg)
        self.assertIn("Größe &amp; 'Art' &lt;2>", svg_curves.texts(svg))
        self.assertNotIn("Angles", svg_curves.texts(svg))

    def test_angles_alone_become_positions_by_the_rigs_length(self):
        rows = "".join(f"{i / 20},0.1\n" for i in range(20))
        table = self.write("angles.csv", "t_s,theta_rad\n" + rows)
        _, said = self.draw(table, kind="xyz", status=1)
        self.assertIn("angles.csv: found no positions, expected the columns x_m, y_m and z_m; or "
                      "--rig", said)
        svg, _ = self.draw(table, "--rig", RIG, kind="xyz")
        self.assertIn("z / mm", svg_curves.texts(svg))

    def test_what_cannot_be_drawn_is_refused_in_one_line(self):
        recording = self.swing()
        table = self.estimates(recording)
        rest = self.write("rest.csv", "t_s,theta_rad\n" + "".join(f"{i},0\n" for i in range(99)))
        for arguments, words in (
                (("missing.csv",), "missing.csv: "),
                ((recording,), "recording.csv: found no angles; a recording needs --rig"),
                (("-",), "found the standard input, expected a file"),
                ((table, "--from-s", 500), "estimates.csv: found no angles from 500 s to inf s, "
                                           "200 rows in all"),
                ((self.write("names.csv", "t_s,theta3_rad\n0,1\n"),),
                 "names.csv:1: found the columns 't_s,theta3_rad', expected t_s with"),
                ((self.write("word.csv", "t_s,theta_rad\n0,much\n"),),
                 "word.csv:2: found 'much' in column 2, expected a number")):
            with self.subTest(arguments=arguments):
                svg, said = self.draw(*arguments, status=1)
                self.assertEqual(svg, "")
                self.assertEqual(said.count("\n"), 1, said)
                self.assertIn(words, said)
        self.assertIn("rest.csv: found no swing", self.draw(rest, kind="residuals", status=1)[1])

    def test_wrong_usage_says_what_is_expected(self):
        table = self.write("angles.csv", "t_s,theta_rad\n0,0\n")
        for options, words in (
                (("--what", "angel", "-o", "f.svg"), "angel not in"),
                (("--what", "angles", "-o", "f.jpg"), "a name that ends in .svg, .pdf or .png"),
                (("--what", "angles"), "--output is required"),
                (("--what", "angles", "-o", "f.svg", "--size", "9x9"), "from 200 to 10000"),
                (("--what", "angles", "-o", "f.svg", "--size", "900"), "such as 900x600"),
                (("--what", "angles", "-o", "f.svg", "--align"), "is for --estimator paper")):
            with self.subTest(options=options):
                self.assertIn(words, run("plot", table, *options, status=2).stderr)
        self.assertIn("found 7, expected 6 or less",
                      run("plot", *7 * [table], "--what", "angles", "-o", "f.svg", status=2).stderr)

    def test_the_users_own_gnuplot_settings_change_nothing(self):
        table = self.estimates(self.swing())
        svg, _ = self.draw(table, kind="top")
        (self.folder / ".gnuplot").write_text('set datafile separator ","\nset xrange [0:1]\n')
        subprocess.run([PROGRAM, "plot", table, "--what", "top", "-o", self.folder / "own.svg"],
                       check=True, env={**os.environ, "HOME": str(self.folder)})
        self.assertEqual((self.folder / "own.svg").read_text(), svg)

    def test_a_full_disk_is_said_and_the_old_figure_stays(self):
        table = self.write("angles.csv", "t_s,theta_rad\n0,0\n1,1\n2,0\n")
        for ending in MAGIC:
            figure = self.folder / f"old.{ending}"
            figure.write_text("before")
            # A file's largest size in blocks of 1 KB: the script has room, the figure has not.
            done = subprocess.run(
                ["bash", "-c", 'ulimit -f 2; trap "" XFSZ; exec "$@"', "-", PROGRAM, "plot", table,
                 "--what", "angles", "-o", figure],
                capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn(f"old.{ending}.part: File too large", done.stderr)
            self.assertEqual(figure.read_text(), "before")
        self.assertFalse(list(self.folder.glob("*.part")))

    def test_names_over_panels_are_clear_of_titles_and_numbers(self):
        recording = self.swing()
        lengths = (1, 4, 10, 20, 50, 150)
        tables = [self.estimates(recording, "gn", f"a_very_long_name{length * '_'}.csv")
                  for length in lengths]
        for kind in ("angles", "residuals", "spectrum"):
            svg, _ = self.draw(*tables, kind=kind)
            placed = svg_curves.placed_texts(svg)
            title = next(y for _, y, text in placed if text == KINDS[kind][0])
            height = int(re.search(r'height="(\d+)"', svg)[1])
            keys = sorted(y for _, y, text in placed if "a_very_long_name" in text)
            # What stands left of the axes is in no name's way.
            others = [y for x, y, text in placed if x > 95 and "a_very_long_name" not in text]
            self.assertEqual(len(keys), 12)  # none is left out, however long
            self.assertGreater(keys[0], title + 12)
            self.assertLess(keys[-1], height)
            rows = sorted(set(keys))
            for above, below in zip(rows, rows[1:]):
                self.assertGreater(below - above, 12)
            for row in rows:
                self.assertTrue(all(abs(row - y) >= 10 for y in others), (kind, row, others))

    def test_late_times_are_readable(self):
        rows = "".join(f"{1760000000 + i / 10},{0.1 * math.sin(i / 3)}\n" for i in range(20))
        svg, _ = self.draw(self.write("late.csv", "t_s,theta_rad\n" + rows))
        numbers = [text for text in svg_curves.texts(svg) if text.startswith("176")]
        self.assertEqual(numbers, ["1760000000", "1760000000.5", "1760000001", "1760000001.5"])

    def test_an_input_is_never_overwritten(self):
        table = self.write("table.svg", "t_s,theta_rad\n0,0\n1,1\n")
        run("plot", table, "--what", "angles", "-o", table, status=1)
        self.assertTrue(table.read_text().startswith("t_s"))

    def test_strict_ends_with_3_where_rows_are_doubtful(self):
        table = self.write("gaps.csv", "t_s,theta1_rad,theta2_rad,flags\n0,0,0,0\n1,1,1,8192\n"
                                       "2,,,1024\n3,1,1,0\n4,1,1,0\n")
        svg, said = self.draw(table, "--strict", status=3)
        self.assertIn("flagged", svg_curves.texts(svg))
        self.assertIn("gaps.csv: 1 rows without angles, 1 with a flag against them", said)

    def test_a_missing_gnuplot_is_said(self):
        table = self.write("angles.csv", "t_s,theta_rad\n0,0\n1,1\n")
        done = subprocess.run([PROGRAM, "plot", table, "--what", "angles", "-o",
                               self.folder / "f.svg"], capture_output=True, text=True, check=False,
                              env={**os.environ, "PATH": str(self.folder)})
        self.assertEqual(done.returncode, 1)
        self.assertIn("f.svg: found no gnuplot to draw it: apt-get install gnuplot-nox", done.stderr)

    def test_an_hour_at_100_hz_is_a_figure_of_a_size_to_keep(self):
        rows = "".join(f"{i / 100:.2f},{0.1 * math.sin(5.7 * i / 100):.6f}\n"
                       for i in range(360000))
        table = self.write("hour.csv", "t_s,theta_rad\n" + rows)
        for kind in ("angles", "spectrum"):
            svg, _ = self.draw(table, kind=kind)
            self.assertLess(len(svg), 200_000, kind)

    def test_the_papers_figures_are_drawn_of_a_recording_of_ones_own(self):
        figures = self.folder / "figures"
        (self.folder / ".gnuplot").write_text("exit status 1\n")  # not read
        subprocess.run([ROOT / "scripts/paper_figures", figures, self.swing(), RIG], check=True,
                       capture_output=True, env={**os.environ, "PENDULINE": str(PROGRAM),
                                                 "HOME": str(self.folder)})
        names = {path.name for path in pathlib.Path(figures).iterdir()}
        self.assertTrue({"own_angles.svg", "own_xyz.svg", "own_top.svg", "own_3d.svg",
                         "figure_12.svg"} <= names, names)


if __name__ == "__main__":
    unittest.main()
