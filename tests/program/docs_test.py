# SPDX-License-Identifier: Apache-2.0
# The documentation is true: its tables list what the program has, its commands work.
import re
import subprocess
import unittest

from program import PROGRAM, ROOT, ProgramTest, run

# Commands that install packages or take minutes; scripts/test and scripts/bench are run as such.
NOT_HERE = re.compile(r"scripts/(demo|test|bench)|git clone|apt-get")


def documents():
    return [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


def shell_blocks(text):
    return re.findall(r"^```sh\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


class DocsTest(ProgramTest):
    def test_formats_lists_every_column_key_and_flag_of_the_code(self):
        formats = (ROOT / "docs/formats.md").read_text()
        for source, pattern in (("host/output/estimate_columns.cpp", r'EstimateColumn\{"(\w+)"'),
                                ("hal/replay/recording_format.hpp",
                                 r'HeaderKeyDescription\{(?:"(\w+)"|kVersionKey)')):
            names = re.findall(pattern, (ROOT / source).read_text())
            self.assertGreater(len(names), 5)
            for name in filter(None, names):
                self.assertIn(f"| `{name}` |", formats, f"of {source}")
        events = (ROOT / "hal/replay/recording_event.hpp").read_text()
        named = dict(re.findall(r'string_view (k\w+) = "(\w+)";', events))
        kinds = re.findall(r'EventKindDescription\{(?:"(\w+)"|event::(k\w+)), "([^"]+)",\s+"([^"]+)"\}',
                           events)
        self.assertEqual(len(kinds), len(re.findall(r"  EventKindDescription\{", events)))
        for kind, name, fields, meaning in kinds:
            self.assertIn(f"| `{kind or named[name]}` | {fields} | {meaning} |", formats)
        flags = re.findall(r'FlagDescription\{flag::\w+, "(\w+)",\s+"([^"]+)"\}',
                           (ROOT / "common/flags.hpp").read_text())
        bits = [int(bit) for bit in re.findall(r"Flags k\w+ = 1U << (\d+)U",
                                               (ROOT / "common/flags.hpp").read_text())]
        self.assertEqual(len(flags), len(bits))
        for (name, meaning), bit in zip(flags, bits):
            self.assertIn(f"| {2 ** bit} | `{name}` | {meaning} |", formats)

    def test_formats_lists_every_line_of_a_rig(self):
        formats = (ROOT / "docs/formats.md").read_text()
        section = (ROOT / "host/gpio_section.hpp").read_text()
        keys = re.findall(r'GpioKeyDescription\{"(\w+)", &RigLines::\w+,\s+"([^"]+)"\}', section)
        self.assertEqual(len(keys), len(re.findall(r"std::optional<GpioLine> \w+;", section)))
        for key, meaning in keys:
            self.assertIn(f"| `[gpio] {key}` | no | {meaning} |", formats)

    def test_formats_lists_every_key_of_a_calibration(self):
        formats = (ROOT / "docs/formats.md").read_text()
        keys = re.findall(r'table\.insert\("(\w+)"',
                          (ROOT / "host/calibration_section.cpp").read_text())
        self.assertEqual(len(keys), 9)
        for key in keys:
            self.assertIn(f"| `{key}` | ", formats)

    def test_formats_lists_every_key_of_an_analysis(self):
        formats = (ROOT / "docs/formats.md").read_text()
        keys = set(re.findall(r'\{"(\w+)", ', (ROOT / "host/analysis/analysis_json.cpp").read_text()))
        self.assertGreater(len(keys), 40)
        for key in keys - {"value", "sigma"}:
            self.assertRegex(formats, rf"[`.,]{key}[`.,]", key)

    def test_commands_in_the_documents_work(self):
        for document in documents():
            for block in shell_blocks(document.read_text()):
                if NOT_HERE.search(block):
                    continue
                with self.subTest(document=document.name, block=block):
                    (self.folder / "docs").exists() or (self.folder / "docs").symlink_to(ROOT / "docs")
                    (self.folder / "scripts").exists() or (self.folder / "scripts").symlink_to(
                        ROOT / "scripts")
                    program = self.folder / "build/release/penduline"
                    if not program.exists():
                        program.parent.mkdir(parents=True)
                        program.symlink_to(PROGRAM)
                    done = subprocess.run(["bash", "-euo", "pipefail", "-c", block],
                                          cwd=self.folder, capture_output=True, text=True,
                                          check=False, timeout=300)
                    self.assertEqual(done.returncode, 0, done.stderr)

    def test_links_between_documents_lead_somewhere(self):
        for document in documents():
            for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", document.read_text()):
                if "://" not in target:
                    self.assertTrue((document.parent / target).exists(), f"{document}: {target}")

    def test_every_subcommand_has_an_example_in_its_help(self):
        for command in ("analyze", "calibrate", "doctor", "plot", "replay", "report", "run", "simulate"):
            self.assertIn(f"  penduline {command} ", run(command, "--help").stdout)


if __name__ == "__main__":
    unittest.main()
