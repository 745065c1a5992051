# SPDX-License-Identifier: Apache-2.0
# Completion in real shells at a real terminal: what a Tab makes of the line.
import os
import pty
import re
import select
import shutil
import signal
import time
import unittest

from packaging import PROGRAM, ROOT, ProgramTest

SCRIPTS = ROOT / "host/packaging/completion"
HOME, END = b"\x01", b"\x05"  # Ctrl-A, Ctrl-E


class Shell:
    """A shell at a terminal, in a folder, with the program on its path."""

    def __init__(self, folder, words, setup):
        environment = {"PATH": f"{folder}/bin:/usr/bin:/bin", "HOME": str(folder), "TERM": "dumb",
                       "LC_ALL": "C.UTF-8", "COLUMNS": "400"}
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.chdir(folder)
            os.execvpe(words[0], words, environment)
        for line in setup:
            self.run(line)

    def run(self, line):
        """Runs a line; what the terminal showed."""
        os.write(self.terminal, line.encode() + b"\necho rea''dy\n")
        return self.wait_for("ready\r\n")

    def wait_for(self, text):
        shown, end = "", time.monotonic() + 20
        while text not in shown:
            if not select.select([self.terminal], [], [], end - time.monotonic())[0]:
                raise AssertionError(f"waited in vain for {text!r}, found {shown!r}")
            shown += os.read(self.terminal, 65536).decode(errors="replace")
        return shown

    def completed(self, line):
        """What the tabs in a line make of it."""
        # The line is handed to a command that shows it as it is.
        os.write(self.terminal, line.encode() + HOME + b"show " + END + b"\n")
        return re.findall(r"\[(.*)\]end", self.wait_for("]end\r\n"))[-1]

    def close(self):
        os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        os.close(self.terminal)


class CompletionTest(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.folder / "bin").mkdir()
        (self.folder / "bin/penduline").symlink_to(PROGRAM)
        show = self.folder / "bin/show"
        show.write_text("#!/bin/sh\necho \"[$*]end\"\n")
        show.chmod(0o755)
        shutil.copy(SCRIPTS / "penduline.zsh", self.folder / "_penduline")
        for name in ("recording.csv", "rig.toml"):
            self.write(name, "")

    def completes(self, words, setup):
        """What every shell is to make of a few lines."""
        if shutil.which(words[0]) is None:
            self.skipTest(f"{words[0]} is not installed")
        shell = Shell(self.folder, words, setup)
        self.addCleanup(shell.close)
        for typed, made in (
                ("repl\t", "replay"),
                ("replay rec\t", "replay recording.csv"),
                ("run sim: --ri\trig\t", "run sim: --rig rig.toml"),
                ("run sim: --esti\tpa\t", "run sim: --estimator paper"),
                ("run sim: --format=j\t", "run sim: --format=jsonl"),
                ("run au\t", "run auto"),
                ("run fi\trec\t", "run file:recording.csv"),
                ("run usb\t", "run usb:1209:0001"),
                ("run sim: -o mqtt:\thost/lab", "run sim: -o mqtt://host/lab"),
                ("run sim: -o rec\t", "run sim: -o recording.csv")):
            with self.subTest(typed=typed):
                self.assertEqual(shell.completed("penduline " + typed), "penduline " + made)

    def test_bash(self):
        self.completes(["bash", "--norc", "--noprofile", "-i"],
                       [". /usr/share/bash-completion/bash_completion",
                        f". {SCRIPTS}/penduline.bash"])

    def test_zsh(self):
        self.completes(["zsh", "-f", "-i"],
                       ["bindkey -e", f"fpath=({self.folder} $fpath)", "autoload -Uz compinit",
                        "compinit -D -u"])

    def test_fish(self):
        self.completes(["fish", "--private", "--no-config"], [f"source {SCRIPTS}/penduline.fish"])


if __name__ == "__main__":
    unittest.main()
