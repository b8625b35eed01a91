"""saker evaluate as a user calls it: what it leaves, and labels that are wrong."""

import json
import struct
import unittest

from program import ProgramTest, saker


class Evaluate(ProgramTest):
    def setUp(self):
        super().setUp()
        self.drive = self.folder / "drive"
        (self.drive / "velodyne").mkdir(parents=True)
        (self.drive / "labels").mkdir()
        points = [(10 + 0.1 * (i % 40), 0.1 * (i // 40), 0.1 * (i % 7)) for i in range(800)]
        (self.drive / "velodyne/000000.bin").write_bytes(
            b"".join(struct.pack("<4f", *p, 0.3) for p in points))
        self.labels = self.drive / "labels/000000.label"
        self.labels.write_bytes(struct.pack("<I", 10) * len(points))

    def boxes(self, **changes):
        box = {"class": "Car", "position": [12, 1, 0.3], "size": [5, 3, 1.5], "yaw": 0, **changes}
        (self.drive / "boxes.json").write_text(json.dumps({"000000": [box]}))

    def test_figures_pictures_and_the_log_are_left(self):
        self.boxes()
        out = self.folder / "out"
        run = saker("evaluate", self.drive, "-o", out)
        self.assertEqual(run.returncode, 0, run.stderr)
        figures = json.loads((out / "evaluation.json").read_text())
        vehicle, car = figures["classes"]["vehicle"], figures["boxes"]["car"]
        self.assertEqual(vehicle["labelled_points"], 800)
        self.assertEqual(vehicle["precision"], 1 if vehicle["predicted_points"] else None)
        self.assertEqual(car["boxes"], 1)
        self.assertAlmostEqual(car["mean_share"], vehicle["recall"], places=3)
        missed = sum(scan["missed_points"] for scan in figures["worst"])
        self.assertEqual(missed, 800 - vehicle["predicted_points"])
        self.assertEqual(len(list(out.glob("missed_*.png"))), len(figures["worst"]))
        self.assertIn("expected calibration error", run.stdout)

    def test_an_output_is_not_needed(self):
        run = saker("evaluate", self.drive)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("vehicle", run.stdout)

    def test_pieces_have_a_table(self):
        out = self.folder / "out"
        run = saker("evaluate", self.drive, "-o", out, "--pieces")
        self.assertEqual(run.returncode, 0, run.stderr)
        for family, kinds in ("cylinders", ",crowned,bare,neither"), ("vehicles", ",vehicle,neither"):
            header = (out / f"{family}.csv").read_text().splitlines()[0]
            self.assertTrue(header.startswith("scan,one,") and header.endswith(kinds), header)

    def test_pieces_without_a_folder_for_them_are_refused(self):
        self.assertIn("-o OUT", self.refused("evaluate", self.drive, "--pieces"))

    def test_labels_of_another_length_are_refused(self):
        self.labels.write_bytes(b"\0" * 8)
        self.assertIn("000000.label: 8 bytes, expected 3200", self.refused("evaluate", self.drive))

    def test_a_folder_without_labels_is_refused(self):
        self.labels.unlink()
        self.assertIn("nothing is labelled", self.refused("evaluate", self.drive))

    def test_labels_of_other_scans_are_refused(self):
        self.labels.rename(self.labels.with_stem("000007"))
        self.assertIn("no scan that could be read is labelled",
                      self.refused("evaluate", self.drive))

    def test_boxes_that_are_wrong_are_named(self):
        self.boxes(size=[4, 2])
        self.assertIn("boxes.json 000000[0].size", self.refused("evaluate", self.drive))
        (self.drive / "boxes.json").write_text("{")
        self.assertIn("boxes.json", self.refused("evaluate", self.drive))

    def test_a_map_without_labelled_vehicles_is_refused(self):
        self.assertIn("vehicles.json", self.refused("evaluate", self.drive, "--map", self.folder))


if __name__ == "__main__":
    unittest.main()
