# SPDX-License-Identifier: Apache-2.0
# Boots the guest that pack_guest.sh has made, and tells how its program ended.
import os
import pathlib
import shutil
import subprocess
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("PENDULINE_BUILD", ROOT / "build/release"))
QEMU = "qemu-system-x86_64"
MACHINE = ("-M", "pc,usb=off,hpet=off", "-accel", "tcg", "-m", "768", "-nodefaults", "-display", "none",
           "-no-reboot", "-serial", "stdio", "-device", "isa-debug-exit,iobase=0x501,iosize=2")
COMMAND_LINE = ("console=ttyS0 quiet panic=-1 mitigations=off tsc=reliable no_timer_check "
                "cryptomgr.notests nowatchdog nolapic_timer")
# Puts systemd in place of guest/init.sh.
SYSTEMD = ("rdinit=/penduline/tests/kernel/guest/boot_systemd.sh systemd.unit=guest-test.service "
           "systemd.show_status=0 systemd.log_target=console systemd.log_level=notice "
           "systemd.log_color=0")
# Time goes by the instructions that the guest runs, and leaps while it sleeps. Nobody outside can take part.
VIRTUAL_TIME = ("-icount", "shift=1,sleep=off")
# What init.sh ends QEMU with. QEMU's own are 0 where the machine stopped (a panic) and 1 where it failed.
OUTCOMES = {33: "passed", 35: "failed"}


def missing():
    """What the test cannot do without, or nothing."""
    if shutil.which(QEMU) is None:
        return f"{QEMU} is not installed (Debian: qemu-system-x86)"
    if not (BUILD / "kernel/guest.cpio").exists():
        return "there is no guest: the test kernel/pack_guest says why"
    return None


@dataclass
class Ending:
    outcome: str  # "passed", "failed", "stopped" or "timed out"
    console: str


def boot(test, options=VIRTUAL_TIME, limit_s=120, systemd=False, **environment):
    """Runs a program of the guest, named from the repository's root with its arguments, as the only one of a
    fresh machine, or beside systemd's services. `environment` is the program's; `options` are QEMU's, of which
    no kind of time is real time."""
    words = [COMMAND_LINE, SYSTEMD if systemd else "", f'test="{test}"', *(f"{name}={value}" for name, value in environment.items())]
    process = subprocess.Popen(
        [QEMU, *MACHINE, "-kernel", BUILD / "kernel/vmlinux", "-initrd",
         BUILD / ("kernel/service.cpio" if systemd else "kernel/guest.cpio"),
         "-append", " ".join(words), *options],
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    try:
        console, _ = process.communicate(timeout=limit_s)
        outcome = OUTCOMES.get(process.returncode, "stopped")
    except subprocess.TimeoutExpired:
        process.kill()
        console, _ = process.communicate()
        outcome = "timed out"
    return Ending(outcome, console.decode(errors="replace"))
