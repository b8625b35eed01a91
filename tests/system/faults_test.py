"""`saker faults` through the program: what it leaves, that it goes on and replays, and what it refuses."""

import json
import unittest

from program import ProgramTest, saker

SITE = """kind: mission
mission:
  site: {targets: 2}
  capture: {columns: 512, rows: 32}
"""


class Faults(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scenario = self.folder / "site.yaml"
        self.scenario.write_text(SITE)
        self.out = self.folder / "out"

    def search(self, *more):
        return saker("faults", self.scenario, "-o", self.out, "--seconds", "12", "--threads", "2", *more)

    def record(self, seed):
        return json.loads((self.out / f"{seed:06}.json").read_text())

    def test_each_flight_leaves_its_record(self):
        run = self.search("--runs", "2")
        self.assertIn(run.returncode, (0, 1), run.stderr)
        broken = any(self.record(seed)["breaches"] for seed in (1, 2))
        self.assertEqual(run.returncode, int(broken))
        for seed in (1, 2):
            record = self.record(seed)
            self.assertEqual(record["seed"], seed)
            self.assertIn(len(record["schedule"]), (1, 2, 3))
        self.assertIn("2 flights", run.stdout)

    def test_what_is_there_is_not_flown_again(self):
        self.search("--runs", "1")
        file = self.out / "000001.json"
        kept = file.stat().st_mtime_ns
        self.search("--runs", "2")
        self.assertEqual(file.stat().st_mtime_ns, kept)
        self.assertTrue((self.out / "000002.json").is_file())

    def test_a_record_replays_to_the_byte(self):
        self.search("--runs", "1")
        again = saker("faults", self.scenario, "--replay", self.out / "000001.json")
        self.assertNotIn("another path", again.stderr)
        self.assertEqual(json.loads(again.stdout)["digest"], self.record(1)["digest"])

    def test_another_path_is_said(self):
        self.search("--runs", "1")
        record = self.record(1) | {"digest": "0" * 64}
        file = self.folder / "other.json"
        file.write_text(json.dumps(record))
        again = saker("faults", self.scenario, "--replay", file)
        self.assertEqual(again.returncode, 1)
        self.assertIn("another path than recorded", again.stderr)

    def test_what_is_no_record_is_refused(self):
        file = self.folder / "other.json"
        for text in ("{", "[]", '{"seed": 1}'):
            file.write_text(text)
            run = saker("faults", self.scenario, "--replay", file)
            self.assertEqual(run.returncode, 2, text)
            self.assertIn("no record of a flight", run.stderr)

    def flown(self, *schedule, seconds=32):
        """What comes of these faults, one after the other from 16 s on, in the air: (kind, place)."""
        file = self.folder / "made.json"
        faults = [{"kind": kind, "place": place, "at_s": 16 + i, "lasts_s": None, "strength": 1, "towards_deg": 0, "seed": 1}
                  for i, (kind, place) in enumerate(schedule)]
        file.write_text(json.dumps({"seed": 1, "most_s": seconds, "schedule": faults, "digest": ""}))
        return json.loads(saker("faults", self.scenario, "--replay", file).stdout)

    def test_an_order_is_obeyed(self):
        record = self.flown(("order", "land"), ("order", "resume"))
        self.assertEqual(record["breaches"], [])
        self.assertIn({"to": "landing", "cause": "ordered"},
                      [{key: event[key] for key in ("to", "cause")} for event in record["events"]])
        self.assertIn("order_refused", [event["cause"] for event in record["events"]])

    # Hazard: Stages and links | the executive is started again in the air | the new one does not fly; the flight controller holds,
    #   then comes down | 2
    def test_without_an_executive_it_comes_down(self):
        record = self.flown(("restart", "executive"))
        self.assertEqual(record["breaches"], [])
        self.assertNotEqual(record["phase"], "done")
        self.assertGreater(record["flight_time_s"], 0)

    # Hazard: Stages and links | the disk is full | the flight is the same to the byte; files of before stay whole | –
    def test_a_full_disk_leaves_the_flight_as_it_was(self):
        full, whole = self.flown(("disk", "full")), self.flown()
        self.assertEqual(full["digest"], whole["digest"])
        self.assertGreater(full["files_failed"], 0)
        self.assertEqual(whole["files_failed"], 0)

    def test_a_search_needs_a_folder(self):
        run = saker("faults", self.scenario)
        self.assertEqual(run.returncode, 2)
        self.assertIn("-o OUT is missing", run.stderr)


if __name__ == "__main__":
    unittest.main()
