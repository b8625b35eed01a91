"""saker doctor finds what a namespace lacks, and says what mends it."""

import os
import pathlib
import subprocess
import tempfile
import unittest

IN_NAMESPACE = pathlib.Path(__file__).with_name("in_namespace.sh")
SAKER = os.environ["SAKER"]


def doctor(*options, command=(SAKER, "doctor")):
    run = subprocess.run([IN_NAMESPACE, *options, *command], capture_output=True, text=True, timeout=60)
    if run.returncode == 77:
        raise unittest.SkipTest(run.stderr)
    return run


def line_of(run, subject):
    return next(line for line in run.stdout.splitlines() if line[7:].startswith(subject + "  "))


class Doctor(unittest.TestCase):
    def test_without_a_route_a_mission_cannot_fly(self):
        run = doctor("--without-route")
        self.assertEqual(run.returncode, 1, run.stdout)
        self.assertTrue(line_of(run, "multicast route").startswith("wrong"))
        self.assertIn("mend with: ip link set lo multicast on; ip route add 239.255.76.67/32 dev lo", run.stdout)

    def test_its_own_remedy_mends_the_route(self):
        ill = doctor("--without-route")
        remedy = next(line.split("mend with: ")[1] for line in ill.stdout.splitlines() if "ip route" in line)
        well = doctor("--without-route", command=("bash", "-c", f"{remedy}; {SAKER} doctor"))
        self.assertTrue(line_of(well, "multicast route").startswith("ok"), well.stdout)

    def test_a_port_that_is_taken_grounds(self):
        taken = ("import socket,subprocess,sys; s=socket.socket(type=socket.SOCK_DGRAM); s.bind(('',7502)); "
                 f"sys.exit(subprocess.call(['{SAKER}','doctor']))")
        run = doctor(command=("/usr/bin/python3", "-c", taken))
        self.assertEqual(run.returncode, 1, run.stdout)
        self.assertTrue(line_of(run, "UDP port 7502").startswith("wrong"))
        self.assertTrue(line_of(run, "UDP port 7503").startswith("ok"))

    def test_the_teams_key_on_a_robot_is_worse_than_its_own(self):
        with tempfile.TemporaryDirectory(prefix="saker_doctor_") as folder:
            team, own = f"{folder}/team.key", f"{folder}/R1.key"
            subprocess.run([SAKER, "base", "key", "-o", team], check=True)
            subprocess.run([SAKER, "base", "key", "--robot", "R1", "-o", own, "--set", f"exchange.key_file={team}"],
                           check=True)
            for key, word in ((team, "worse"), (own, "ok")):
                run = doctor(command=(SAKER, "doctor", "--set", f"exchange.key_file={key}"))
                self.assertTrue(line_of(run, "key").startswith(word), run.stdout)

    def test_a_robots_key_under_its_old_name_is_renamed_by_the_remedy(self):
        with tempfile.TemporaryDirectory(prefix="saker_doctor_") as folder:
            team, own = f"{folder}/the_teams.key", f"{folder}/team.key"
            subprocess.run([SAKER, "base", "key", "-o", team], check=True)
            subprocess.run([SAKER, "base", "key", "--robot", "R1", "-o", own, "--set", f"exchange.key_file={team}"],
                           check=True)
            words = (SAKER, "doctor", "--set", f"exchange.key_file={folder}/robot.key")
            ill = doctor(command=words)
            self.assertTrue(line_of(ill, "key").startswith("worse"), ill.stdout)
            remedy = next(line.split("mend with: ")[1] for line in ill.stdout.splitlines() if "mend with: mv " in line)
            subprocess.run(remedy.split(), check=True)
            self.assertTrue(line_of(doctor(command=words), "key").startswith("ok"))

    def test_every_subject_is_looked_at(self):
        run = doctor()
        for subject in ("multicast route", "multicast route of bulk", "receive buffer", "monotonic clock",
                        "system clock", "locked memory", "real-time priority", "UDP port 7502", "UDP port 7503", "key", "autopilot"):
            self.assertRegex(line_of(run, subject), "^(ok|worse|wrong) ")

    def test_the_status_is_one_exactly_when_something_is_wrong(self):
        for options in ((), ("--without-route",)):
            run = doctor(*options)
            self.assertEqual(run.returncode, int("\nwrong " in "\n" + run.stdout))


if __name__ == "__main__":
    unittest.main()
