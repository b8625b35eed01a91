"""`saker soak` through the program: a minute of flight, what it leaves, and what it refuses."""

import json
import os
import pathlib
import socket
import sys
import time
import unittest

from program import ROOT, ProgramTest, saker

sys.path.insert(0, str(ROOT / "scripts/evidence"))

import soak_samples  # pylint: disable=wrong-import-position

SITE = """kind: mission
mission:
  site: {targets: 1}
  capture: {columns: 512, rows: 16}
"""


class Soak(ProgramTest):
    def test_a_minute_leaves_samples_a_table_and_a_picture(self):
        scenario, out = self.folder / "site.yaml", self.folder / "out"
        scenario.write_text(SITE)
        run = saker("soak", scenario, "-o", out, "--hours", "0.0167", "--seconds", "12", "--worlds", "1", timeout=280)
        self.assertIn(run.returncode, (0, 1), run.stderr)
        samples = [json.loads(line) for line in (out / "soak.jsonl").read_text().splitlines()]
        self.assertGreaterEqual(len(samples), 5)
        self.assertGreaterEqual(samples[-1]["t_h"], 0.0167)
        self.assertEqual(len({sample["handles"] for sample in samples}), 1, samples)
        self.assertEqual(len({sample["threads"] for sample in samples[1:]}), 1, samples)
        self.assertLess(samples[-1]["memory_mb"], 1.1 * samples[1]["memory_mb"])
        self.assertTrue(all(0 < sample["waiting"] < 100 for sample in samples), samples)
        self.assertIn("saker", run.stdout.splitlines()[1])
        self.assertEqual((out / "table.txt").read_text(), run.stdout)
        self.assertTrue((out / "memory.svg").read_text().startswith("<"))

    def samples(self, percent):
        file = self.folder / "samples.jsonl"
        rows = [{"process": "a", "t_h": i / 20, "memory_mb": 100 + percent * i / 20, "handles": 5, "threads": 1}
                for i in range(21)]
        file.write_text("".join(json.dumps(row) + "\n" for row in rows))
        return file

    def test_samples_of_other_processes_are_judged_alike(self):
        self.assertEqual(saker("soak", "--samples", self.samples(0), "-o", self.folder / "a").returncode, 0)
        leak = saker("soak", "--samples", self.samples(2), "-o", self.folder / "b")
        self.assertEqual(leak.returncode, 1)
        self.assertIn("a: memory grows by ", leak.stderr)

    def test_a_process_in_real_time_is_sampled_with_what_it_has_not_read(self):
        process = soak_samples.Process("this", pathlib.Path(f"/proc/{os.getpid()}"), time.monotonic())
        before = process.sample()
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as own:
            own.bind(("127.0.0.1", 0))
            own.sendto(bytes(5000), own.getsockname())
            held = bytearray(40_000_000)
            after = process.sample()
        self.assertEqual(after["handles"], before["handles"] + 1)
        self.assertGreaterEqual(after["waiting"], before["waiting"] + 5)
        self.assertGreater(after["memory_mb"], before["memory_mb"] + 0.9e-6 * len(held))

    def test_what_is_no_sample_is_refused(self):
        file = self.folder / "samples.jsonl"
        file.write_text("{}\n")
        self.assertIn("samples.jsonl:1: ", self.refused("soak", "--samples", file, "-o", self.folder / "out"))
        file.write_text("")
        self.assertIn("no samples", self.refused("soak", "--samples", file, "-o", self.folder / "out"))
        self.assertFalse((self.folder / "out").exists())

    def test_either_a_scenario_or_samples(self):
        self.assertIn("either", self.refused("soak", "-o", self.folder / "out"))


if __name__ == "__main__":
    unittest.main()
