"""`saker experiment` through the program: what it leaves, that it goes on, and what it refuses."""

import json
import unittest

from program import ProgramTest, saker

SITE = """kind: mission
mission:
  site: {targets: 3}
  capture: {columns: 512}
"""
# Ends on the ground after a second: nothing has come from the sensor's pipeline by then.
AT_ONCE = ("--set", "mission.preflight_s=1")
LEFT = {"detections.jsonl", "experiment.json", "history.bin", "log.txt", "map.json", "map.png", "map.smap", "map.svg", "odometry.txt",
        "prior.json", "report.html", "results.json", "table.txt", "timings.csv", "trajectory.txt", "trajectory_truth.txt",
        "truth.json", "viewpoints.csv", "viewpoints.txt"}


class Experiment(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scenario = self.folder / "site.yaml"
        self.scenario.write_text(SITE)
        self.out = self.folder / "out"

    def fly(self, *more):
        return saker("experiment", self.scenario, "-o", self.out, *AT_ONCE, *more)

    def test_a_mission_that_falls_short_is_status_1_with_its_reason_and_all_its_files(self):
        run = self.fly()
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("preflight_deadline", run.stderr)
        self.assertEqual({p.name for p in self.out.iterdir()}, LEFT)
        results = json.loads((self.out / "results.json").read_text())
        self.assertFalse(results["succeeded"])
        self.assertEqual((results["targets"], results["found"]), (3, 0))
        self.assertEqual(results["collisions"], 0)
        self.assertIsNone(results["mae_m"])
        self.assertEqual(results["events"][-1]["to"], "done")

    def test_what_is_finished_is_not_flown_again(self):
        self.assertEqual(self.fly("--runs", "2").returncode, 1)
        first, second = (self.out / f"seed-{n}" / "results.json" for n in (1, 2))
        kept = first.stat().st_mtime_ns
        second.unlink()
        run = self.fly("--runs", "2")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertEqual(first.stat().st_mtime_ns, kept)
        self.assertTrue(second.is_file())
        table = json.loads((self.out / "results.json").read_text())["table"]
        self.assertEqual([row["runs"] for row in table], [2])

    def bytes_of(self, out):
        """What does not depend on how fast it was."""
        names = ("experiment.json", "map.smap", "odometry.txt", "prior.json", "table.txt", "truth.json")
        files = [p for p in sorted(out.rglob("*")) if p.name in names]
        return {str(p.relative_to(out)): p.read_bytes() for p in [*files, out / "results.json"]}

    def test_side_by_side_and_after_an_interruption_all_bytes_are_the_same(self):
        several = ("--runs", "3")
        self.assertEqual(self.fly(*several, "--threads", "1").returncode, 1)
        alone = self.bytes_of(self.out)
        self.assertEqual(len(alone), 3 * 4 + 3)
        (self.out / "seed-2" / "results.json").unlink()
        self.assertEqual(self.fly(*several).returncode, 1)
        self.assertEqual(self.bytes_of(self.out), alone)
        self.out = self.folder / "side_by_side"
        self.assertEqual(self.fly(*several, "--threads", "3").returncode, 1)
        self.assertEqual(self.bytes_of(self.out), alone)
        for seed in (1, 2, 3):
            self.assertIn("preflight_deadline", (self.out / f"seed-{seed}" / "log.txt").read_text())

    def test_the_same_seed_gives_the_same_bytes(self):
        self.assertEqual(self.fly().returncode, 1)
        once = {name: (self.out / name).read_bytes() for name in ("map.smap", "odometry.txt", "prior.json")}
        self.assertEqual(self.fly("--force", "--threads", "2").returncode, 1)
        for name, content in once.items():
            self.assertEqual((self.out / name).read_bytes(), content, name)

    def test_variants_are_flown_in_the_same_world_under_their_names(self):
        variants = ("--variant", "near active.policy=visit active.visit.sides=2", "--variant", "far active.view.farthest_m=20")
        self.assertEqual(self.fly(*variants, "--threads", "2").returncode, 1)
        table = json.loads((self.out / "results.json").read_text())["table"]
        self.assertEqual([row["policy"] for row in table], ["near", "far"])
        self.assertEqual([row["reachable"] for row in table], [3, 3])
        self.assertEqual(*[(self.out / name / "truth.json").read_bytes() for name in ("near", "far")])
        named = json.loads((self.out / "experiment.json").read_text())["variants"]
        self.assertEqual(named[1], {"name": "far", "settings": ["active.view.farthest_m=20"]})

    def test_a_variant_without_a_name_one_of_an_unknown_key_and_one_named_twice_are_refused(self):
        for variants, word in (([""], "NAME KEY=VALUE"), (["one no.such.key=1"], "no.such.key"), (["one", "one"], "twice")):
            given = [part for variant in variants for part in ("--variant", variant)]
            self.assertIn(word, self.refused("experiment", self.scenario, "-o", self.out, *given))

    def test_another_experiment_into_the_same_folder_is_refused(self):
        self.assertEqual(self.fly().returncode, 1)
        line = self.refused("experiment", self.scenario, "-o", self.out, *AT_ONCE, "--seed", "2")
        self.assertIn("holds results", line)

    def test_a_scenario_of_another_kind_and_one_that_is_not_there_are_refused(self):
        self.scenario.write_text("kind: flight\n")
        self.assertIn("mission", self.refused("experiment", self.scenario, "-o", self.out))
        self.assertIn("nowhere.yaml",
                      self.refused("experiment", self.folder / "nowhere.yaml", "-o", self.out))

    def test_a_site_without_room_is_refused(self):
        self.scenario.write_text("kind: mission\nmission:\n  site: {targets: 100}\n")
        self.assertIn("targets", self.refused("experiment", self.scenario, "-o", self.out))
        for errors, word in (("mistaken: 90", "trees and poles"), ("invented: .nan", "invented"),
                             ("missing_share: 2", "missing_share")):
            self.scenario.write_text(f"kind: mission\nmission:\n  site: {{prior_errors: {{{errors}}}}}\n")
            self.assertIn(word, self.refused("experiment", self.scenario, "-o", self.out))


if __name__ == "__main__":
    unittest.main()
