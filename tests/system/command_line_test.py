"""The program from outside: what is wrong gets one line on stderr and status 2, never a crash."""

import json
import unittest
import xml.etree.ElementTree

from program import ROOT, ProgramTest, saker

MAP = ROOT / "tests/objects/version_1.json"


class CommandLine(ProgramTest):
    def test_the_default_configuration_can_be_read_back(self):
        run = saker("config", "--config", ROOT / "configs/default.yaml")
        self.assertEqual(run.stdout, (ROOT / "configs/default.yaml").read_text(), run.stderr)

    def test_a_preset_is_over_the_defaults_and_below_what_else_is_said(self):
        preset = saker("config", "--all", "--preset", "paper").stdout
        for line in ("fitter: hull", "policy: paper", "measurement_noise: fixed", "every_window: true"):
            self.assertIn(line, preset)
        self.assertIn("policy: saker", saker("config", "--preset", "paper", "--set", "active.policy=saker").stdout)
        self.assertIn("expected one of paper, visit", self.refused("config", "--preset", "papper"))

    def test_a_setting_shows_in_the_effective_configuration(self):
        default = saker("config").stdout
        changed = saker("config", "--set", "rates.slam_hz=1.25").stdout
        differing = [b for a, b in zip(default.splitlines(), changed.splitlines()) if a != b]
        self.assertEqual(len(differing), 1)
        self.assertIn("slam_hz: 1.25", differing[0])

    def test_a_wrong_configuration_is_refused(self):
        file = self.folder / "c.yaml"
        file.write_text("rates:\n  slam_hs: 2\n")
        self.assertEqual(self.refused("config", "--config", file),
                         f"saker config: {file}:2: rates.slam_hs: unknown key, the nearest is rates.slam_hz")
        self.assertIn("rates.slam_hz", self.refused("config", "--set", "rates.slam_hz=1e9"))
        self.assertIn("no_such.yaml", self.refused("config", "--config", self.folder / "no_such.yaml"))

    def test_every_command_refuses_a_wrong_configuration(self):
        for command in (["scans", "x.pcap"], ["replay", "x"], ["segment", "x"], ["simulate-scans", "x"]):
            with self.subTest(command=command[0]):
                line = self.refused(*command, "-o", self.folder / "out", "--set", "rates.slam_hs=2")
                self.assertIn("rates.slam_hz", line)

    def test_an_input_that_is_not_there_is_named(self):
        for command in ("scans", "replay", "segment", "simulate-scans"):
            with self.subTest(command=command):
                line = self.refused(command, self.folder / "no_such_input", "-o", self.folder / "out")
                self.assertIn("no_such_input", line)

    def test_an_empty_folder_is_refused(self):
        (self.folder / "empty").mkdir()
        for command in ("replay", "segment"):
            with self.subTest(command=command):
                self.assertIn("empty", self.refused(command, self.folder / "empty", "-o", self.folder / "o"))

    def test_what_is_no_map_is_refused(self):
        bad = self.folder / "bad.json"
        bad.write_text("{")
        for command in (["info", bad], ["eval", bad, bad], ["convert", bad, self.folder / "b.smap"]):
            with self.subTest(command=command[0]):
                self.assertIn("bad.json", self.refused("map", *command))

    def test_a_map_goes_into_every_form(self):
        for form in ("json", "smap", "csv", "ply", "geojson", "kml"):
            with self.subTest(form=form):
                run = saker("map", "convert", MAP, self.folder / f"m.{form}", "--origin", "48.1,-11.6")
                self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual((self.folder / "m.json").read_bytes(), MAP.read_bytes())
        self.assertIn("--origin", self.refused("map", "convert", MAP, self.folder / "n.geojson"))
        self.assertIn("--origin", self.refused("map", "convert", MAP, self.folder / "n.kml"))
        self.assertIn(".geojson", self.refused("map", "convert", MAP, self.folder / "n.txt"))
        self.assertIn("--region", self.refused("map", "convert", MAP, self.folder / "n.json", "--region", "1,2,0,3"))

    def test_kml_is_well_formed_and_stands_where_the_sites_origin_says(self):
        told, set_ = self.folder / "told.kml", self.folder / "set.kml"
        self.assertEqual(saker("map", "convert", MAP, told, "--origin", "48.1,-11.6", "--heading", "30").returncode, 0)
        run = saker("map", "convert", MAP, set_, "--set", "site.origin=[48.1, -11.6, 30]")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(told.read_text(), set_.read_text())
        names = {"k": "http://www.opengis.net/kml/2.2"}
        marks = xml.etree.ElementTree.parse(told).getroot().findall(".//k:Placemark", names)
        self.assertEqual(len(marks), len(json.loads(MAP.read_text())["objects"]))
        for mark in marks:
            for corner in mark.find(".//k:coordinates", names).text.split():
                longitude, latitude, height = map(float, corner.split(","))
                self.assertAlmostEqual(longitude, -11.6, delta=0.01)
                self.assertAlmostEqual(latitude, 48.1, delta=0.01)
                self.assertGreater(height, 0)

    def test_what_is_whole_of_a_damaged_map_is_kept(self):
        saker("map", "convert", MAP, self.folder / "m.smap", "--compact")
        damaged = bytearray((self.folder / "m.smap").read_bytes())
        damaged[6] ^= 1
        (self.folder / "m.smap").write_bytes(damaged)
        run = saker("map", "convert", self.folder / "m.smap", self.folder / "n.csv")
        self.assertEqual(run.returncode, 1)
        self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.assertEqual(len((self.folder / "n.csv").read_text().splitlines()), 3)
        self.assertIn("m.smap", self.refused("map", "eval", self.folder / "m.smap", MAP))


if __name__ == "__main__":
    unittest.main()
