"""A flight by real processes beside a base that holds another robot's: heard before take-off, told after landing."""

import json
import math
import os
import re
import subprocess
import tempfile
import unittest

from base_processes import BIN, BaseTest
from fault_flight import SCENARIO, Flight

LONGEST = 240  # s, of a flight with its exchange
NEAR = 1.0     # m: of a merged object from where it was seen


def place(mapped):
    return mapped["position" if "position" in mapped else "root"]


@unittest.skipUnless(os.environ.get("SAKER_NAMESPACE") == "yes", "runs by in_namespace.sh")
class ExchangeOfAFlight(BaseTest):
    def test_a_robot_hears_of_the_others_before_it_flies_and_the_base_of_it_afterwards(self):
        self.start_base()
        self.wait(lambda: "listens as BASE" in self.log("base"), 20, "base")
        self.another_robot_tells()
        holder = tempfile.TemporaryDirectory(prefix="saker_exchange_")
        self.addCleanup(holder.cleanup)
        flight = Flight(holder.name, settings=(f"exchange.key_file={self.key}", "team.takeoff.position_m=[0,0,0]",
                                               f"exchange.folder={self.folder / 'robot'}"))
        self.addCleanup(flight.end)
        status = flight.processes["saker-flight"].wait(timeout=LONGEST)
        self.assertEqual(status, 0, flight.logs())
        log = flight.log("saker-flight")
        self.what_is_known_well_is_not_visited(log)
        self.the_merged_map_has_what_either_saw(flight)
        self.the_base_has_all_byte_for_byte(flight, log)
        late = re.search(r"guidance: (\d+) of (\d+) runs late", log)
        print(f"guidance: {late.group(1)} of {late.group(2)} runs late")

    def another_robot_tells(self):
        subprocess.run([BIN / "told_flight", "R2", SCENARIO, self.folder / "R2"], check=True, stdout=subprocess.DEVNULL)
        told = (self.folder / "R2" / "history.bin").read_bytes()
        robot = self.start_robot("R2")
        self.wait(lambda: self.stored().get(("R2", 1)) == told, 20, "flight of R2 at the base")
        self.stop(robot)

    def what_is_known_well_is_not_visited(self, log):
        self.assertIn("told by the team: R2 flight 1 (12 of 12 keyframes); plans with 2 objects: 3 targets, 1 known "
                      "well by others, 0 not well enough", log)
        self.assertIn("target 2 of 3", log)
        self.assertNotIn("target 1 of 3", log)

    def the_merged_map_has_what_either_saw(self, flight):
        merged = json.loads((flight.out / "merged.json").read_text())
        self.assertEqual(merged["frame"], "base")
        others = json.loads((self.folder / "R2" / "objects.json").read_text())["objects"]
        own = [o for o in json.loads((flight.out / "map.json").read_text())["objects"] if o["class"] == "vehicle"]
        self.assertGreater(len(own), 1)
        for seen in others + own:
            least = min(math.dist(place(o), place(seen)) for o in merged["objects"] if o["class"] == seen["class"])
            self.assertLess(least, NEAR, seen)

    def the_base_has_all_byte_for_byte(self, flight, log):
        self.assertIn("the base has this flight, number 1", log)
        told = (flight.out / "history.bin").read_bytes()
        self.assertGreater(len(told), 1000)
        self.assertEqual(self.stored()["R1", 1], told)
        lines = subprocess.run([BIN / "saker", "base", "status", "--store", self.folder / "base" / "base.db"],
                               capture_output=True, text=True, check=True).stdout.splitlines()
        told_by_r1 = [line.split()[:5] for line in lines if line.startswith("R1 ")]
        self.assertEqual(told_by_r1[0], ["R1", "history", "1", str(len(told)), "0"], lines)
        self.assertEqual(told_by_r1[1][:3], ["R1", "prior_map", "1"], lines)


if __name__ == "__main__":
    unittest.main()
