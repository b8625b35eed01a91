"""A real flight, saker-ground and a real browser: what the page shows is what flies, and its orders are obeyed."""

import os
import pathlib
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "flight"))
from base_processes import BIN, BaseTest  # noqa: E402
from fault_flight import Flight  # noqa: E402

SCRIPT = pathlib.Path(__file__).resolve().parents[1] / "ground_page/fly_in_browser.js"


@unittest.skipUnless(os.environ.get("SAKER_NAMESPACE") == "yes", "runs by in_namespace.sh")
class InABrowser(BaseTest):
    def test_the_page_shows_what_flies_and_sends_it_home(self):
        flight = Flight(self.folder, settings=(f"exchange.key_file={self.key}",))
        self.addCleanup(flight.end)
        ground = subprocess.Popen([BIN / "saker-ground", "--port", "0", "--set", f"ground.folder={self.folder / 'ground'}",
                                   "--set", f"exchange.key_file={self.key}"], stdout=subprocess.PIPE, stdin=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(ground.stdout.close)
        self.addCleanup(self.end, ground)
        address = ground.stdout.readline().strip()
        flight.wait_for_row(lambda row: row.flying, 40, "take-off")
        run = subprocess.run([shutil.which("node"), SCRIPT, address], capture_output=True, text=True, timeout=200)
        print(run.stdout)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr + flight.logs())
        log = flight.log("saker-flight")
        self.assertRegex(log, r"hold accepted")
        self.assertRegex(log, r"return accepted")
        self.assertIn("landing → done: landed", log)
        self.assertEqual(flight.rows()[-1].collisions, 0)


if __name__ == "__main__":
    if not shutil.which("node"):
        print("skipped: node is not there")
        sys.exit(77)
    there = subprocess.run([shutil.which("node"), SCRIPT], capture_output=True, text=True)
    if there.returncode != 0:
        print(there.stdout.strip(), there.stderr.strip())
        sys.exit(there.returncode)
    unittest.main()
