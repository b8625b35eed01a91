"""What hangs or throws in the executive, by processes: no watchdog is starved by who only informs, and the vehicle
comes to rest, then down, where what it flies by does not come any more.

stalled_calls.cc, loaded before the executive's libraries, makes the calls of one thread hang or throw.
"""

import json
import os
import re
import signal
import socket
import tempfile
import threading
import time
import unittest

from fault_flight import Flight

STARVED = 2   # s, WatchdogSec= of the unit
FED = 1.5     # s between two feeds at most, on a busy machine
KEY = "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f"


@unittest.skipUnless(os.environ.get("SAKER_NAMESPACE") == "yes", "runs by in_namespace.sh")
class Stall(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="saker_stall_")
        self.addCleanup(holder.cleanup)
        self.folder = holder.name
        self.fed = []
        manager = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        manager.bind(f"{self.folder}/notify")
        threading.Thread(target=self.listen, args=(manager,), daemon=True).start()
        environment = {"LD_PRELOAD": os.environ["STALLED_CALLS"], "SAKER_STALL": f"{self.folder}/stall",
                       "NOTIFY_SOCKET": f"{self.folder}/notify"}
        self.flight = Flight(holder.name, settings=self.exchange(), environment=environment)
        self.addCleanup(self.flight.end)

    def exchange(self):
        key = f"{self.folder}/team.key"
        with open(os.open(key, os.O_WRONLY | os.O_CREAT, 0o400), "w") as file:
            file.write(KEY + "\n")
        return (f"exchange.key_file={key}", f"exchange.folder={self.folder}/exchange", "exchange.landed_s=3")

    def listen(self, manager):
        """To what the service manager is told: when the watchdog was fed."""
        while True:
            if b"WATCHDOG=1" in manager.recv(512):
                self.fed.append(time.monotonic())

    def stall(self, words):
        """In fast flight. The simulator's row at that moment."""
        begin = self.flight.fly_fast()
        self.begun = time.monotonic()
        with open(f"{self.folder}/stall.new", "w") as file:
            file.write(words)
        os.rename(f"{self.folder}/stall.new", f"{self.folder}/stall")
        return begin

    def log(self):
        return self.flight.log("saker-flight")

    def says(self, *causes, seconds=40):
        for cause in causes:
            self.flight.wait(lambda: re.search(cause, self.log()), seconds, cause)

    def fed_all_the_time(self):
        times = [self.begun] + [t for t in self.fed if t > self.begun]
        longest = max(b - a for a, b in zip(times, times[1:]))
        self.assertLess(longest, FED, self.flight.logs())

    def comes_down(self, begin, seconds=60):
        """Without a collision; it says when it was at rest for the first time."""
        def down():
            rows = self.flight.rows()
            return rows and not rows[-1].armed
        self.flight.wait(down, seconds, "landing")
        rows = [row for row in self.flight.rows() if row.t > begin.t]
        rest = next(row.t for row in rows if row.calm)
        print(f"{self._testMethodName}: at rest or landing after {rest - begin.t:.2f} s, down after "
              f"{rows[-1].t - begin.t:.2f} s")
        self.assertEqual(rows[-1].collisions, 0, self.flight.logs())
        return rest - begin.t

    def ends(self, status, seconds=40):
        process = self.flight.processes["saker-flight"]
        self.flight.wait(lambda: process.poll() is not None, seconds, "end")
        self.assertEqual(process.returncode, status, self.flight.logs())

    def whole(self, *names):
        for name in names:
            text = (self.flight.out / name).read_text()
            self.assertTrue(text.endswith("\n") or json.loads(text), name)
        self.assertEqual([f for f in os.listdir(self.flight.out) if f.endswith(".part")], [])

    # What only informs.

    # Hazard: Stages and links | the disk stalls under the exchange | the flight goes on and ends within its bound | –
    def test_exchange(self):
        """The disk takes nothing any more: the flight goes on, and ends."""
        begin = self.stall("sync exchange")
        self.says("exchange hangs")
        self.assertNotIn(" hold: ", self.log())
        self.says("tour → return", seconds=150)
        self.comes_down(begin, 90)
        self.says("exchange does not end", "the process ends without the loops that hang")
        self.fed_all_the_time()
        self.ends(0)
        self.whole("map.json", "trajectory.txt", "odometry.txt", "loops.json")

    # Hazard: Stages and links | the main thread hangs | the flight goes on; SIGTERM lands | –
    def test_main(self):
        """Log, MISSION and HEALTH stand still; the vehicle flies, and a signal lands it."""
        begin = self.stall("hang saker-flight")
        self.flight.wait(lambda: self.flight.rows()[-1].t > begin.t + 4, 20, "flight after it")
        self.assertTrue(all(not row.landing for row in self.flight.rows() if row.t > begin.t))
        self.flight.processes["saker-flight"].send_signal(signal.SIGTERM)
        self.comes_down(begin)
        self.fed_all_the_time()

    # What it flies by.

    def stale(self, thread, cause):
        begin = self.stall(f"hang {thread}")
        self.says(f"{thread} hangs", f"hold: {cause}", f"hold → landing: {cause}")
        self.comes_down(begin)
        self.fed_all_the_time()
        self.ends(1)
        self.whole("map.json", "odometry.txt", "loops.json")

    # Hazard: Stages and links | planning hangs | holds after 4 s, lands 10 s later | 2
    def test_planning(self):
        self.stale("planning", "planning_stale")

    # Hazard: Stages and links | mapping hangs | holds after 5 s, lands 10 s later | 2
    def test_mapping(self):
        self.stale("mapping", "mapping_stale")

    # Hazard: Stages and links | guidance hangs | setpoints expire: the flight controller holds; it lands | 2
    def test_guidance(self):
        self.stale("guidance", "guidance_silent")

    # Hazard: Stages and links | the loop of the pose hangs | holds, then silence: the flight controller descends | 2
    def test_pose(self):
        """The pose stands still: nothing is flown by it; the flight controller comes down by itself."""
        begin = self.stall("hang pose")
        self.says("pose hangs", "hold: odometry_stale: no pose for", "landing: (odometry_lost|vehicle_descends)")
        self.assertLess(self.comes_down(begin), 2)
        self.fed_all_the_time()

    # Hazard: Stages and links | safety hangs | guidance holds; the watchdog ends the executive; the flight controller descends | 2
    def test_safety(self):
        """Nobody watches: guidance stops, the watchdog starves."""
        begin = self.stall("hang safety")
        self.says("safety hangs")
        self.flight.wait_for_row(lambda row: row.t > begin.t + 3, 20, "flight after it")
        rows = [row for row in self.flight.rows() if row.t > begin.t]
        rest = next(row.t for row in rows if row.calm)
        print(f"{self._testMethodName}: at rest after {rest - begin.t:.2f} s")
        self.assertLess(rest - begin.t, 2)
        time.sleep(STARVED)
        self.assertLess(max(self.fed), self.begun + FED)

    # What throws.

    def throws(self, thread, cause):
        begin = self.stall(f"throw {thread}")
        self.says(f"{thread} threw, . times so far: std::bad_alloc", f"{thread} is switched off", f"hold: {cause}",
                  f"hold → landing: {cause}")
        self.comes_down(begin)
        self.fed_all_the_time()
        self.ends(1)
        self.whole("map.json", "trajectory.txt", "odometry.txt", "loops.json")

    # Hazard: Stages and links | planning throws | off after three times in a row, counted, then as one that hangs | 2
    def test_planning_throws(self):
        self.throws("planning", "planning_stale")

    # Hazard: Stages and links | mapping throws | off after three times in a row, counted, then as one that hangs | 2
    def test_mapping_throws(self):
        self.throws("mapping", "mapping_stale")


if __name__ == "__main__":
    unittest.main()
