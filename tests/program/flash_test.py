# SPDX-License-Identifier: Apache-2.0
# `scripts/flash`: finds boards, checks images, copies them; boards and system tools are stand-ins.
import os
import pathlib
import shutil
import struct
import subprocess
import unittest

from program import ROOT, ProgramTest

RP2040_FAMILY = 0xE48BFF56
RP2350_FAMILY = 0xE48BFF59

# Stand-ins for the system's tools. They read and write $BOARDS: the list of volumes as lsblk prints
# it, and a log of what was called.
TOOLS = {
    "lsblk": 'cat "$BOARDS/volumes"',
    "udisksctl": 'echo "udisksctl $*" >>"$BOARDS/log"; cp "$BOARDS/volumes_mounted" "$BOARDS/volumes"',
    "stty": 'echo "stty $*" >>"$BOARDS/log"; cp "$BOARDS/volumes_touched" "$BOARDS/volumes"',
    "openocd": 'echo "openocd $*" >>"$BOARDS/log"',
}


def uf2(family=RP2040_FAMILY, blocks=2):
    return b"".join(struct.pack("<8I", 0x0A324655, 0x9E5D5157, 0x2000, 0x10000000 + 256 * i, 256, i,
                                blocks, family).ljust(508, b"\0") + struct.pack("<I", 0x0AB16F30)
                    for i in range(blocks))


def nucleo_image():
    return struct.pack("<2I", 0x20020000, 0x080001C5) + bytes(1000)


