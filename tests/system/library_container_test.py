"""One part of Saker, built, installed and used in an empty Debian with that part's packages alone."""

import pathlib
import shutil
import subprocess
import unittest

import container

ROOT = container.ROOT
BUILT = ("cmake -S /saker -B /build -G Ninja -DSAKER_MODULES=odometry -DCMAKE_BUILD_TYPE=Release && cmake --build /build"
         " && cmake --install /build --prefix /opt/saker"
         " && cmake -S /saker/examples -B /examples -G Ninja -DCMAKE_PREFIX_PATH=/opt/saker && cmake --build /examples")


class OdometryAlone(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        container.require_machine()
        cls.root = container.FOLDER / "library"
        shutil.rmtree(cls.root, ignore_errors=True)
        container.command("cp", "-a", container.base(), cls.root)
        (cls.root / "saker").mkdir()
        files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True)
        container.command("tar", "-C", ROOT, "-cf", cls.root / "saker.tar", *files.stdout.split())
        container.command("tar", "-C", cls.root / "saker", "-xf", cls.root / "saker.tar")
        cls.addClassCleanup(shutil.rmtree, cls.root, True)
        cls.inside("scripts/setup --modules odometry")
        cls.inside(BUILT)

    @classmethod
    def inside(cls, line):
        return container.command("chroot", cls.root, "sh", "-c", f"cd /saker && {line}")

    def test_neither_planner_nor_ray_caster_nor_pictures_are_installed(self):
        there = self.inside("dpkg-query -W -f '${Package}\\n'").stdout.split()
        for package in ("libompl-dev", "libembree-dev", "libopencv-core-dev", "libceres-dev"):
            self.assertNotIn(package, there)

    def test_the_example_is_built_and_refuses_a_recording_that_is_not_there(self):
        run = container.command("chroot", self.root, "/examples/register_scans", "/nothing", check=False)
        self.assertEqual(run.returncode, 2, run.stdout)
        self.assertEqual(len(run.stdout.splitlines()), 1, run.stdout)

    def test_other_examples_are_left_out(self):
        built = {path.name for path in pathlib.Path(self.root, "examples").iterdir()}
        self.assertIn("register_scans", built)
        self.assertFalse({"detect_objects", "next_viewpoint"} & built)


if __name__ == "__main__":
    unittest.main()
