"""A flight by real processes beside a base: what the robot has to tell is there when it ends."""

import os
import re
import subprocess
import tempfile
import unittest

from base_processes import BIN, BaseTest
from fault_flight import Flight

LONGEST = 240  # s, of a flight with its exchange


@unittest.skipUnless(os.environ.get("SAKER_NAMESPACE") == "yes", "runs by in_namespace.sh")
class ExchangeOfAFlight(BaseTest):
    def test_after_landing_the_base_holds_the_robots_history_byte_for_byte(self):
        self.start_base()
        self.wait(lambda: "listens as BASE" in self.log("base"), 20, "base")
        holder = tempfile.TemporaryDirectory(prefix="saker_exchange_")
        self.addCleanup(holder.cleanup)
        flight = Flight(holder.name, settings=(f"exchange.key_file={self.key}",
                                               f"exchange.folder={self.folder / 'robot'}"))
        self.addCleanup(flight.end)
        status = flight.processes["saker-flight"].wait(timeout=LONGEST)
        log = flight.log("saker-flight")
        self.assertEqual(status, 0, flight.logs())
        self.assertIn("the base has this flight, number 1", log)
        told = (flight.out / "history.bin").read_bytes()
        self.assertGreater(len(told), 1000)
        self.assertEqual(self.stored()["R1", 1], told)
        lines = subprocess.run([BIN / "saker", "base", "status", "--store", self.folder / "base" / "base.db"],
                               capture_output=True, text=True, check=True).stdout.splitlines()
        self.assertEqual(lines[1].split()[:5], ["R1", "history", "1", str(len(told)), "0"], lines)
        late = re.search(r"guidance: (\d+) of (\d+) runs late", log)
        print(f"{len(told)} bytes; guidance: {late.group(1)} of {late.group(2)} runs late")


if __name__ == "__main__":
    unittest.main()
