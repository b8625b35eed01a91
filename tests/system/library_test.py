"""Saker as a library: installed below a prefix, found from a folder outside, used by the examples."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from program import ROOT, saker

BUILD = pathlib.Path(os.environ.get("SAKER_BUILD", ROOT / "build/release"))
SCANS = "kind: flight\nflight:\n  duration_s: 2\n  speed_mps: 2.0\n  height_m: 3.4\n  capture: {rows: 64, columns: 512}\n"


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=600, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, words))}: status {done.returncode}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


class Library(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="saker_library_")
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        cls.prefix = cls.folder / "prefix"
        run("cmake", "--install", BUILD, "--prefix", cls.prefix)
        cls.manifest = (BUILD / "install_manifest.txt").read_text().split()
        shutil.copytree(ROOT / "examples", cls.folder / "examples")
        build = cls.folder / "build"
        run("cmake", "-S", cls.folder / "examples", "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={cls.prefix}",
            "-DCMAKE_CXX_COMPILER_LAUNCHER=")
        run("cmake", "--build", build)
        cls.examples = build
        (cls.folder / "scans.yaml").write_text(SCANS)
        cls.recording = cls.folder / "flight"
        made = saker("simulate-scans", cls.folder / "scans.yaml", "-o", cls.recording)
        assert made.returncode == 0, made.stderr

    def test_nothing_is_installed_outside_of_the_prefix(self):
        self.assertGreater(len(self.manifest), 100)
        for file in self.manifest:
            self.assertTrue(file.startswith(f"{self.prefix}/"), file)

    def test_what_is_installed_names_no_folder_of_the_sources(self):
        for file in (self.prefix / "lib/cmake/saker").iterdir():
            self.assertNotIn(str(ROOT), file.read_text(), file.name)

    def test_a_header_lies_where_it_is_included_from(self):
        for header in ("odometry/odometry.h", "active/active.h", "multirobot/merge.h"):
            self.assertTrue((self.prefix / "include/saker" / header).is_file(), header)

    def test_poses_are_those_of_replay(self):
        rows = run(self.examples / "register_scans", self.recording).splitlines()
        out = self.folder / "replay"
        self.assertEqual(saker("replay", self.recording, "-o", out).returncode, 0)
        said = (out / "odometry.txt").read_text().splitlines()
        said = [row for row in said if not row.startswith("#")]
        self.assertEqual(len(rows), len(said))
        for row, other in zip(rows, said):
            for a, b in zip(map(float, row.split()), map(float, other.split())):
                self.assertAlmostEqual(a, b, delta=1e-5)

    def test_a_scan_of_a_street_shows_vehicles(self):
        objects = json.loads(run(self.examples / "detect_objects", self.recording, 5))["objects"]
        lengths = [o["size"][0] for o in objects if o["class"] == "vehicle"]
        self.assertTrue(lengths)
        self.assertTrue(all(1 < length < 15 for length in lengths), lengths)

    def test_a_roughly_known_vehicle_is_to_be_seen_from_nearby(self):
        car = {"id": 7, "class": "vehicle", "probability": 1, "observations": 1, "position": [12, 3, 0.8],
               "rotation": [0, 0, 0, 1], "size": [4.5, 1.8, 1.5]}
        (self.folder / "map.json").write_text(json.dumps({"frame": "world", "objects": [car], "ground": []}))
        line = run(self.examples / "next_viewpoint", self.folder / "map.json", 0, 0, 3).splitlines()[0]
        words = line.split()
        self.assertEqual(words[:3], ["object", "7", "from"])
        x, y, z = map(float, words[3:6])
        distance = ((x - 12) ** 2 + (y - 3) ** 2) ** 0.5
        self.assertTrue(2 < distance < 15 and 1 < z < 10, line)


if __name__ == "__main__":
    unittest.main()
