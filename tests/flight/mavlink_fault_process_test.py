"""What is killed beside an autopilot, by processes: at rest or landing within two seconds where somebody lives to say so, within
the autopilot's own time-outs else; a log says why.

mavlink_fault_test.cc does the rest of what goes wrong about the bridge, in made time.
"""

import itertools
import os
import re
import tempfile
import unittest

from fault_flight import Flight

SETTLED = 2  # s
ALONE = {"ardupilot": 10, "px4": SETTLED}  # s: without setpoints ArduPilot brakes, but drifts; 8 s without odometry: LAND
WATCHED = 6  # s of the flight after that: it must stay so
UP = 90      # s until it is on its way: the autopilot's sensors settle first


@unittest.skipUnless(os.environ.get("SAKER_NAMESPACE") == "yes", "runs by in_namespace.sh")
class MavlinkFault(unittest.TestCase):
    def killed(self, name, autopilot, settled):
        holder = tempfile.TemporaryDirectory(prefix="saker_mavlink_fault_")
        self.addCleanup(holder.cleanup)
        flight = Flight(holder.name, mavlink=autopilot)
        self.addCleanup(flight.end)
        begin = flight.fly_fast(UP)
        flight.kill(name)
        end = flight.wait_for_row(lambda row: row.t > begin.t + settled + WATCHED or not row.armed, 3 * (settled + WATCHED), "flight after it")
        rows = [row for row in flight.rows() if begin.t < row.t <= end.t]
        first = next((row for row in rows if row.calm), None)
        self.assertIsNotNone(first, flight.logs())
        print(f"{self._testMethodName}: at rest or landing after {first.t - begin.t:.2f} s")
        self.assertLessEqual(first.t - begin.t, settled, flight.logs())
        self.assertTrue(all(row.calm or not row.flying for row in rows if row.t > begin.t + settled), flight.logs())
        # Where nobody lives who sees, ArduPilot's landing drifts by metres to wherever the wind has it: only the way to it counts.
        seen = rows if settled == SETTLED else list(itertools.takewhile(lambda row: not row.landing, rows))
        self.assertEqual(seen[-1].collisions, 0, flight.logs())
        return flight

    def bridge_killed(self, autopilot):
        flight = self.killed("saker-mavlink", autopilot, ALONE[autopilot])
        self.assertIn("vehicle_silent", flight.log("saker-flight"), flight.logs())

    def executive_killed(self, autopilot):
        flight = self.killed("saker-flight", autopilot, SETTLED)
        self.assertRegex(flight.log("saker-mavlink"), "odometry is lost", flight.logs())
        self.assertTrue(re.search(r"autopilot: mode (9|100925440)\b", flight.log("saker-sim")), flight.logs())

    # Hazard: Autopilot | the bridge is killed | the autopilot's own time-outs; the executive says `vehicle_silent` | 10
    def test_bridge_killed_ardupilot(self):
        self.bridge_killed("ardupilot")

    def test_bridge_killed_px4(self):
        self.bridge_killed("px4")

    # Hazard: Autopilot | the executive is killed behind a bridge | the bridge orders LAND | 2
    def test_executive_killed_ardupilot(self):
        self.executive_killed("ardupilot")

    def test_executive_killed_px4(self):
        self.executive_killed("px4")


if __name__ == "__main__":
    unittest.main()
