"""Bad recordings, models and outputs through the program: one line and status 2, or counted and status 0."""

import base64
import json
import random
import shutil
import struct
import unittest
from xml.etree import ElementTree

from program import ROOT, ProgramTest, saker

FLIGHT = """kind: flight
flight:
  duration_s: 0.4
  capture: {columns: 512}
"""


def room(rng, points=4000):
    """A scan of a floor and four walls, as KITTI's floats."""
    rows = []
    for _ in range(points):
        x, y, z = rng.uniform(-12, 12), rng.uniform(-9, 9), -1.7
        if rng.random() < 0.6:
            z = rng.uniform(-1.7, 2)
            x, y = (x, rng.choice((-9, 9))) if rng.random() < 0.5 else (rng.choice((-12, 12)), y)
        rows.append(struct.pack("<4f", x, y, z, 0.3))
    return b"".join(rows)


class BadInput(ProgramTest):
    def capture(self):
        """A short simulated capture; its folder holds one *.pcap."""
        scenario = self.folder / "flight.yaml"
        scenario.write_text(FLIGHT)
        folder = self.folder / "capture"
        run = saker("simulate-scans", scenario, "-o", folder)
        self.assertEqual(run.returncode, 0, run.stderr)
        return folder

    def drive(self, scans):
        folder = self.folder / "drive"
        folder.mkdir()
        rng = random.Random(1)
        for i in range(scans):
            (folder / f"{i:06d}.bin").write_bytes(room(rng))
        return folder

    def replayed(self, recording, status=0):
        out = self.folder / "out"
        run = saker("replay", recording, "-o", out, "--threads", 1)
        self.assertEqual(run.returncode, status, run.stderr)
        rows = (out / "trajectory.txt").read_text().splitlines()
        self.assertNotIn("nan", "".join(rows))
        return json.loads((out / "results.json").read_text()), rows

    def test_bad_scans_among_good_ones_are_counted_and_named(self):
        drive = self.drive(10)
        (drive / "000003.bin").write_bytes(struct.pack("<4f", *[float("nan")] * 4) * 1000)
        (drive / "000005.bin").write_bytes(b"")
        (drive / "000007.bin").write_bytes(b"12345")
        results, rows = self.replayed(drive, status=1)
        self.assertIn("3 of 10 scans were not registered", results["shortfalls"][0])
        self.assertEqual(len(rows), 10)
        named = {scan["name"] for scan in results["scans_not_registered"]}
        self.assertEqual(named, {"000003", "000005", "000007"})
        self.assertEqual(results["source"]["faulty_scans"], 2)

    def test_a_folder_with_one_capture_opens_and_a_cut_one_ends_early(self):
        folder = self.capture()
        results, rows = self.replayed(folder, status=1)
        self.assertIn("no object", results["shortfalls"][0])  # four scans are too few to be sure of one
        self.assertEqual(len(rows), 4)
        whole = (folder / "flight.pcap").read_bytes()
        (folder / "flight.pcap").write_bytes(whole[: len(whole) * 3 // 5])
        run = saker("replay", folder, "-o", self.folder / "cut")
        self.assertLess(run.returncode, 2, run.stderr)
        self.assertIn("ends early", run.stderr)
        shutil.copy(folder / "flight.pcap", folder / "second.pcap")
        self.assertIn("2 captures", self.refused("replay", folder, "-o", self.folder / "two"))

    def test_a_capture_or_metadata_that_is_broken_is_refused(self):
        folder = self.capture()
        capture, metadata = folder / "flight.pcap", folder / "flight.json"
        good = metadata.read_text()
        broken = [b"", b"not json", b"{}", good.replace("RNG19_RFL8_SIG16_NIR16", "RNG99").encode(),
                  good.replace("beam_altitude_angles", "beam_angles").encode()]
        for text in broken:
            with self.subTest(metadata=text[:20]):
                metadata.write_bytes(text)
                self.assertIn("flight.json", self.refused("replay", capture, "-o", self.folder / "o"))
        metadata.unlink()
        self.assertIn("flight.json", self.refused("replay", capture, "-o", self.folder / "o"))
        metadata.write_text(good)
        for bytes_ in (b"", b"no capture at all, only text", capture.read_bytes()[:30]):
            with self.subTest(capture=bytes_[:10]):
                capture.write_bytes(bytes_)
                self.assertIn("flight.pcap", self.refused("replay", capture, "-o", self.folder / "o"))

    def test_a_model_that_is_missing_or_wrong_is_refused(self):
        drive = self.drive(2)
        model = self.folder / "m.onnx"
        setting = ("--set", f"segmentation.model={model}")
        command = ("segment", drive, "-o", self.folder / "o", *setting)
        self.assertIn("m.onnx", self.refused(*command))
        sidecar = (ROOT / "configs/models/segmentation.yaml").read_text()
        model.write_bytes(b"no network")
        self.assertIn("m.yaml", self.refused(*command))
        model.with_suffix(".yaml").write_text(sidecar)
        self.assertIn("sha256", self.refused(*command))
        shutil.copy(ROOT / "configs/models/segmentation.onnx", model)
        model.with_suffix(".yaml").write_text(sidecar.replace("vehicle", "vessel"))
        self.assertIn("classes", self.refused(*command))

    def test_an_output_that_cannot_be_or_was_written_is_refused(self):
        drive = self.drive(2)
        blocked = self.folder / "file"
        blocked.write_text("in the way")
        self.assertIn("file/out", self.refused("replay", drive, "-o", blocked / "out"))
        full = self.folder / "full"
        full.mkdir()
        (full / "map.json").write_text("{}")
        self.assertIn("--force", self.refused("replay", drive, "-o", full))
        self.assertIn("no folder", self.refused("view", drive, "--scan", 0, "-o", self.folder / "no/v.png"))

    def test_view_names_a_scan_that_is_not_there_and_draws_one_that_is(self):
        drive = self.drive(3)
        self.assertIn("3 scans", self.refused("view", drive, "--scan", 3, "-o", self.folder / "v.png"))
        run = saker("view", drive, "--scan", 2, "-o", self.folder / "v.png")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual((self.folder / "v.png").read_bytes()[:4], b"\x89PNG")
        svg = ElementTree.parse(self.folder / "v.svg").getroot()
        width, height = (float(size) for size in svg.get("viewBox").split()[2:])
        for image in svg.iter("{http://www.w3.org/2000/svg}image"):  # two strips and the points
            self.assertLess(float(image.get("x")) + float(image.get("width")), width)
            png = base64.b64decode(image.get("{http://www.w3.org/1999/xlink}href").split(",")[1], validate=True)
            self.assertEqual(png[:4], b"\x89PNG")
        texts = [text.text for text in svg.iter("{http://www.w3.org/2000/svg}text")]
        for text in ("x, m", "y, m", "vehicle", "class"):
            self.assertIn(text, texts)
        self.assertIn("--force", self.refused("view", drive, "--scan", 2, "-o", self.folder / "v.svg"))


if __name__ == "__main__":
    unittest.main()
