"""scripts/fly when something goes wrong: one process dies, somebody interrupts, the scenario is none."""

import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIO = ROOT / "configs/scenarios/small.yaml"


def pids_below(folder):
    """Of the flight's processes: their command lines name a file below its folder."""
    found = {}
    for entry in pathlib.Path("/proc").iterdir():
        try:
            words = (entry / "cmdline").read_bytes().decode().split("\0") if entry.name.isdigit() else [""]
        except OSError:
            continue
        name = pathlib.Path(words[0]).name
        if name.startswith("saker-") and any(str(folder) in word for word in words):
            found[name] = int(entry.name)
    return found


class Fly(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        namespace = subprocess.run([ROOT / "tests/flight/in_namespace.sh", "true"], capture_output=True, text=True)
        if namespace.returncode == 77:
            raise unittest.SkipTest(namespace.stderr)

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="saker_fly_")
        self.addCleanup(holder.cleanup)
        self.out = pathlib.Path(holder.name)

    def start(self, scenario=SCENARIO, *options, before=()):
        self.run = subprocess.Popen([*before, ROOT / "scripts/fly", scenario, self.out, *options], stdin=subprocess.DEVNULL,
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                    env=os.environ | {"SAKER_BIN": os.path.dirname(os.environ["SAKER"])})
        self.addCleanup(self.run.kill)

    def await_all(self):
        deadline = time.monotonic() + 60
        while len(pids_below(self.out)) < 3:
            self.assertIsNone(self.run.poll(), "ended before all processes had begun")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.1)
        time.sleep(3)  # beyond their set-up
        return pids_below(self.out)

    def ended(self, limit):
        text, _ = self.run.communicate(timeout=limit)
        self.assertEqual(pids_below(self.out), {})
        return text

    def test_a_process_that_dies_ends_all_and_is_named(self):
        self.start()
        os.kill(self.await_all()["saker-collision-checker"], signal.SIGKILL)
        text = self.ended(30)
        self.assertEqual(self.run.returncode, 1, text)
        self.assertIn("saker-collision-checker ended with status 137", text)
        self.assertIn("listens as R1", text)

    def test_with_a_page_its_address_is_printed_and_it_ends_with_the_flight(self):
        self.start(SCENARIO, "1", "--page", before=[ROOT / "tests/flight/in_namespace.sh"])
        self.assertIn("saker-ground", self.await_all())
        self.run.send_signal(signal.SIGTERM)
        text = self.ended(30)
        self.assertRegex(text, r"(?m)^http://127\.0\.0\.1:\d+/$")

    def test_an_interrupt_ends_all(self):
        self.start()
        self.await_all()
        self.run.send_signal(signal.SIGTERM)
        text = self.ended(30)
        self.assertEqual(self.run.returncode, 130, text)

    def test_a_scenario_that_is_none_is_said_by_the_simulator(self):
        self.start(self.out / "nowhere.yaml")
        text = self.ended(30)
        self.assertEqual(self.run.returncode, 1, text)
        self.assertIn("saker-sim ended with status 2", text)
        self.assertIn("nowhere.yaml", text)


if __name__ == "__main__":
    unittest.main()