class FlashTest(ProgramTest):
    def setUp(self):
        super().setUp()
        for name in ("bin", "serial", "boards"):
            (self.folder / name).mkdir()
        for name, text in TOOLS.items():
            self.tool(name, text)
        self.volumes()
        self.image = self.folder / "image.uf2"
        self.image.write_bytes(uf2())
        self.nucleo_image = self.folder / "image.bin"
        self.nucleo_image.write_bytes(nucleo_image())

    def tool(self, name, text):
        path = self.folder / "bin" / name
        path.write_text(f"#!/bin/sh\n{text}\n")
        path.chmod(0o755)

    def volumes(self, *rows, name="volumes"):
        """Lets lsblk list rows of (device, label, where it is mounted)."""
        (self.folder / "boards" / name).write_text("".join(
            f'PATH="{device}" LABEL="{label}" MOUNTPOINT="{place}"\n' for device, label, place in rows))

    def volume(self, name, mark="INFO_UF2.TXT"):
        """The folder of a mounted volume."""
        folder = self.folder / name
        folder.mkdir()
        (folder / mark).write_text("Board-ID: RPI-RP2\n")
        return folder

    def running(self, number="E66038B713952D31"):
        port = self.folder / "serial" / f"usb-Penduline_Penduline_{number}-if00"
        port.write_text("")
        return port

    def flash(self, *arguments, status=0, script=ROOT / "scripts/flash"):
        """Runs the script; returns what it said on both streams."""
        variables = {"PATH": f"{self.folder}/bin:/usr/bin:/bin", "HOME": str(self.folder),
                     "BOARDS": str(self.folder / "boards"),
                     "PENDULINE_SERIAL_FOLDER": str(self.folder / "serial")}
        done = subprocess.run([script, "--wait", "0", *map(str, arguments)],
                              env=variables, cwd=self.folder, capture_output=True, text=True,
                              check=False, timeout=60)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def log(self):
        path = self.folder / "boards/log"
        return path.read_text() if path.exists() else ""

    def test_copies_the_image_to_a_mounted_pico(self):
        folder = self.volume("RPI-RP2")
        self.volumes(("/dev/vda1", "root", "/"), ("/dev/sda1", "RPI-RP2", folder))
        self.assertIn(f"Wrote {self.image} to {folder}.", self.flash("pico", self.image))
        self.assertEqual((folder / "image.uf2").read_bytes(), self.image.read_bytes())

    def test_copies_where_no_serial_port_was_ever_seen(self):
        (self.folder / "serial").rmdir()
        folder = self.volume("RPI-RP2")
        self.volumes(("/dev/sda1", "RPI-RP2", folder))
        self.flash("pico", self.image)
        self.assertTrue((folder / "image.uf2").exists())

    def test_finds_a_volume_with_a_blank_in_its_place(self):
        folder = self.volume("my boards")
        self.volumes(("/dev/sda1", "RPI-RP2", str(folder).replace(" ", "\\x20")))
        self.flash("pico", self.image)
        self.assertTrue((folder / "image.uf2").exists())

    def test_mounts_a_pico_that_is_not_mounted(self):
        folder = self.volume("RPI-RP2")
        self.volumes(("/dev/sda1", "RPI-RP2", ""))
        self.volumes(("/dev/sda1", "RPI-RP2", folder), name="volumes_mounted")
        self.flash("pico", self.image)
        self.assertIn("udisksctl mount --no-user-interaction --block-device /dev/sda1", self.log())
        self.assertTrue((folder / "image.uf2").exists())

    def test_says_why_a_volume_could_not_be_mounted(self):
        self.volumes(("/dev/sda1", "RPI-RP2", ""))
        self.tool("udisksctl", 'echo "Error mounting: Not authorized" >&2; exit 1')
        self.assertEqual("error: could not mount /dev/sda1: Error mounting: Not authorized\n",
                         self.flash("pico", self.image, status=1))

    def test_sends_a_running_pico_to_its_bootloader(self):
        port, folder = self.running(), self.volume("RPI-RP2")
        self.volumes(("/dev/sda1", "RPI-RP2", folder), name="volumes_touched")
        self.flash("pico", self.image)
        self.assertEqual(self.log(), f"stty -F {port} 1200\n")
        self.assertTrue((folder / "image.uf2").exists())

    def test_a_pico_that_waits_comes_before_one_that_runs(self):
        self.running()
        self.volumes(("/dev/sda1", "RPI-RP2", self.volume("RPI-RP2")))
        self.flash("pico", self.image)
        self.assertEqual(self.log(), "")

    def test_says_when_the_touched_pico_does_not_come_back(self):
        self.running()
        self.volumes(name="volumes_touched")
        self.assertIn("did not come up as RPI-RP2 within 0 s; unplug it and hold BOOTSEL",
                      self.flash("pico", self.image, status=1))

    def test_says_which_group_a_serial_port_without_permission_needs(self):
        port = self.running()
        self.tool("stty", f'echo "stty: {port}: Permission denied" >&2; exit 1')
        said = self.flash("pico", self.image, status=1)
        self.assertIn(f"error: stty: {port}: Permission denied", said)
        self.assertIn("usermod -aG dialout", said)

    def test_says_what_was_looked_for_when_there_is_no_pico(self):
        said = self.flash("pico", self.image, status=1)
        for part in ("volume RPI-RP2", f"{self.folder}/serial/*Penduline*", "Hold the button BOOTSEL"):
            self.assertIn(part, said)

    def test_two_boards_are_told_apart_by_the_user(self):
        first, second = self.volume("first"), self.volume("second")
        self.volumes(("/dev/sda1", "RPI-RP2", first), ("/dev/sdb1", "RPI-RP2", second))
        said = self.flash("pico", self.image, status=1)
        self.assertIn("found 2 boards that wait for an image, expected one", said)
        self.assertIn(str(second), said)
        self.flash("--volume", second, "pico", self.image)
        self.assertTrue((second / "image.uf2").exists())
        self.assertFalse((first / "image.uf2").exists())

    def test_two_running_boards_are_told_apart_by_the_user(self):
        ports = [self.running("A"), self.running("B")]
        said = self.flash("pico", self.image, status=1)
        self.assertIn("found 2 running boards, expected one; choose with --serial:", said)
        self.volumes(("/dev/sda1", "RPI-RP2", self.volume("RPI-RP2")), name="volumes_touched")
        self.flash("--serial", ports[1], "pico", self.image)
        self.assertEqual(self.log(), f"stty -F {ports[1]} 1200\n")

    def test_refuses_a_folder_that_is_no_board(self):
        (self.folder / "stick").mkdir()
        self.assertIn("found no INFO_UF2.TXT in it, expected the volume of a pico",
                      self.flash("--volume", self.folder / "stick", "pico", self.image, status=1))

    def test_refuses_files_that_are_no_image_for_the_board(self):
        self.volumes(("/dev/sda1", "RPI-RP2", self.volume("RPI-RP2")))
        for content, said in ((b"\x7fELF" + bytes(600), "found no UF2 file"), (b"", "found no UF2 file"),
                              (uf2(RP2350_FAMILY), "found family 0xe48bff59, expected 0xe48bff56"),
                              (uf2()[:700], "found 700 bytes, expected 1024: the file is cut short")):
            with self.subTest(said=said):
                self.image.write_bytes(content)
                self.assertIn(said, self.flash("pico", self.image, status=1))
        self.assertIn("found no such file", self.flash("pico", "none.uf2", status=1))
        self.assertFalse((self.folder / "RPI-RP2/image.uf2").exists())

    def test_says_why_a_volume_could_not_be_written(self):
        folder = self.volume("RPI-RP2")
        self.volumes(("/dev/sda1", "RPI-RP2", folder))
        self.tool("cp", 'echo "cp: Permission denied" >&2; exit 1')
        self.assertIn(f"could not write to {folder}: cp: Permission denied",
                      self.flash("pico", self.image, status=1))

    def test_copies_the_image_to_a_nucleo_of_either_label(self):
        for label in ("NODE_F446RE", "NOD_F446RE"):
            folder = self.volume(label, mark="MBED.HTM")
            self.volumes(("/dev/sda", label, folder))
            self.flash("nucleo", self.nucleo_image)
            self.assertEqual((folder / "image.bin").read_bytes(), nucleo_image())

    def test_refuses_a_nucleo_image_that_does_not_start_like_one(self):
        self.volumes(("/dev/sda", "NODE_F446RE", self.volume("NODE_F446RE", mark="MBED.HTM")))
        self.assertIn("it is no .bin for the Nucleo-F446RE",
                      self.flash("nucleo", self.image, status=1))

    def test_tells_what_the_st_link_says_of_a_failure(self):
        folder = self.volume("NODE_F446RE", mark="MBED.HTM")
        (folder / "FAIL.TXT").write_text("The target is held in reset.")
        self.volumes(("/dev/sda", "NODE_F446RE", folder))
        self.assertIn("the ST-Link refused the image: The target is held in reset.",
                      self.flash("nucleo", self.nucleo_image, status=1))

    def test_takes_openocd_where_a_nucleo_has_no_volume(self):
        self.flash("nucleo", self.nucleo_image)
        self.assertIn(f"program {{{self.nucleo_image}}} verify reset exit 0x08000000", self.log())

    def test_says_what_was_looked_for_when_there_is_no_nucleo(self):
        (self.folder / "bin/openocd").unlink()
        if pathlib.Path("/usr/bin/openocd").exists():
            self.skipTest("openocd is installed here")
        said = self.flash("nucleo", self.nucleo_image, status=1)
        self.assertIn("looked for a volume NODE_F446RE or NOD_F446RE", said)

    def test_builds_the_image_where_it_is_missing(self):
        shutil.copytree(ROOT / "scripts", self.folder / "clone/scripts")
        folder = self.volume("RPI-RP2")
        self.volumes(("/dev/sda1", "RPI-RP2", folder))
        script = self.folder / "clone/scripts/flash"
        self.tool("dpkg-query", "echo installed")
        self.tool("cmake", f'mkdir -p build/pico; cp {self.image} build/pico/penduline-pico.uf2; '
                           'echo "cmake $*" >>"$BOARDS/log"')
        said = self.flash("--dry-run", "pico", script=script)
        self.assertIn(f"would build {self.folder}/clone/build/pico/penduline-pico.uf2", said)
        self.assertEqual(self.log(), "")
        self.flash("pico", script=script)
        self.assertIn("cmake --build --preset pico --target penduline-pico", self.log())
        self.assertTrue((folder / "penduline-pico.uf2").exists())

    def test_a_dry_run_says_what_it_would_do_and_does_nothing(self):
        port = self.running()
        said = self.flash("--dry-run", "pico", self.image)
        self.assertIn(f"would send {port}, which runs Penduline, to its bootloader", said)
        self.assertIn(f"would copy {self.image} to the volume RPI-RP2", said)
        folder = self.volume("RPI-RP2")
        self.volumes(("/dev/sda1", "RPI-RP2", folder))
        self.assertIn(f"would copy {self.image} to {folder}",
                      self.flash("--dry-run", "pico", self.image))
        self.volumes(("/dev/sda1", "RPI-RP2", ""))
        self.assertIn("would mount /dev/sda1", self.flash("--dry-run", "pico", self.image))
        self.assertIn("would write", self.flash("--dry-run", "nucleo", self.nucleo_image))
        self.assertEqual(self.log(), "")
        self.assertEqual(os.listdir(folder), ["INFO_UF2.TXT"])

    def test_a_wrong_command_line_ends_with_2_and_says_what_was_expected(self):
        for arguments, said in (((), "expected pico or nucleo"), (("pica",), "found the board 'pica'"),
                                (("--quick", "pico"), "found '--quick'"), (("pico", "a", "b"), "found 'b'"),
                                (("--volume",), "found nothing behind it"),
                                (("--wait", "soon", "pico"), "expected whole seconds")):
            self.assertIn(said, self.flash(*arguments, status=2))

    def test_help_has_an_example_for_each_board(self):
        said = self.flash("--help")
        self.assertIn("  scripts/flash pico ", said)
        self.assertIn("  scripts/flash --dry-run nucleo ", said)


if __name__ == "__main__":
    unittest.main()
