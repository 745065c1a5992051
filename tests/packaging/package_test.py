# SPDX-License-Identifier: Apache-2.0
# The Debian package, which stays in the build's folder `package` for others to test: what is in it, what it needs.
import re
import shutil
import unittest

from packaging import BUILD, ProgramTest, command, files_below, install

FOLDER = BUILD / "package"


def setUpModule():
    shutil.rmtree(FOLDER, ignore_errors=True)
    command("cpack", "-G", "DEB", cwd=BUILD)


class PackageTest(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.package,) = FOLDER.glob("*.deb")

    def field(self, name):
        return command("dpkg-deb", "--field", self.package, name).strip()

    def test_it_is_named_as_debian_names_packages(self):
        architecture = command("dpkg", "--print-architecture").strip()
        self.assertEqual(self.package.name, f"penduline_{self.field('Version')}_{architecture}.deb")

    def test_it_holds_what_an_installation_puts_there(self):
        stage, unpacked = self.folder / "stage", self.folder / "unpacked"
        install(stage)
        command("dpkg-deb", "--extract", self.package, unpacked)
        self.assertEqual(files_below(unpacked), files_below(stage))

    def test_it_needs_the_packages_of_its_libraries(self):
        needed = set(re.findall(r"(?:^|, )([\w.+-]+)", self.field("Depends")))
        for library in ("libc6", "libstdc++6", "libsystemd0", "libudev1", "libusb-1.0-0", "libmosquitto1"):
            self.assertIn(library, needed)
        self.assertFalse([name for name in needed if name.endswith("-dev")])

    def test_it_puts_nothing_below_etc(self):
        self.assertNotIn(" ./etc", command("dpkg-deb", "--contents", self.package))

    def test_its_scripts_are_for_debians_shell(self):
        for script in ("postinst", "prerm", "postrm"):
            command("dpkg-deb", "--control", self.package, self.folder / script)
            path = self.folder / script / script
            self.assertEqual(path.stat().st_mode & 0o777, 0o755)
            command("shellcheck", "--shell=dash", path)

    @unittest.skipUnless(shutil.which("lintian"), "lintian is not installed")
    def test_lintian_has_nothing_to_say(self):
        # The licence goes along for those who install elsewhere.
        self.assertEqual(command("lintian", "--allow-root", "--fail-on", "error,warning",
                                 "--suppress-tags", "extra-license-file", self.package), "")


if __name__ == "__main__":
    unittest.main()
