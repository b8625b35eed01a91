"""saker-base loses nothing: killed at any moment, on a lossy network, on a full disk."""

import pathlib
import re
import subprocess
import time
import unittest

from base_processes import BIN, NamespaceTest

HISTORY = 200_000       # bytes: ten minutes of flight
LONG_HISTORY = 400_000  # four seconds of transfer, to be killed in


class Exchange(NamespaceTest):
    def test_killed_five_times_in_a_transfer_with_loss_it_holds_the_same_bytes(self):
        base = self.start_base()
        robot = self.start_robot("R1", LONG_HISTORY, loss=0.3)
        for kill in range(1, 6):
            self.wait(lambda: self.stored_bytes("R1") > LONG_HISTORY * kill / 10, 60, f"bytes before kill {kill}")
            base.kill()
            base.wait()
            self.assertLess(self.stored_bytes("R1"), LONG_HISTORY, "killed after the transfer, not in it")
            base = self.start_base()
        self.wait(lambda: self.stored_bytes("R1") == LONG_HISTORY, 60, "whole history")
        self.assertEqual(self.stop(robot), 0)
        self.assertEqual(self.stop(base), 0)
        self.assertEqual(self.stored()["R1", 1], self.held_by("R1")["R1_history_1"])

    def test_at_30_percent_loss_both_ends_send_at_most_1_8_times_the_history(self):
        base = self.start_base()
        robot = self.start_robot("R1", HISTORY, loss=0.3)
        self.wait(lambda: self.stored_bytes("R1") == HISTORY, 60, "whole history")
        time.sleep(1)
        self.stop(robot)
        self.stop(base)
        by_base = int(re.search(r"sent (\d+) bytes", self.log("base")).group(1))
        by_robot = int((self.folder / "R1" / "sent").read_text())
        print(f"{by_robot} + {by_base} bytes sent for {HISTORY}: {(by_robot + by_base) / HISTORY:.2f}")
        self.assertLessEqual(by_robot + by_base, 1.8 * HISTORY)

    def test_robots_killed_in_a_transfer_hand_over_the_same_bytes(self):
        base = self.start_base()
        for kill in range(1, 6):
            robot = self.start_robot("R1", LONG_HISTORY, loss=0.3)
            self.wait(lambda: self.stored_bytes("R1") > LONG_HISTORY * kill / 10, 60, f"bytes before kill {kill}")
            robot.kill()
            robot.wait()
        robot = self.start_robot("R1", LONG_HISTORY, loss=0.3)
        self.wait(lambda: self.stored_bytes("R1") == LONG_HISTORY, 60, "whole history")
        self.stop(robot)
        self.stop(base)
        self.assertEqual(self.stored()["R1", 1], self.held_by("R1")["R1_history_1"])

    def test_every_robot_gets_the_history_of_every_other_also_of_one_that_is_gone(self):
        self.start_base()
        first = self.start_robot("R1", 30_000)
        self.wait(lambda: self.stored_bytes("R1") == 30_000, 30, "history of R1")
        self.stop(first)
        others = [self.start_robot("R2", 40_000), self.start_robot("R3", 0)]
        self.wait(lambda: self.stored_bytes("R2") == 40_000, 30, "history of R2")
        time.sleep(3)
        for robot in others:
            self.stop(robot)
        self.assertEqual(self.held_by("R2"), self.held_by("R3"))
        self.assertEqual(self.held_by("R3")["R1_history_1"], self.held_by("R1")["R1_history_1"])
        self.assertEqual(len(self.held_by("R3")["R2_history_1"]), 40_000)

    def test_a_robot_with_another_key_gets_nothing_in_or_out(self):
        other_key = self.folder / "other.key"
        self.make_key(other_key)
        base = self.start_base()
        robot = self.start_robot("R1", 30_000)
        self.wait(lambda: self.stored_bytes("R1") == 30_000, 30, "history of R1")
        stranger = self.start_robot("R9", 30_000, key=other_key)
        time.sleep(4)
        for process in (robot, stranger, base):
            self.stop(process)
        self.assertEqual(list(self.stored()), [("R1", 1)])
        self.assertEqual(list(self.held_by("R9")), ["R9_history_1"])


