"""`saker mission` through the program: a tiny team's mission, that it goes on, and what it refuses."""

import json
import pathlib
import tempfile
import unittest

from program import ProgramTest, saker

SITE = """kind: mission
mission:
  site: {street_m: 80, parked_share: 0.35, targets: 4, prior_sd_m: 0.5}
  wind: {mean_mps: 1, gust_mps: 0.3}
  capture: {rows: 64, columns: 512}
"""
ROBOTS = """  - {name: R1, x_m: -3, lot_m: [-100, -60, 0, -60, 0, 60, -100, 60]}
  - {name: R2, x_m: 3, yaw_deg: 90, lot_m: [0, -60, 100, -60, 100, 60, 0, 60]}
"""
# Ends on the ground after a second: nothing has come from the sensor's pipeline by then.
AT_ONCE = ("--set", "mission.preflight_s=1")
LEFT = {"R1", "R2", "log.txt", "map.json", "map.png", "map.smap", "map.svg", "mission.json", "prior.json",
        "report.html", "results.json", "table.txt", "truth.json"}
LEFT_BY_A_ROBOT = {"detections.jsonl", "history.bin", "log.txt", "map.json", "map.png", "map.smap", "map.svg",
                   "odometry.txt", "prior.json", "report.html", "results.json", "timings.csv", "trajectory.txt", "trajectory_truth.txt", "truth.json",
                   "viewpoints.csv", "viewpoints.txt"}


def write_mission(folder, robots=ROBOTS, scenario="site.yaml", more=""):
    (folder / "site.yaml").write_text(SITE)
    file = folder / "team.yaml"
    file.write_text(f"scenario: {scenario}\n{more}robots:\n{robots}")
    return file


class Mission(ProgramTest):
    def setUp(self):
        super().setUp()
        self.file = write_mission(self.folder)
        self.out = self.folder / "out"

    def run_at_once(self, *more):
        run = saker("mission", self.file, "-o", self.out, *AT_ONCE, *more)
        self.assertEqual(run.returncode, 1, run.stderr)
        return run

    def bytes_of(self, out):
        """What does not depend on how fast it was."""
        names = ("history.bin", "map.smap", "odometry.txt", "prior.json", "table.txt", "truth.json", "mission.json")
        files = [p for p in sorted(out.rglob("*")) if p.name in names]
        return {str(p.relative_to(out)): p.read_bytes() for p in [*files, out / "results.json"]}

    def test_robots_that_do_not_fly_are_status_1_with_all_files_and_the_cause(self):
        run = self.run_at_once()
        self.assertIn("preflight_deadline", run.stderr)
        self.assertEqual({p.name for p in self.out.iterdir()}, LEFT)
        for robot in ("R1", "R2"):
            self.assertEqual({p.name for p in (self.out / robot).iterdir()}, LEFT_BY_A_ROBOT)

    def test_goes_on_where_it_was_interrupted_and_any_number_of_threads_gives_the_same_bytes(self):
        self.run_at_once("--threads", "1")
        once = self.bytes_of(self.out)
        kept = (self.out / "R1" / "results.json").stat().st_mtime_ns
        (self.out / "R2" / "results.json").unlink()
        (self.out / "results.json").unlink()
        self.run_at_once("--threads", "1")
        self.assertEqual((self.out / "R1" / "results.json").stat().st_mtime_ns, kept)
        self.assertEqual(self.bytes_of(self.out), once)
        self.out = self.folder / "threads"
        self.run_at_once("--threads", "3")
        self.assertEqual(self.bytes_of(self.out), once)
        line = self.refused("mission", self.file, "-o", self.out, *AT_ONCE, "--set", "slam.landmarks.most=999")
        self.assertIn("holds results", line)

    def test_several_seeds_have_folders_and_one_table_that_is_made_again_without_flying(self):
        self.run_at_once("--runs", "2", "--seed", "5")
        self.assertEqual({p.name for p in self.out.iterdir()},
                         {"seed-5", "seed-6", "log.txt", "mission.json", "report.html", "results.json", "table.txt"})
        table = json.loads((self.out / "results.json").read_text())
        self.assertEqual([row["robot"] for row in table["table"]], ["R1", "R2", "together"])
        self.assertEqual([row["targets"] for row in table["table"]][2], 8)
        self.assertEqual([c["against"] for c in table["comparisons"]], ["robots' mean", "R1", "R2"])
        kept = (self.out / "seed-6" / "R1" / "results.json").stat().st_mtime_ns
        before = (self.out / "table.txt").read_bytes()
        (self.out / "table.txt").unlink()
        (self.out / "results.json").unlink()
        self.run_at_once("--runs", "2", "--seed", "5")
        self.assertEqual((self.out / "table.txt").read_bytes(), before)
        self.assertEqual((self.out / "seed-6" / "R1" / "results.json").stat().st_mtime_ns, kept)

    def test_robots_that_fly_as_if_at_once_hear_nothing_of_each_other_and_share_the_work(self):
        self.file = write_mission(self.folder, "  - {name: R1, x_m: -3}\n  - {name: R2, x_m: 3}\n",
                                  more="at_once: true\ndivision: {by_work: true}\n")
        self.run_at_once()
        robots = json.loads((self.out / "results.json").read_text())["robots"]
        self.assertEqual(sum(robot["targets"] for robot in robots), 4)
        self.assertTrue(all(robot["targets"] > 0 and robot["exchange_complete"] for robot in robots))
        told = json.loads((self.out / "R2" / "prior.json").read_text())["objects"]
        self.assertEqual([entry["observations"] for entry in told], [0] * robots[1]["targets"])

    def test_settings_of_the_team_reach_every_robot_and_a_robots_own_come_over_them(self):
        robots = "  - {name: R1, x_m: -3, set: [mission.preflight_s=2]}\n  - {name: R2, x_m: 3}\n"
        file = write_mission(self.folder, robots, more="set: [mission.preflight_s=1]\n")
        run = saker("mission", file, "-o", self.out, "--set", "mission.preflight_s=3")
        self.assertEqual(run.returncode, 1, run.stderr)
        ended = [json.loads((self.out / robot / "results.json").read_text())["events"][-1]["t_s"] for robot in ("R1", "R2")]
        self.assertAlmostEqual(ended[0], 2, delta=0.2)
        self.assertAlmostEqual(ended[1], 1, delta=0.2)

    def test_a_mission_file_that_cannot_be_flown_is_refused_in_one_line(self):
        def refusal(**how):
            return self.refused("mission", write_mission(self.folder, **how), "-o", self.out)

        self.assertIn("scenario", refusal(scenario="''"))
        self.assertIn("nowhere.yaml", refusal(scenario="nowhere.yaml"))
        self.assertIn("robots", refusal(robots="  []\n"))
        self.assertIn("robots[1].name", refusal(robots="  - {name: R1}\n  - {name: R1}\n"))
        self.assertIn("robots[0].name", refusal(robots="  - {name: small}\n"))
        self.assertIn("lot_m", refusal(robots="  - {name: R1, lot_m: [0, 0, 1]}\n"))
        self.assertIn("by_work", refusal(more="division: {by_work: true}\n"))
        self.assertIn("lot_m", refusal(robots="  - {name: R1, lot_m: [500, 500, 501, 500, 501, 501]}\n"))
        self.assertIn("x_m", refusal(robots="  - {name: R1, x_m: .nan}\n"))
        self.assertIn("policy", refusal(robots="  - {name: R1, policy: best}\n"))
        self.assertIn("hight_m", refusal(robots="  - {name: R1, hight_m: 3}\n"))
        self.assertIn("slam.nothing", refusal(robots="  - {name: R1, set: [slam.nothing=1]}\n"))
        self.assertRegex(refusal(more="set: [slam.nothing=1]\n"), "team.yaml: set: .*slam.nothing")
        self.assertIn("no free place", refusal(robots="  - {name: R1, x_m: 900, y_m: 900}\n"))
        self.assertIn("loss", refusal(more="link: {loss: 2}\n"))
        self.assertIn("gone.yaml", self.refused("mission", self.folder / "gone.yaml", "-o", self.out))
        (self.folder / "site.yaml").write_text("kind: flight\n")
        self.assertIn("mission", self.refused("mission", self.file, "-o", self.out))


