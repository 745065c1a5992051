# SPDX-License-Identifier: Apache-2.0
# `cmake --install`: what comes, what it is worth, and that it goes again.
import os
import re
import shutil
import unittest

from packaging import BUILD, ROOT, ProgramTest, command, files_below, install

UNIT = "usr/lib/systemd/system/penduline@.service"
# What any machine may have beside Penduline.
COMMON_FOLDERS = ("bin", "lib/systemd/system", "lib/udev/rules.d", "lib/sysusers.d", "share/man/man1",
                  "share/doc", "share/bash-completion/completions", "share/zsh/vendor-completions",
                  "share/fish/vendor_completions.d")
WORST_EXPOSURE = 15  # of 100, by systemd-analyze; of Debian's own services few are below 50


class InstallTest(ProgramTest):
    def setUp(self):
        super().setUp()
        for folder in COMMON_FOLDERS:
            (self.folder / "usr" / folder).mkdir(parents=True)
        self.before = sorted(self.folder.rglob("*"))
        install(self.folder)

    def test_everything_is_where_others_look_for_it(self):
        files = files_below(self.folder)
        for file in ("usr/bin/penduline", UNIT, "usr/lib/udev/rules.d/70-penduline.rules",
                     "usr/lib/sysusers.d/penduline.conf", "usr/share/man/man1/penduline.1.gz",
                     "usr/share/bash-completion/completions/penduline",
                     "usr/share/zsh/vendor-completions/_penduline",
                     "usr/share/fish/vendor_completions.d/penduline.fish",
                     "usr/share/doc/penduline/rigs/tcrt5000.toml", "usr/share/doc/penduline/LICENSE"):
            self.assertIn(file, files)

    def test_the_installed_program_runs(self):
        self.assertRegex(command(self.folder / "usr/bin/penduline", "--version"), r"^penduline \d")

    def test_uninstalling_leaves_what_was_there_before(self):
        command("cmake", "--build", BUILD, "--target", "uninstall",
                env={**os.environ, "DESTDIR": str(self.folder)})
        self.assertEqual(sorted(self.folder.rglob("*")), self.before)

    def test_the_rules_come_before_those_that_read_their_tags(self):
        (rules,) = (self.folder / "usr/lib/udev/rules.d").iterdir()
        self.assertLess(rules.name, "73-seat-late.rules")

    def test_the_manual_is_faultless(self):
        page = self.folder / "usr/share/man/man1/penduline.1.gz"
        self.assertEqual(command("mandoc", "-T", "lint", "-W", "warning", page), "")

    def test_the_manual_tells_every_command_option_status_signal_and_variable(self):
        page = command("mandoc", "-T", "ascii", self.folder / "usr/share/man/man1/penduline.1.gz")
        page = re.sub(r".\x08", "", page)
        program = self.folder / "usr/bin/penduline"
        commands = re.findall(r"^  (\w+) ", command(program, "--help").split("Subcommands:")[1],
                              re.MULTILINE)
        self.assertIn("run", commands)
        for name in commands:
            self.assertIn(f"penduline {name}", page)
            for option in re.findall(r"^  (?:-\w,)?(--[\w-]+)", command(program, name, "--help"),
                                     re.MULTILINE):
                self.assertTrue(option == "--help" or option in page, f"{name} {option}")
        sources = " ".join(path.read_text() for path in (ROOT / "host").rglob("*.cpp"))
        for variable in re.findall(r'"(PENDULINE_\w+)"', sources):
            self.assertIn(variable, page)
        for signal in re.findall(r"note_signal\((SIG\w+)\)", sources):
            self.assertIn(signal, page)
        for status in re.findall(r"k\w+ = (\d),", (ROOT / "host/cli/exit_status.hpp").read_text()):
            self.assertRegex(page, rf"\n     {status} +\w")


class UnitTest(ProgramTest):
    def setUp(self):
        super().setUp()
        # systemd's own units, which ours refers to, stand beside it.
        shutil.copytree("/usr/lib/systemd/system", self.folder / "usr/lib/systemd/system",
                        symlinks=True)
        install(self.folder)

    def test_systemd_finds_no_fault_with_the_unit(self):
        self.assertEqual(command("systemd-analyze", "verify", "--man=no", f"--root={self.folder}",
                                 "penduline@rig1.service"), "")

    def test_the_unit_is_locked_up(self):
        command("systemd-analyze", "security", "--offline=yes", "--no-pager",
                f"--threshold={WORST_EXPOSURE}", self.folder / UNIT)


if __name__ == "__main__":
    unittest.main()
