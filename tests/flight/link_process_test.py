"""The sealed link between a robot's machine and the ground's by real processes, and three attackers on the radio between."""

import os
import random
import shutil
import subprocess
import time
import unittest
import unittest.mock

import radio_world
from base_processes import BIN
from radio_world import ATTACKER, GROUND, PORT, ROBOT, RadioTest

SECRET = "5ec2e7c0ffee5ec2e7"  # what a robot says
# What no robot may hear of the ground, and what it may.
MOVING = ("_SETPOINT", "_COMMAND", "_VERDICT", "_STATE", "_ODOMETRY", "_TRAJECTORY")
ALL = (*MOVING, "_ORDER", "_EXCHANGE", "_MISSION")


class Link(RadioTest):
    def test_telemetry_goes_up_as_it_is_and_no_faster_than_its_rate(self):
        self.connect()
        listener = self.listen(None, 4, "_STATE", "_MISSION", "_PRESENCE", "_SCAN")
        self.say(self.robot, "R1_MISSION", "00ff7f80")
        self.say(self.robot, "R1_PRESENCE", "aa")
        self.say(self.robot, "R2_STATE", "cc")
        begin = time.monotonic()
        self.say(self.robot, "R1_STATE", "bb", count=100, rate_hz=50)
        seconds = time.monotonic() - begin
        heard = self.heard(listener)
        self.assertIn(("R1_MISSION", "00ff7f8000000000"), heard)
        self.assertEqual([channel for channel, _ in heard if channel in ("R1_PRESENCE", "R2_STATE")], [])
        states = [int.from_bytes(bytes.fromhex(data)[1:], "little") for channel, data in heard if channel == "R1_STATE"]
        self.assertTrue(4 <= len(states) <= 2 * seconds + 2, states)  # 2 Hz, the first at once, the newest at the end
        self.assertEqual((states, states[-1]), (sorted(states), 99))

    def test_an_order_goes_down_and_nothing_else(self):
        self.connect()
        listener = self.listen(self.robot, 3, *ALL)
        self.say(None, "R1_ORDER", "0bde")
        for suffix in MOVING:
            self.say(None, f"R1{suffix}", "bad0")
        self.assertEqual(self.heard(listener), [("R1_ORDER", "0bde00000000")])

    # Hazard: Orders and the radio | the base's disk stalls | orders and telemetry pass as before | –
    def test_a_disk_that_stalls_at_the_base_holds_up_no_order(self):
        stall = self.folder / "stall"
        with unittest.mock.patch.dict(os.environ, LD_PRELOAD=os.environ["STALLED_CALLS"], SAKER_STALL=str(stall)):
            self.start_ground()
        self.start_link()
        self.wait(lambda: "R1 is there" in self.log("base"), 20, "link")
        stall.write_text("sync saker-base")
        self.start("R1", *self.robot.inside, BIN / "exchange_robot", "R1", self.robot_key, self.folder / "R1", 30_000, 0)
        time.sleep(5)  # longer than link.lost_s
        self.assertEqual(self.stored_bytes("R1"), 0, "its disk stalls")
        listener = self.listen(self.robot, 3, "_ORDER")
        self.say(None, "R1_ORDER", "0bde")
        self.assertEqual(self.heard(listener), [("R1_ORDER", "0bde00000000")])
        self.assertNotIn("is gone", self.log("base") + self.log("link"))

    def test_a_robot_exchanges_over_the_link(self):
        self.connect()
        robot = self.start("R1", *self.robot.inside, BIN / "exchange_robot", "R1", self.robot_key, self.folder / "R1",
                           30_000, 0.3)
        self.wait(lambda: self.stored_bytes("R1") == 30_000, 60, "history of R1")
        self.stop(robot)

    # Hazard: Orders and the radio | the link is gone | nothing queues; it comes back with the newest | –
    def test_a_link_that_is_gone_comes_back_with_the_newest(self):
        base, _ = self.connect()
        self.assertEqual(self.stop(base), 0)
        self.wait(lambda: "the ground is gone" in self.log("link"), 10, "loss")
        for value in range(5):
            self.say(self.robot, "R1_STATE", f"0{value}")
            self.say(None, "R1_ORDER", "0bde")
        ear = self.listen(None, 8, "_STATE")
        orders = self.listen(self.robot, 7, "_ORDER")
        self.start_ground()
        self.assertEqual(self.heard(orders), [])
        self.assertEqual(self.heard(ear), [("R1_STATE", "0400000000")])

    # Hazard: Orders and the radio | a disk was replaced: the epoch is lost | heard again where its clock is right, else by a renewed key | –
    def test_a_robot_whose_disk_was_replaced_is_brought_back_by_a_renewed_key(self):
        base, link = self.connect()
        self.stop(link)
        old_key = self.folder / "old.key"
        shutil.copy2(self.robot_key, old_key)
        self.make_robot_key("--renew", "--force")
        self.stop(base)
        (self.folder / "base.log").write_text("")
        self.start_ground()
        old = self.start_link("old", old_key)
        time.sleep(2)
        self.assertNotIn("R1 is there", self.log("base"))
        self.stop(old)
        robot = self.start("R1", *self.robot.inside, BIN / "exchange_robot", "R1", self.robot_key, self.folder / "R1",
                           3_000, 0)
        self.start_link("renewed")
        self.wait(lambda: "R1 is there" in self.log("base"), 10, "renewed robot")
        self.wait(lambda: self.stored_bytes("R1") == 3_000, 30, "history of R1")
        self.stop(robot)

    def test_a_robot_that_holds_the_teams_key_says_so(self):
        self.start_ground()
        self.start_link(key=self.key)
        self.wait(lambda: "joins R1" in self.log("link"), 20, "link")
        self.assertIn(f"{self.key} is the team's key", self.log("link"))

    def test_a_robot_whose_key_has_its_old_name_is_heard_and_says_so(self):
        self.start_ground()
        installed = self.folder / "installed"
        installed.mkdir()
        shutil.copy2(self.robot_key, installed / "team.key")
        self.start_link(key=installed / "robot.key")
        self.wait(lambda: "R1 is there" in self.log("base"), 20, "link")
        self.assertIn(f"its old name {installed}/team.key is read", self.log("link"))

    def test_what_keeps_it_from_starting_is_one_line(self):
        def refusal(*settings, status=2):
            words = [word for setting in settings for word in ("--set", setting)]
            run = subprocess.run([*self.robot.inside, BIN / "saker-link", *words], capture_output=True, text=True,
                                 timeout=30)
            self.assertEqual(run.returncode, status, run.stderr)
            self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
            return run.stderr
        ground, key = f"link.ground={GROUND}:{PORT}", f"exchange.key_file={self.robot_key}"
        self.assertIn("tells the ground nothing", refusal(key, status=0))
        self.assertIn("expected ADDRESS:PORT", refusal("link.ground=base", key))
        for own in (ROBOT, "127.0.0.1"):
            self.assertIn("is this machine", refusal(f"link.ground={own}:{PORT}", key))
        self.assertIn("none.key", refusal(ground, "exchange.key_file=none.key"))
        self.assertIn("expected ttl=0", refusal(ground, key, "bus.control_url=udpm://239.255.76.67:7667?ttl=1"))
        run = subprocess.run([*self.robot.inside, BIN / "saker-link", "--robot", "R2", "--set", ground, "--set", key],
                             capture_output=True, text=True, timeout=30)
        self.assertIn("the key is that of R1", run.stderr)


