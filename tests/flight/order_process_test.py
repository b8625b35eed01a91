"""Orders by real processes: simulator, checker and executive over LCM, `saker order` on the ground, and three attackers."""

import os
import subprocess
import tempfile
import time
import unittest

from base_processes import BIN, BaseTest
from fault_flight import FAST, Flight

SETTLED = 2  # s
HELD = 11    # s: longer than the ladder waits before it lands
NETWORK = "udpm://239.255.76.67:7667?ttl=0"
ELSEWHERE = "udpm://239.255.76.67:7700?ttl=0"  # a network that the robot is not on


@unittest.skipUnless(os.environ.get("SAKER_NAMESPACE") == "yes", "runs by in_namespace.sh")
class Orders(BaseTest):
    def fly(self, key):
        holder = tempfile.TemporaryDirectory(prefix="saker_order_")
        self.addCleanup(holder.cleanup)
        flight = Flight(holder.name, settings=(f"exchange.key_file={key}",))
        self.addCleanup(flight.end)
        return flight

    def order(self, robot, order, *more, key=None):
        """(status, the line that it prints)"""
        run = subprocess.run([BIN / "saker", "order", robot, order, "--set", f"exchange.key_file={key or self.key}",
                              *more], capture_output=True, text=True, timeout=30)
        return run.returncode, run.stdout + run.stderr

    def accepted(self, flight, order):
        status, line = self.order("R1", order)
        self.assertEqual((status, line.count("\n")), (0, 1), line + flight.logs())
        self.assertTrue(line.startswith(f"R1 {order} accepted: "), line)

    def listen(self, url, seconds, suffix):
        listener = subprocess.Popen([BIN / "lcm_probe", "hear", url, str(seconds), suffix], stdout=subprocess.PIPE,
                                    text=True)
        self.addCleanup(self.end, listener)
        self.addCleanup(listener.stdout.close)
        time.sleep(0.5)
        return listener

    def heard(self, listener):
        return [tuple(line.split()) for line in listener.communicate(timeout=30)[0].splitlines()]

    def say(self, channel, hex_bytes):
        subprocess.run([BIN / "lcm_probe", "say", NETWORK, channel, hex_bytes, "1", "100"], check=True)

    def refusals(self):
        """The counter of HEALTH."""
        name = b"orders_refused\0"
        for channel, data in reversed(self.heard(self.listen(NETWORK, 2.5, "_HEALTH"))):
            data = bytes.fromhex(data)
            if channel == "R1_HEALTH" and name in data:
                at = data.index(name) + len(name)
                return int.from_bytes(data[at:at + 8], "big")
        self.fail("no HEALTH of the executive")

    def refused(self, flight, why, count):
        flight.wait(lambda: flight.log("saker-flight").count(f"an order is refused: {why}") >= count, 5, why)

    # Hazard: Orders and the radio | orders that are replayed, forged, late or another robot's | refused, counted, said in a line | –
    def test_a_robot_obeys_who_has_the_key_and_nobody_else(self):
        flight = self.fly(self.key)
        flight.fly_fast()
        listener = self.listen(NETWORK, 3, "_ORDER")
        self.accepted(flight, "hold")
        begin = flight.rows()[-1]
        captured = [data for channel, data in self.heard(listener) if channel == "R1_ORDER"][0]
        flight.wait_for_row(lambda row: row.t > begin.t + HELD, 3 * HELD, "hold")
        rows = [row for row in flight.rows() if row.t > begin.t + SETTLED]
        self.assertTrue(all(row.calm for row in rows), flight.logs())
        self.assertFalse(any(row.landing for row in rows), flight.logs())
        self.accepted(flight, "resume")
        flight.wait_for_row(lambda row: row.ground_speed > FAST, 30, "flight after the hold")
        self.attack(flight, captured)
        self.assertEqual(self.refusals(), 4)
        self.assertNotIn("holds until another order", flight.log("saker-flight").split("resume accepted")[1])
        self.accepted(flight, "abort")
        self.assertEqual(flight.processes["saker-flight"].wait(timeout=60), 1, flight.logs())
        self.assertIn("landing → done: landed: outcome: ordered", flight.log("saker-flight"))
        self.assertEqual(flight.rows()[-1].collisions, 0)
        self.assertEqual(self.order("R1", "hold", "--wait", "1"), (1, "R1 hold no answer: nothing is heard of it\n"))

    def attack(self, flight, captured):
        self.say("R1_ORDER", captured)                                     # reads along, replays
        self.refused(flight, "heard before", 1)
        self.say("R1_ORDER", captured[:-8] + "00000000")                   # forges
        self.refused(flight, "not sealed by the team's key for this robot", 1)
        self.say("R1_ORDER", self.stolen("R2", "abort"))                   # what was said to another robot
        self.refused(flight, "not sealed by the team's key for this robot", 2)
        held_back = self.stolen("R1", "abort")                             # what it never heard, later
        time.sleep(2.1)
        self.say("R1_ORDER", held_back)
        self.refused(flight, "held back, or sealed by another clock (OPERATOR)", 1)

    def stolen(self, robot, order):
        """The bytes of an order that nobody hears."""
        listener = self.listen(ELSEWHERE, 2, "_ORDER")
        self.order(robot, order, "--wait", "0.5", "--set", f"bus.control_url={ELSEWHERE}")
        return self.heard(listener)[0][1]

    # Hazard: Orders and the radio | no key of the team | no order is obeyed; SIGTERM lands | –
    def test_without_the_teams_key_no_order_is_obeyed_and_sigterm_lands(self):
        flight = self.fly(self.folder / "no.key")
        self.assertEqual(flight.wait_for_row(lambda row: row.flying, 30, "take-off").collisions, 0)
        status, line = self.order("R1", "abort", "--wait", "2")
        self.assertEqual(status, 1, line)
        self.refused(flight, "there is no key of a team to open it by", 1)
        self.assertNotIn("landing", flight.log("saker-flight"))
        flight.processes["saker-flight"].terminate()
        self.assertEqual(flight.processes["saker-flight"].wait(timeout=60), 1, flight.logs())
        self.assertIn("landing: ordered: ordered to land", flight.log("saker-flight"))

    def test_what_is_no_order_is_refused_in_one_line(self):
        for words, why in ((("R1", "stop"), "expected hold, resume, return, land or abort"), (("r1", "hold"), "r1"),
                           (("R1", "hold", "--as", "me"), "name of a sender me")):
            status, line = self.order(*words)
            self.assertEqual((status, line.count("\n")), (2, 1), line)
            self.assertIn(why, line)
        status, line = self.order("R1", "hold", key=self.folder / "no.key")
        self.assertEqual(status, 2, line)
        self.assertIn("cannot read", line)


if __name__ == "__main__":
    unittest.main()
