"""Parts of Saker, built, installed and used in an empty Debian with those parts' packages alone."""

import json
import pathlib
import shutil
import subprocess
import unittest

import container

ROOT = container.ROOT
CAR = {"id": 7, "class": "vehicle", "probability": 1, "observations": 1, "position": [12, 3, 0.8], "rotation": [0, 0, 0, 1],
       "size": [4.5, 1.8, 1.5]}


def built(modules):
    """Saker below a prefix, and the examples against that."""
    return (f"cmake -S /saker -B /build -G Ninja '-DSAKER_MODULES={';'.join(modules)}' -DCMAKE_BUILD_TYPE=Release"
            " && cmake --build /build && cmake --install /build --prefix /opt/saker && rm -rf /build"
            " && cmake -S /saker/examples -B /examples -G Ninja -DCMAKE_PREFIX_PATH=/opt/saker && cmake --build /examples")


class Alone(unittest.TestCase):
    """Of the classes below each is a Debian of its own."""

    MODULES = ()

    @classmethod
    def setUpClass(cls):
        if not cls.MODULES:
            raise unittest.SkipTest("what the others have in common")
        container.require_machine()
        cls.root = container.FOLDER / f"library-{cls.MODULES[0]}"
        shutil.rmtree(cls.root, ignore_errors=True)
        container.command("cp", "-a", container.base(), cls.root)
        (cls.root / "saker").mkdir()
        files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True)
        container.command("tar", "-C", ROOT, "-cf", cls.root / "saker.tar", *files.stdout.split())
        container.command("tar", "-C", cls.root / "saker", "-xf", cls.root / "saker.tar")
        cls.addClassCleanup(shutil.rmtree, cls.root, True)
        cls.inside(f"scripts/setup --modules {' '.join(cls.MODULES)}")
        cls.inside(built(cls.MODULES))

    @classmethod
    def inside(cls, line):
        return container.command("chroot", cls.root, "sh", "-c", f"cd /saker && {line}", timeout=3600)

    def packages(self):
        return self.inside("dpkg-query -W -f '${Package}\\n'").stdout.split()

    def refuses(self, program, *words):
        """A recording that is not there: status 2 and one line."""
        run = container.command("chroot", self.root, f"/examples/{program}", *words, check=False)
        self.assertEqual(run.returncode, 2, run.stdout)
        self.assertEqual(len(run.stdout.splitlines()), 1, run.stdout)


class OdometryAlone(Alone):
    MODULES = ("odometry",)

    def test_neither_planner_nor_ray_caster_nor_pictures_are_installed(self):
        for package in ("libompl-dev", "libembree-dev", "libopencv-core-dev", "libceres-dev"):
            self.assertNotIn(package, self.packages())

    def test_the_example_is_built_and_refuses_a_recording_that_is_not_there(self):
        self.refuses("register_scans", "/nothing")

    def test_other_examples_are_left_out(self):
        there = {path.name for path in pathlib.Path(self.root, "examples").iterdir()}
        self.assertIn("register_scans", there)
        self.assertFalse({"detect_objects", "next_viewpoint"} & there)


class AllExamples(Alone):
    MODULES = ("active", "detection", "odometry", "segmentation")

    def test_neither_ray_caster_nor_bus_are_installed(self):
        for package in ("libembree-dev", "liblcm-dev", "libsqlite3-dev"):
            self.assertNotIn(package, self.packages())

    def test_those_that_read_a_recording_refuse_one_that_is_not_there(self):
        self.refuses("register_scans", "/nothing")
        self.refuses("detect_objects", "/nothing", "0")

    def test_the_next_viewpoint_of_a_map_is_near_its_vehicle(self):
        (self.root / "map.json").write_text(json.dumps({"frame": "world", "objects": [CAR], "ground": []}))
        said = container.command("chroot", self.root, "/examples/next_viewpoint", "/map.json", "0", "0", "3").stdout
        self.assertEqual(said.split()[:3], ["object", "7", "from"], said)


if __name__ == "__main__":
    unittest.main()