@unittest.skipUnless(shutil.which("tcpdump"), "tcpdump is not installed")
class Attackers(RadioTest):
    def setUp(self):
        super().setUp()
        self.base, self.link = self.connect()

    def talk(self):
        """What passes on a mission, for some seconds."""
        robot = self.start("R1", *self.robot.inside, BIN / "exchange_robot", "R1", self.robot_key, self.folder / "R1",
                           20_000, 0)
        for _ in range(3):
            for suffix in ("_STATE", "_ODOMETRY", "_MISSION", "_TRAJECTORY", "_SETPOINT"):
                self.say(self.robot, f"R1{suffix}", SECRET * 4)
            self.say(None, "R1_ORDER", SECRET)
            time.sleep(0.5)
        self.wait(lambda: self.stored_bytes("R1") == 20_000, 30, "history of R1")
        self.stop(robot)
        self.wait(lambda: "R1 is out of contact" in self.log("base"), 30, "end of the exchange")

    def nothing_gets_in(self, attack):
        """Listens on both machines while it lasts; the link works after it."""
        seconds = 12
        robot, ground = self.listen(self.robot, seconds, *ALL), self.listen(None, seconds, *ALL)
        begin = time.monotonic()
        attack()
        took = time.monotonic() - begin
        self.assertLess(took, seconds - 4, "the listeners hear all of it")
        self.say(self.robot, "R1_MISSION", "a11ce0")
        self.say(None, "R1_ORDER", "a11ce1")
        self.assertEqual(set(self.heard(robot)), {("R1_MISSION", "a11ce000000000"), ("R1_ORDER", "a11ce100000000")})
        self.assertEqual(set(self.heard(ground)), {("R1_MISSION", "a11ce000000000"), ("R1_ORDER", "a11ce100000000")})
        for process in (self.base, self.link):
            self.assertIsNone(process.poll())

    # Hazard: Orders and the radio | somebody reads along | reads nothing | –
    def test_one_who_reads_along_reads_nothing(self):
        dump = self.capture()
        self.talk()
        datagrams, file = self.stop_capture(dump)
        self.assertGreater(len(datagrams), 40)
        self.assertEqual({port for source, _, port, _ in datagrams if source == ROBOT}, {PORT})
        self.assertEqual({(source, to) for source, to, _, _ in datagrams}, {(ROBOT, GROUND), (GROUND, ROBOT)})
        words = [b"R1" + suffix.encode() for suffix in ALL] + [b"LC02", b"LC03", b"history", bytes.fromhex(SECRET)]
        words += [self.held_by("R1")["R1_history_1"][at:at + 8] for at in range(0, 20_000, 1000)]
        self.assertEqual([word for word in words if word in file], [])

    # Hazard: Orders and the radio | somebody replays | nothing gets in | –
    def test_one_who_replays_gets_nothing_in(self):
        dump = self.capture()
        self.talk()
        recorded, _ = self.stop_capture(dump)
        self.nothing_gets_in(lambda: self.inject(self.replays(recorded)))
        with self.subTest("after both ends were restarted, the ground's without what it had on disk"):
            self.stop(self.base), self.stop(self.link)
            shutil.rmtree(self.folder / "base")
            for name in ("base", "link"):
                (self.folder / f"{name}.log").write_text("")
            self.base = self.start_ground()
            self.inject(self.replays(recorded))
            self.assertNotIn("R1 is there", self.log("base"))
            self.link = self.start_link()
            self.wait(lambda: "R1 is there" in self.log("base"), 20, "link")
            self.nothing_gets_in(lambda: self.inject(self.replays(recorded)))

    def ports(self):
        """Of the robot's machine on which anything listens, but for LCM's."""
        table = subprocess.run([*self.robot.inside, "cat", "/proc/net/udp"], check=True, capture_output=True, text=True)
        ports = {int(line.split()[1].split(":")[1], 16) for line in table.stdout.splitlines()[1:]}
        return sorted(ports - {0, 7667, 7668})

    def replays(self, recorded):
        """From the attacker's own address, and from that of whoever said it."""
        for source, to, port, payload in recorded[:400]:
            for goal in [PORT] if to == GROUND else self.ports():
                yield "udp", to, goal, payload
                yield "raw", to, 0, radio_world.ipv4(source, to, payload, goal)

    # Hazard: Orders and the radio | somebody forges | nothing gets in | –
    def test_one_who_forges_gets_nothing_in(self):
        dump = self.capture()
        self.talk()
        recorded, _ = self.stop_capture(dump)
        draw = random.Random(1)
        other = self.folder / "other.key"
        self.make_key(other)
        foreign = subprocess.run([radio_world.PROBE, "seal", other, "R1", "R1_LINK", SECRET * 8], check=True,
                                 capture_output=True, text=True).stdout.strip()
        payloads = [draw.randbytes(draw.randrange(1400)) for _ in range(100)] + [bytes.fromhex(foreign)]
        for _, _, _, payload in recorded[:200]:
            at = draw.randrange(len(payload))
            payloads.append(payload[:at] + bytes([payload[at] ^ 1 << draw.randrange(8)]) + payload[at + 1:])
        lines = [("udp", GROUND, PORT, payload) for payload in payloads]
        lines += [("raw", ROBOT, 0, radio_world.ipv4(GROUND, ROBOT, payload, port)) for payload in payloads
                  for port in self.ports()]
        self.nothing_gets_in(lambda: self.inject(lines))

    # Hazard: Orders and the radio | somebody speaks LCM to the radio | nothing gets in | –
    def test_one_who_speaks_lcm_to_the_radio_gets_nothing_in(self):
        messages = [radio_world.lcm_datagram(f"R1{suffix}", bytes.fromhex(SECRET)) for suffix in ALL]
        lines = [("udp", to, port, message) for message in messages for port in (7667, 7668)
                 for to in (ROBOT, GROUND, "239.255.76.67", "10.76.1.255")]
        pretended = [("raw", ROBOT, 0, radio_world.ipv4(source, ROBOT, message, 7667))
                     for message in messages for source in (GROUND, "127.0.0.1", ROBOT)]
        self.nothing_gets_in(lambda: self.inject((lines + pretended) * 3))
        with self.subTest("a listener whose bus may leave the machine would hear it"):
            open_ear = self.listen(self.robot, 3, *ALL, url="udpm://239.255.76.67:7667?ttl=1")
            self.inject(lines)
            self.assertIn(("R1_SETPOINT", SECRET), self.heard(open_ear))

    # Hazard: Orders and the radio | the flight bus on the radio | nothing of it is there | –
    def test_nothing_of_the_flight_bus_is_on_the_radio(self):
        dump = self.capture()
        self.say(self.robot, "R1_SETPOINT", SECRET, count=50)
        self.say(None, "R1_STATE", SECRET, count=50)
        datagrams, _ = self.stop_capture(dump)
        self.assertEqual([(source, to, port) for source, to, port, _ in datagrams if port in (7667, 7668)
                          or to.startswith("239.") or ATTACKER in (source, to)], [])


if __name__ == "__main__":
    unittest.main()
