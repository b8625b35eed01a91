"""The relay between two LCM networks that only the base station is on: robots | base | ground, joined by veth."""

import pathlib
import subprocess
import time
import unittest

from base_processes import BIN, NamespaceTest

ROBOTS, GROUND = "udpm://239.255.76.67:7667?ttl=1", "udpm://239.255.76.68:7669?ttl=1"
PROBE = BIN / "lcm_probe"


def ip(*words, inside=()):
    subprocess.run([*inside, "ip", *map(str, words)], check=True, capture_output=True)


class Side:
    """A network namespace with one cable to this one, which is the base's."""

    def __init__(self, test, name, subnet, group):
        self.holder = subprocess.Popen(["unshare", "--net", "sleep", "300"])
        test.addCleanup(test.end, self.holder)
        here = pathlib.Path("/proc/self/ns/net").readlink()
        test.wait(lambda: pathlib.Path(f"/proc/{self.holder.pid}/ns/net").readlink() != here, 5, "namespace")
        ip("link", "add", name, "type", "veth", "peer", "name", "cable", "netns", self.holder.pid)
        test.addCleanup(subprocess.run, ["ip", "link", "delete", name], capture_output=True)
        for words, inside in (((f"{subnet}.1/24", "dev", name), ()), ((f"{subnet}.2/24", "dev", "cable"), self.inside)):
            ip("address", "add", *words, inside=inside)
            ip("link", "set", words[-1], "up", inside=inside)
            ip("route", "replace", f"{group}/32", "dev", words[-1], inside=inside)
        ip("link", "set", "lo", "up", inside=self.inside)

    @property
    def inside(self):
        return ["nsenter", "-t", str(self.holder.pid), "--net"]


class Relay(NamespaceTest):
    def setUp(self):
        super().setUp()
        self.robots = Side(self, "robots", "10.76.1", "239.255.76.67")
        self.ground = Side(self, "ground", "10.76.2", "239.255.76.68")
        self.addCleanup(ip, "route", "replace", "239.255.76.67/32", "dev", "lo")
        self.base = self.start_base(f"bus.control_url={ROBOTS}", f"base.relay.ground_url={GROUND}")
        self.wait(lambda: "listens as BASE" in self.log("base"), 20, "base")

    def listen(self, side, url, seconds, *suffixes):
        listener = subprocess.Popen([*side.inside, PROBE, "hear", url, str(seconds), *suffixes],
                                    stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.end, listener)
        self.addCleanup(listener.stdout.close)
        time.sleep(0.5)
        return listener

    def heard(self, listener):
        return [tuple(line.split()) for line in listener.communicate(timeout=30)[0].splitlines()]

    def say(self, side, url, channel, hex_bytes, count=1, rate_hz=100):
        subprocess.run([*side.inside, PROBE, "say", url, channel, hex_bytes, str(count), str(rate_hz)], check=True)

    def order(self, key, channel, hex_bytes, age_s=0, folder="ground"):
        (self.folder / folder).mkdir(exist_ok=True)
        return subprocess.run([*self.ground.inside, PROBE, "order", GROUND, key, self.folder / folder, channel,
                               hex_bytes, str(age_s)], check=True, capture_output=True, text=True).stdout.strip()

    def counters(self, side, url):
        """Of the base's HEALTH, heard on one side."""
        lines = self.heard(self.listen(side, url, 2, "_HEALTH"))
        return {channel for channel, _ in lines}

    def test_telemetry_goes_up_as_it_is_and_no_faster_than_its_rate(self):
        listener = self.listen(self.ground, GROUND, 4, "_STATE", "_MISSION", "_SETPOINT")
        self.say(self.robots, ROBOTS, "R1_MISSION", "00ff7f80")
        self.say(self.robots, ROBOTS, "R1_SETPOINT", "aa")
        begin = time.monotonic()
        self.say(self.robots, ROBOTS, "R2_STATE", "bb", count=100, rate_hz=50)
        seconds = time.monotonic() - begin
        heard = self.heard(listener)
        self.assertIn(("R1_MISSION", "00ff7f8000000000"), heard)
        self.assertEqual([line for line in heard if line[0] == "R1_SETPOINT"], [])
        states = [int.from_bytes(bytes.fromhex(data)[1:], "little") for channel, data in heard if channel == "R2_STATE"]
        self.assertTrue(4 <= len(states) <= 2 * seconds + 2, states)  # 2 Hz, the first at once, the newest at the end
        self.assertEqual((states, states[-1]), (sorted(states), 99))

    def test_only_what_the_key_sealed_a_moment_ago_comes_down_and_once(self):
        listener = self.listen(self.robots, ROBOTS, 6, "_COMMAND", "_STATE")
        other_key = self.folder / "other.key"
        self.make_key(other_key)
        sealed = self.order(self.key, "R1_COMMAND", "c0ffee")
        time.sleep(0.3)
        self.say(self.ground, GROUND, "R1_COMMAND", "c0ffee", count=3, rate_hz=5)     # without a seal
        self.say(self.ground, GROUND, "R2_COMMAND", sealed[:-8], count=1)             # cut
        self.order(other_key, "R1_COMMAND", "bad1", folder="stranger")                # another key
        self.order(self.key, "R1_COMMAND", "bad2", age_s=60)                          # held back
        self.order(self.key, "R1_STATE", "bad3")                                      # telemetry does not come down
        self.assertEqual(self.heard(listener), [("R1_COMMAND", "c0ffee")])

    def test_health_of_the_base_is_heard_on_both_sides(self):
        for side, url in ((self.robots, ROBOTS), (self.ground, GROUND)):
            self.assertEqual(self.counters(side, url), {"BASE_HEALTH"})

    def test_a_second_base_is_refused_on_either_side(self):
        for side, url in ((self.robots, ROBOTS), (self.ground, GROUND)):
            command = [*side.inside, *self.base_command(f"bus.control_url={url}", folder=self.folder / "second")]
            run = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=30)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertRegex(run.stderr, "^saker-base: a second saker-base of robot BASE is on the network [^\n]*\n$")

    def test_robots_exchange_over_the_cable_and_the_ground_hears_nothing_of_it(self):
        listener = self.listen(self.ground, GROUND, 8, "_EXCHANGE", "_PRESENCE")
        robot = self.start("R1", *self.robots.inside, BIN / "exchange_robot", "R1", self.key, self.folder / "R1", 30_000,
                           0.3, ROBOTS)
        self.wait(lambda: self.stored_bytes("R1") == 30_000, 30, "history of R1")
        self.stop(robot)
        self.assertEqual({channel for channel, _ in self.heard(listener)}, {"BASE_PRESENCE"})


if __name__ == "__main__":
    unittest.main()