class Status(NamespaceTest):
    def status(self):
        run = subprocess.run([BIN / "saker", "base", "status", "--store", self.folder / "base" / "base.db"],
                             capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout.splitlines()

    def test_lists_what_is_held_while_it_runs_and_after(self):
        base = self.start_base()
        self.start_robot("R1", 30_000)
        self.wait(lambda: self.stored_bytes("R1") == 30_000, 30, "history of R1")
        self.wait(lambda: "UTC" in self.status()[1], 30, "contact")
        running = self.status()
        self.stop(base)
        for lines in (running, self.status()):
            self.assertEqual(lines[1].split()[:5], ["R1", "history", "1", "30000", "0"], lines)
            self.assertRegex(lines[1], r"20\d\d-\d\d-\d\d \d\d:\d\d:\d\d UTC, \d+ s ago$")
            self.assertRegex(lines[2], "^1 robots, 1 streams, 30000 bytes; ")


class FullDisk(NamespaceTest):
    def test_refuses_chunks_in_one_line_keeps_what_is_there_and_goes_on_when_there_is_room(self):
        disk = self.folder / "base"
        disk.mkdir()
        script = 'mount -t tmpfs -o size=2m tmpfs "$0" && head -c 1500000 /dev/zero >"$0/filler" && exec "$@"'
        probe = subprocess.run(["unshare", "--mount", "mount", "-t", "tmpfs", "tmpfs", disk], capture_output=True)
        if probe.returncode != 0:
            self.skipTest("mounts are not allowed here")
        base = self.start("base", "unshare", "--mount", "bash", "-c", script, disk,
                          *self.base_command("exchange.link.refused_again_s=2"))
        robot = self.start_robot("R1", 2 * HISTORY)
        self.wait(lambda: "refuses chunks" in self.log("base"), 60, "refusal")
        time.sleep(5)
        self.assertIsNone(base.poll(), self.log("base"))
        self.assertEqual(self.log("base").count("refuses chunks"), 1, self.log("base"))
        inside = ["nsenter", "-t", str(base.pid), "--mount"]
        subprocess.run([*inside, "rm", disk / "filler"], check=True)
        self.wait(lambda: "takes chunks again" in self.log("base"), 30, "room")
        status = [*inside, BIN / "saker", "base", "status", "--store", disk / "base.db"]
        self.wait(lambda: f" {2 * HISTORY} " in subprocess.run(status, capture_output=True, text=True).stdout, 60,
                  "whole history")
        self.stop(robot)
        self.assertEqual(self.stop(base), 0)


class Start(NamespaceTest):
    def refusal(self, *settings, before=(), after=()):
        command = [*before, *self.base_command(*settings), *after]
        run = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=30)
        self.assertEqual(run.returncode, 2, run.stderr)
        lines = run.stderr.splitlines()
        self.assertEqual(len(lines), 1, run.stderr)
        self.assertTrue(lines[0].startswith("saker-base: "), lines[0])
        return lines[0]

    def test_a_second_base_on_the_network_is_refused_whatever_its_name(self):
        first = self.start_base()
        self.wait(lambda: "listens as BASE" in self.log("base"), 20, "first base")
        for name in ("BASE", "BASE2"):
            run = subprocess.run([str(w) for w in self.base_command(folder=self.folder / "second")] +
                                 ["--robot", name], capture_output=True, text=True, timeout=30)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertRegex(run.stderr, r"^saker-base: a second saker-base of robot BASE is on the network "
                                         rf"\(process {first.pid}\)\n$")
        self.assertIsNone(first.poll())

    def test_what_keeps_every_process_from_starting_is_refused(self):
        namespace = (pathlib.Path(__file__).parent / "in_namespace.sh", "--without-route")
        self.assertIn("ip route add 239.255.76.67/32 dev lo", self.refusal(before=namespace))
        self.assertIn("sysctl -w net.core.rmem_max=1073741824", self.refusal("bus.receive_buffer_kb=1048576"))
        self.assertIn("as in R1", self.refusal(after=("--robot", "my robot")))
        self.assertIn("most_robots", self.refusal("base.most_robot=3"))
        self.assertIn("/nowhere.yaml", self.refusal(after=("--config", "/nowhere.yaml")))

    def test_a_folder_that_another_base_uses_is_refused(self):
        """On a network of its own, so that presence does not tell."""
        self.start_base()
        self.wait(lambda: "listens as BASE" in self.log("base"), 20, "first base")
        elsewhere = (pathlib.Path(__file__).parent / "in_namespace.sh",)
        self.assertIn("is used by another saker-base", self.refusal(before=elsewhere))

    def test_without_a_key_it_is_refused(self):
        self.key.unlink()
        self.assertIn("team.key", self.refusal())

    def test_a_store_of_a_newer_version_is_refused(self):
        self.stop_after_start()
        subprocess.run(["/usr/bin/python3", "-c", "import sqlite3, sys; sqlite3.connect(sys.argv[1])"
                        ".execute('PRAGMA user_version=9')", self.folder / "base" / "base.db"], check=True)
        self.assertIn("has version 9, expected 1", self.refusal())

    def stop_after_start(self):
        base = self.start_base()
        self.wait(lambda: "listens as BASE" in self.log("base"), 20, "base")
        self.assertEqual(self.stop(base), 0)
        self.assertIn("ends as asked", self.log("base"))

    def test_a_flight_bus_that_leaves_the_machine_is_refused(self):
        self.assertIn("expected ttl=0", self.refusal("bus.control_url=udpm://239.255.76.67:7667?ttl=1"))

    def test_the_key_of_one_robot_is_refused(self):
        own = self.folder / "R1.key"
        run = subprocess.run([BIN / "saker", "base", "key", "--robot", "R1", "-o", own, "--set",
                              f"exchange.key_file={self.key}"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("the key is that of R1", self.refusal(f"exchange.key_file={own}"))


if __name__ == "__main__":
    unittest.main()
