# SPDX-License-Identifier: Apache-2.0
# The build's installation and package, for tests.
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/program"))
from program import PROGRAM, ProgramTest  # noqa: E402, F401

BUILD = PROGRAM.parent


def command(*words, **options):
    """Runs a command to its end; what it wrote. Fails unless its status is 0."""
    done = subprocess.run([*map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False, timeout=300, **options)
    if done.returncode != 0:
        raise AssertionError(f"{words} ended with {done.returncode}: {done.stdout}")
    return done.stdout


def install(stage):
    """Installs below `stage` as if for /usr."""
    command("cmake", "--install", BUILD, "--prefix", "/usr", env={**os.environ, "DESTDIR": str(stage)})


def files_below(folder):
    """The files in it, by their names from there on."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if not path.is_dir())
