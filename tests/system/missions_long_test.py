"""Missions of minutes: the demo's twice, many seeds among obstacles, half an hour in the air."""

import os
import statistics
import unittest

from missions import fly, memory_of
from program import ProgramTest

FOUR_SIDES = ("--set", "active.visit.sides=4", "--set", "active.visit.separation_deg=60",
              "--set", "active.visit.oblique_worth_m=10")
RUNS = int(os.environ.get("SAKER_MISSIONS", "5"))


class LongMissions(ProgramTest):
    def test_the_demo_flown_twice_leaves_the_same_bytes(self):
        maps = []
        for name in ("first", "second"):
            results = fly("demo", self.folder / name)
            self.assertEqual(results["found"], results["targets"])
            maps.append((self.folder / name / "map.smap").read_bytes())
        self.assertEqual(*maps)

    def test_many_seeds_among_obstacles_collide_with_nothing(self):
        table = fly("obstacles", self.folder / "out", "--runs", RUNS)["table"]
        print(f"{RUNS} missions among obstacles: {table}", flush=True)
        self.assertEqual(sum(row["runs"] for row in table), RUNS)
        self.assertEqual(sum(row["collisions"] for row in table), 0)

    def test_memory_does_not_grow_in_the_last_third_of_half_an_hour(self):
        sizes, results = memory_of("long", self.folder / "out", *FOUR_SIDES, "--set", "mission.tour_s=2400")
        tenth = len(sizes) // 10
        before = statistics.median(sizes[2 * len(sizes) // 3:][:tenth])
        after = statistics.median(sizes[-tenth:])
        growth = after / before - 1
        print(f"{results['flight_time_s']:.0f} s in the air: {after / 1e3:.0f} MB, "
              f"{100 * growth:.1f} % more than after two thirds of it", flush=True)
        self.assertGreater(results["flight_time_s"], 1500)
        self.assertLess(growth, 0.02)


if __name__ == "__main__":
    unittest.main()