class FlownMission(unittest.TestCase):
    """Two robots, each with its part of four vehicles, flown once for all facts."""

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="saker_mission_")
        cls.addClassCleanup(holder.cleanup)
        folder = pathlib.Path(holder.name)
        cls.out = folder / "out"
        cls.mission = saker("mission", write_mission(folder), "-o", cls.out, timeout=1200)
        cls.results = json.loads((cls.out / "results.json").read_text())

    def test_every_target_is_in_the_merged_map(self):
        self.assertEqual(self.mission.returncode, 0, self.mission.stderr)
        merged = self.results["merged"]
        self.assertEqual((merged["found"], merged["targets"]), (4, 4))
        self.assertLess(merged["mae_m"], 0.25)
        self.assertEqual(sum(robot["targets"] for robot in self.results["robots"]), 4)

    def test_both_trajectories_lie_in_base_as_well_as_their_take_offs_are_known(self):
        for robot in self.results["robots"]:
            self.assertLess(robot["merged_trajectory_error_m"], 0.6, robot)

    def test_a_flight_reaches_the_base_over_the_lossy_link_in_fewer_bytes_than_twice_its_history(self):
        for robot in self.results["robots"]:
            self.assertTrue(robot["exchange_complete"])
            self.assertGreater(robot["history_bytes"], 500)
        first = self.results["robots"][0]
        self.assertGreater(first["exchange_bytes"], first["history_bytes"])
        self.assertLess(first["exchange_bytes"], 2 * first["history_bytes"] + 2000)

    def test_the_second_robot_is_told_what_the_first_one_mapped_of_its_lot(self):
        second = self.results["robots"][1]
        prior = json.loads((self.out / "R2" / "prior.json").read_text())
        told = [entry for entry in prior["objects"] if entry["observations"] > 0]
        self.assertEqual(len(told), second["known"] + second["weak"])

    def test_a_minute_counts_for_all_as_if_they_flew_at_once(self):
        merged, robots = self.results["merged"], self.results["robots"]
        longest = max(r["flight_time_s"] + r["exchange_s"] for r in robots)
        self.assertAlmostEqual(merged["longest_s"], longest)
        self.assertAlmostEqual(merged["objects_per_min"], 60 * merged["found"] / longest)


if __name__ == "__main__":
    unittest.main()
