"""What goes wrong in flight, by processes: at rest or landing within two seconds, nothing is hit, a log says why.

tests/autonomy/fault_test.cc does the same in lockstep, where details can be looked at.
"""

import math
import os
import re
import tempfile
import unittest

from fault_flight import FAST, Flight

SETTLED = 2  # s
WATCHED = 4  # s of the flight after the fault: it must stay so


def event(kind, more=""):
    return f"{{kind: {kind}, at_s: 0, from_speed_mps: {FAST}{more}}}"


def farthest(objects):
    """Of the prior map, from the take-off point."""
    return [max(objects, key=lambda o: math.hypot(*o["position"][:2]))]


@unittest.skipUnless(os.environ.get("SAKER_NAMESPACE") == "yes", "runs by in_namespace.sh")
class Fault(unittest.TestCase):
    def fly(self, fault="", **settings):
        holder = tempfile.TemporaryDirectory(prefix="saker_fault_")
        self.addCleanup(holder.cleanup)
        flight = Flight(holder.name, fault, **settings)
        self.addCleanup(flight.end)
        return flight

    def settles(self, flight, begin, stays=True):
        """At rest or landing within two seconds of the simulator's time, and so to the end."""
        end = flight.wait_for_row(lambda row: row.t > begin.t + WATCHED or not row.armed, 3 * WATCHED,
                                  "flight after it")
        rows = [row for row in flight.rows() if begin.t < row.t <= end.t]
        first = next((row for row in rows if row.calm), None)
        self.assertIsNotNone(first, flight.logs())
        print(f"{self._testMethodName}: at rest or landing after {first.t - begin.t:.2f} s")
        self.assertLessEqual(first.t - begin.t, SETTLED, flight.logs())
        if stays:
            self.assertTrue(all(row.calm for row in rows if row.t > begin.t + SETTLED), flight.logs())
        self.assertEqual(end.collisions, 0, flight.logs())

    def says(self, flight, process, cause):
        self.assertIn(cause, flight.log(process), flight.logs())

    # Hazard: Stages and links | the executive is killed in flight | the flight controller holds, then lands | 2
    def test_executive_killed(self):
        flight = self.fly()
        begin = flight.fly_fast()
        flight.kill("saker-flight")
        self.settles(flight, begin)
        self.says(flight, "saker-sim", "no odometry")

    # Hazard: Stages and links | the collision checker is killed | stops, goes on with the new one or lands | 2
    def test_checker_killed(self):
        flight = self.fly()
        begin = flight.fly_fast()
        flight.kill("saker-collision-checker")
        self.settles(flight, begin)
        self.says(flight, "saker-flight", "hold: checker_silent: no verdict for")

    def test_not_marked(self):
        """Nothing would keep a restart from beginning a mission in the air: it does not arm."""
        flight = self.fly(settings=("mission.preflight_s=15",), environment={"RUNTIME_DIRECTORY": "/nowhere"})
        self.assertEqual(flight.processes["saker-flight"].wait(timeout=60), 1, flight.logs())
        self.says(flight, "saker-flight", "no take-off: the flight could not be marked")
        self.assertFalse(any(row.armed for row in flight.rows()))

    def test_simulator_killed(self):
        """The plant itself is gone: the executive says so, saves its map and ends."""
        flight = self.fly()
        flight.fly_fast()
        flight.kill("saker-sim")
        cause = re.compile("hold: (lidar_silent: no scan for|vehicle_silent: no state of the vehicle for)")
        flight.wait(lambda: cause.search(flight.log("saker-flight")), SETTLED, "cause")
        self.assertEqual(flight.processes["saker-flight"].wait(timeout=15), 1, flight.logs())
        self.says(flight, "saker-flight", "done: vehicle_silent: neither vehicle nor lidar")
        self.assertTrue((flight.out / "map.json").exists())

    def test_lidar_stops(self):
        flight = self.fly(event("lidar_stop"))
        self.settles(flight, flight.fly_into_event())
        self.says(flight, "saker-flight", "hold: lidar_silent: no scan for")

    def test_odometry_freezes(self):
        flight = self.fly(event("odometry_freeze"))
        self.settles(flight, flight.fly_into_event())
        self.says(flight, "saker-flight", "vehicle_descends: the flight controller rejects the odometry")
        self.says(flight, "saker-sim", "odometry rejected")

    def test_obstacle_in_the_way(self):
        """So near that it stops at once, on a leg that is longer, whichever target the tour begins with."""
        flight = self.fly(event("obstacle", ", ahead_m: 3.4"), prior=farthest)
        self.settles(flight, flight.fly_into_event(), stays=False)  # it finds a way around
        self.says(flight, "saker-flight", "stopped: blocked at")


if __name__ == "__main__":
    unittest.main()
