"""`saker-mavlink check` and the row of `saker doctor` against the simulated aircraft behind ArduPilot's MAVLink: what fits, what differs, what is written."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("SAKER_BIN", ROOT / "build/release/bin"))
LINE = "mavlink.line=udp:listen:14550"
SCENARIO = """kind: mission
mission:
  site: {street_m: 80, parked_share: 0.35, targets: 1}
  capture: {rows: 16, columns: 512}
"""


@unittest.skipUnless(os.environ.get("SAKER_NAMESPACE") == "yes", "runs by in_namespace.sh")
class Check(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory(prefix="saker_check_")
        cls.folder = pathlib.Path(cls.holder.name)
        (cls.folder / "one.yaml").write_text(SCENARIO)
        cls.simulator = subprocess.Popen(
            [BIN / "saker-sim", cls.folder / "one.yaml", "-o", cls.folder / "sim", "--mavlink", "ardupilot", "--mavlink-line",
             "udp:127.0.0.1:14550"], stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        cls.simulator.send_signal(signal.SIGKILL)
        cls.simulator.wait()
        cls.holder.cleanup()

    def check(self, *more):
        return subprocess.run([BIN / "saker-mavlink", "check", "--set", LINE, *more], capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=60, check=False)

    def doctor(self, *more):
        run = subprocess.run([BIN / "saker", "doctor", "--set", LINE, *more], capture_output=True, text=True,
                             stdin=subprocess.DEVNULL, timeout=60, check=False)
        return next(line for line in run.stdout.splitlines() if line[7:].startswith("autopilot "))

    def test_1_doctor_says_who_is_there_and_that_its_parameters_fit(self):
        self.assertRegex(self.doctor(), r"^ok +autopilot +ardupilot, system 1, \d+ parameters fit$")

    def test_1_what_flew_in_the_simulator_fits(self):
        run = self.check()
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("ardupilot, system 1", run.stdout)
        self.assertNotIn("wrong", run.stdout)

    def test_2_what_differs_is_said_with_its_reason_and_written_only_when_asked_twice(self):
        table = self.folder / "table.yaml"
        table.write_text("autopilot: ardupilot\nparameters:\n  - {name: VISO_TYPE, values: [2], why: another camera}\n")
        run = self.check("--table", table)
        self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
        self.assertIn("another camera", run.stdout)
        self.assertEqual(self.check("--table", table, "--write").returncode, 2)
        self.assertEqual(self.check("--table", table).returncode, 1, "nothing was written")
        self.assertEqual(self.check("--table", table, "--write", "--confirm", "write").returncode, 0)
        self.assertEqual(self.check("--table", table).returncode, 0)

    def test_3_the_latency_is_compared_with_the_measured_one(self):
        run = self.check("--latency-ms", "90")
        self.assertEqual(run.returncode, 1)
        self.assertIn("VISO_DELAY_MS", run.stdout)

    def test_4_another_autopilot_is_refused(self):
        run = self.check("--set", "mavlink.autopilot=px4")
        self.assertEqual(run.returncode, 2)
        self.assertIn("mavlink.autopilot", run.stderr)

    def test_4_doctor_says_that_another_autopilot_is_there(self):
        row = self.doctor("--set", "mavlink.autopilot=px4")
        self.assertRegex(row, "^wrong +autopilot +mavlink.autopilot: the line has kind 3 .*, expected 12 .px4.")

    def test_5_doctor_names_what_differs(self):
        table = self.folder / "doctor.yaml"
        table.write_text("autopilot: ardupilot\nparameters:\n  - {name: VISO_TYPE, values: [3], why: another camera}\n"
                         "  - {name: EK3_ENABLE, values: [1], why: the same}\n")
        self.assertRegex(self.doctor("--set", f"mavlink.table={table}"),
                         "^wrong +autopilot +ardupilot, system 1, not as they have to be: VISO_TYPE$")

    def test_5_doctor_says_what_it_waited_for(self):
        self.assertRegex(self.doctor("--set", "mavlink.line=udp:listen:14999"),
                         "^worse +autopilot +no heartbeat on udp:listen:14999 for 2.5 s$")

    def test_6_doctor_leaves_the_line_to_a_bridge_that_runs(self):
        bridge = subprocess.Popen([BIN / "saker-mavlink", "--set", LINE], stderr=subprocess.PIPE, text=True)
        try:
            for line in bridge.stderr:
                if "is system 1" in line:
                    break
            self.assertRegex(self.doctor(), rf"^ok +autopilot +saker-mavlink of R1 .process {bridge.pid}. has its line")
        finally:
            bridge.terminate()
            bridge.communicate()

    def test_5_a_silent_line_is_status_1(self):
        run = self.check("--set", "mavlink.line=udp:listen:14999")
        self.assertEqual(run.returncode, 1)
        self.assertIn("no heartbeat", run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
