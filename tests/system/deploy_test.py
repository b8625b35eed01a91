"""Installed from the packages into a clean Debian that systemd boots: start, kill, restart, stop, a mission flown."""

import os
import pathlib
import re
import signal
import subprocess
import unittest

import container

CHECKER, FLIGHT, BASE, GROUND, BRIDGE = "saker-collision-checker", "saker-flight", "saker-base", "saker-ground", "saker-mavlink"
UNITS = sorted(file.name for file in (container.ROOT / "configs/deploy").glob("saker*") if file.suffix in (".service", ".target"))
SCENARIO = "/usr/share/saker/scenarios/small.yaml"
# Killed while it is being stopped it is not restarted.
END = f"systemctl stop --no-block {FLIGHT}; systemctl kill -s KILL {FLIGHT}; systemctl stop {FLIGHT}"
DROP_IN = "[Service]\nCapabilityBoundingSet=CAP_SYS_NICE\nAmbientCapabilities=CAP_SYS_NICE\n"


def setUpModule():
    container.require_machine()
    global debs
    container.base()
    debs = container.packages()


class Units(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        root = container.installed("booted", debs)
        if not container.may_raise_limits():  # else LimitRTPRIO= of the units does the same
            print("this machine may raise no limits: a capability stands in for LimitRTPRIO=")
            for unit in (CHECKER, FLIGHT, BRIDGE):
                folder = root / f"etc/systemd/system/{unit}.service.d"
                folder.mkdir(parents=True)
                (folder / "limits.conf").write_text(DROP_IN)
        cls.box = container.Container(root)
        cls.addClassCleanup(cls.box.end)
        cls.box.run("saker", "base", "key", "-o", "/etc/saker/team.key")
        cls.box.run("chown", "saker:", "/etc/saker/team.key")
        cls.flown = 0

    def setUp(self):
        self.run = self.box.run
        self.run("systemctl", "reset-failed")
        self.run("systemctl", "start", "saker.target")
        self.addCleanup(self.run, "sh", "-c", END, check=False)

    def show(self, unit, name):
        return self.run("systemctl", "show", "-p", name, "--value", unit).stdout.strip()

    def wait_for(self, unit, name, value, seconds):
        self.box.wait(lambda: self.show(unit, name) == value, seconds, f"{name}={value} of {unit}")

    def said(self, unit):
        return self.run("journalctl", "--no-pager", "-o", "cat", "-u", unit).stdout

    def kill(self, unit):
        self.run("systemctl", "kill", "-s", "KILL", "--kill-whom=main", unit)

    def restarts(self, unit, before, seconds=10):
        """By systemd itself, to another process."""
        def restarted():
            pid = self.show(unit, "MainPID")
            return pid not in ("0", before) and self.show(unit, "ActiveState") == "active"
        self.box.wait(restarted, seconds, f"restart of {unit}")

    def simulate(self):
        """An aircraft on the ground, and what its operator writes into the configuration. It obeys in the place of an autopilot."""
        type(self).flown += 1
        self.run("systemctl", "stop", BRIDGE)
        site = pathlib.Path(f"/var/tmp/site{self.flown}")
        log = open(container.FOLDER / f"simulator{self.flown}.log", "w")
        sim = subprocess.Popen(self.box.inside("saker-sim", SCENARIO, "-o", site, "--seed", "1"),
                               stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        log.close()
        self.addCleanup(sim.wait)
        self.addCleanup(self.run, "pkill", "-KILL", "-x", "saker-sim", check=False)
        inside = pathlib.Path(f"{self.box.root}{site}")
        self.box.wait((inside / "metadata.json").exists, 60, "site")
        names = {"metadata.json": "sensor.json", "prior.json": "prior.json", "site.yaml": "saker.yaml"}
        for source, name in names.items():
            self.run("install", "-m", "644", site / source, f"/etc/saker/{name}")
        options = "--prior /etc/saker/prior.json"
        self.run("sed", "-i", f's|^FLIGHT_OPTIONS=.*|FLIGHT_OPTIONS="{options}"|', "/etc/default/saker")
        return site

    def take_off(self):
        site = self.simulate()
        self.run("systemctl", "start", FLIGHT)
        self.box.wait(lambda: self.show(FLIGHT, "StatusText").startswith("tour"), 60, "tour")
        return site

    def test_the_units_are_valid(self):
        folder = pathlib.Path("/lib/systemd/system")
        self.assertEqual(sorted(p.name for p in pathlib.Path(f"{self.box.root}{folder}").glob("saker*")), UNITS)
        self.assertEqual(self.run("systemd-analyze", "verify", *(folder / unit for unit in UNITS)).stdout, "")
        self.assertEqual(self.show(FLIGHT, "LimitRTPRIO"), "75")
        self.assertEqual(self.show(FLIGHT, "LimitMEMLOCK"), "infinity")

    def test_what_flies_has_real_time_priority_and_is_not_root(self):
        pid = self.show(CHECKER, "MainPID")
        self.assertEqual(self.run("chrt", "-p", pid).stdout.split(": ")[1].splitlines()[0], "SCHED_FIFO")
        self.assertEqual(self.run("stat", "-c", "%U", f"/proc/{pid}").stdout.strip(), "saker")

    def test_a_killed_checker_is_restarted(self):
        before = self.show(CHECKER, "MainPID")
        self.kill(CHECKER)
        self.restarts(CHECKER, before)

    def test_a_hanging_checker_is_restarted_by_the_watchdog(self):
        before = self.show(CHECKER, "MainPID")
        os.kill(self.box.host_pid(before), signal.SIGSTOP)
        self.restarts(CHECKER, before)
        self.assertIn("Watchdog timeout", self.said(CHECKER))

    def test_a_killed_base_is_restarted_with_its_store(self):
        self.box.wait(lambda: self.show(BASE, "ActiveState") == "active", 10, "base")
        before = self.show(BASE, "MainPID")
        self.kill(BASE)
        self.restarts(BASE, before)
        self.run("saker", "base", "status", "--store", "/var/lib/saker/base/base.db")
        self.run("systemctl", "stop", BASE)
        self.assertEqual(self.show(BASE, "Result"), "success")

    def fetched(self, address):
        """What the installed server answers, asked from this machine inside the container's network."""
        ask = "import sys, urllib.request; sys.stdout.buffer.write(urllib.request.urlopen(sys.argv[1], timeout=10).read())"
        return container.command("nsenter", "-t", self.box.init, "-n", "/usr/bin/python3", "-c", ask, address).stdout

    def test_the_page_is_served_with_every_file_that_it_names(self):
        self.wait_for(GROUND, "ActiveState", "active", 20)
        self.assertEqual(self.run("stat", "-c", "%U", f"/proc/{self.show(GROUND, 'MainPID')}").stdout.strip(), "saker")
        address = re.findall(r"http://127\.0\.0\.1:\d+/", self.said(GROUND))[-1]
        left, seen = {"index.html"}, set()
        while left:
            seen.add(name := left.pop())
            text = self.fetched(address + name)
            if name.startswith("vendor/"):
                continue
            named = re.findall(r'(?:src|href)="([\w./-]+\.(?:js|css|svg))"', text) + re.findall(r'from "(\./[\w./-]+\.js)"', text)
            left |= {os.path.normpath(file) for file in named} - seen
        self.assertLess({"main.js", "view.js", "style.css"}, seen)
        self.assertGreater(len(self.fetched(address + "vendor/three.module.js")), 100_000)

    def test_the_bridge_to_an_autopilot_waits_for_it(self):
        own = pathlib.Path(f"{self.box.root}/etc/saker/saker.yaml")
        before = own.read_text()
        self.addCleanup(own.write_text, before)
        own.write_text(before + "mavlink: {autopilot: px4, line: 'udp:listen:14550'}\n")
        self.run("systemctl", "restart", BRIDGE)
        self.box.wait(lambda: "hears no autopilot on udp:listen:14550" in self.said(BRIDGE), 10, "line of the bridge")
        self.assertEqual(self.show(BRIDGE, "ActiveState"), "active")
        pid = self.show(BRIDGE, "MainPID")
        self.assertEqual(self.run("chrt", "-p", pid).stdout.split(": ")[1].splitlines()[0], "SCHED_FIFO")

    def test_the_checker_ends_when_it_is_stopped(self):
        self.run("systemctl", "stop", CHECKER)
        self.assertEqual(self.show(CHECKER, "Result"), "success")
        self.assertIn("ends as asked", self.said(CHECKER))

    def test_who_dies_again_and_again_stays_down(self):
        for _ in range(6):
            self.box.wait(lambda: self.show(CHECKER, "SubState") in ("running", "failed"), 10, "checker")
            self.kill(CHECKER) if self.show(CHECKER, "SubState") == "running" else None
        self.wait_for(CHECKER, "SubState", "failed", 10)
        self.assertIn("Start request repeated too quickly", self.said(CHECKER))

    def test_a_mission_is_flown(self):
        site = self.take_off()
        self.wait_for(FLIGHT, "ActiveState", "inactive", 240)
        self.assertEqual(self.show(FLIGHT, "Result"), "success", self.said(FLIGHT)[-3000:])
        self.assertIn("the base has this flight", self.said(FLIGHT))
        flight = self.run("sh", "-c", "ls -d /var/lib/saker/flights/* | tail -n 1").stdout.strip()
        self.box.wait(pathlib.Path(f"{self.box.root}{site}/truth.json").exists, 20, "truth of the simulator")
        report = self.run("saker", "flight-report", flight, site, "-o", f"{site}/report", check=False)
        print(report.stdout)
        self.assertEqual(report.returncode, 0, report.stdout)

    def test_a_robot_that_is_stopped_in_flight_lands(self):
        site = self.take_off()
        self.run("systemctl", "stop", FLIGHT)
        self.assertIn("landed; 0 collisions", self.landed())
        self.assertIn("done: landed", self.said(FLIGHT))

    def landed(self):
        log = container.FOLDER / f"simulator{self.flown}.log"
        self.box.wait(lambda: "landed; " in log.read_text(), 40, "landing")
        return log.read_text()

    def test_without_the_teams_key_it_tells_nobody_and_says_so(self):
        self.simulate()
        self.run("mv", "/etc/saker/team.key", "/var/tmp/")
        self.addCleanup(self.run, "mv", "/var/tmp/team.key", "/etc/saker/")
        self.run("systemctl", "start", FLIGHT)
        self.assertIn("no key of a team at /etc/saker/robot.key: this flight tells nobody", self.said(FLIGHT))

    def test_an_order_goes_out_as_the_page_says(self):
        words = ["runuser", "-u", "saker", "--", "saker", "order", "R1", "hold"]
        self.assertIn(f"\n{' '.join(words)} ", (container.ROOT / "docs/deploy.md").read_text())
        ran = self.run(*words, check=False)
        self.assertEqual((ran.returncode, ran.stdout), (1, "R1 hold no answer: nothing is heard of it\n"), ran.stderr)

    def test_killed_on_the_ground_it_is_restarted(self):
        self.simulate()
        self.run("pkill", "-KILL", "-x", "saker-sim")  # no packet comes
        self.run("systemctl", "start", FLIGHT)
        before = self.show(FLIGHT, "MainPID")
        self.kill(FLIGHT)
        self.restarts(FLIGHT, before)

    def test_hanging_in_flight_it_is_killed_and_does_not_take_off_again(self):
        self.take_off()
        self.box.hang_thread(self.show(FLIGHT, "MainPID"), "safety")
        self.wait_for(FLIGHT, "ActiveState", "failed", 20)
        said = self.said(FLIGHT)
        for words in ("safety hangs", "Watchdog timeout", "restarted in the middle of a flight"):
            self.assertIn(words, said)
        self.assertEqual(self.show(FLIGHT, "NRestarts"), "1")
        self.assertIn("landed; 0 collisions", self.landed())
        self.simulate()
        self.run("systemctl", "start", FLIGHT)  # by its operator it may


class Packages(unittest.TestCase):
    """Without systemd running: what dpkg does."""

    @classmethod
    def setUpClass(cls):
        cls.root = container.installed("unbooted", debs)

    def test_configuration_survives_an_upgrade_and_a_purge_leaves_nothing(self):
        own = self.root / "etc/saker/saker.yaml"
        own.write_text("mission: {height_m: 4}\n")
        container.apt(self.root, "install", "--reinstall", *(f"/packages/{deb.name}" for deb in debs))
        self.assertEqual(own.read_text(), "mission: {height_m: 4}\n")
        (self.root / "var/lib/saker").mkdir(exist_ok=True)
        container.apt(self.root, "purge", "saker-common")
        find = ("dpkg -l 'saker-*' 2>/dev/null | grep ^ii; "
                "find / -xdev -path /packages -prune -o -path /proc -prune -o -name '*saker*' -print")
        left = container.command("chroot", self.root, "sh", "-c", find, check=False).stdout
        self.assertEqual(left, "")


if __name__ == "__main__":
    unittest.main()
