"""A robot's machine and the ground's, joined by a radio that somebody else sits on: three network namespaces and a bridge."""

import pathlib
import socket
import struct
import subprocess
import time

from base_processes import BIN, NamespaceTest

LOCAL = "udpm://239.255.76.67:7667?ttl=0"
PROBE = BIN / "lcm_probe"
GROUND, ROBOT, ATTACKER = "10.76.1.1", "10.76.1.2", "10.76.1.66"
PORT = 7670


def ip(*words, inside=()):
    subprocess.run([*inside, "ip", *map(str, words)], check=True, capture_output=True)


class Machine:
    """A network namespace of its own."""

    def __init__(self, test):
        self.holder = subprocess.Popen(["unshare", "--net", "sleep", "600"])
        test.addCleanup(test.end, self.holder)
        here = pathlib.Path("/proc/self/ns/net").readlink()
        test.wait(lambda: pathlib.Path(f"/proc/{self.holder.pid}/ns/net").readlink() != here, 5, "namespace")
        ip("link", "set", "lo", "up", "multicast", "on", inside=self.inside)

    @property
    def inside(self):
        return ["nsenter", "-t", str(self.holder.pid), "--net"]


def lcm_datagram(channel, data):
    """As LCM sends a short message (lcm_udpm.c): magic, number, name, bytes."""
    return struct.pack(">II", 0x4C433032, 1) + channel.encode() + b"\0" + data


def ipv4(source, to, payload, port=PORT, source_port=PORT):
    """A datagram that says it comes from `source`; the kernel fills in the checksum of IP, UDP's is none."""
    udp = struct.pack(">HHHH", source_port, port, 8 + len(payload), 0)
    head = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + 8 + len(payload), 0, 0, 64, 17, 0, socket.inet_aton(source),
                       socket.inet_aton(to))
    return head + udp + payload


class RadioTest(NamespaceTest):
    """This namespace is the ground's machine; the attacker's is the air between."""

    def setUp(self):
        super().setUp()
        self.attacker, self.robot = Machine(self), Machine(self)
        inside = self.attacker.inside
        ip("link", "add", "air", "type", "bridge", inside=inside)
        for machine, name, address in ((None, "ground", GROUND), (self.robot, "robot", ROBOT)):
            where = machine.inside if machine else []
            ip("link", "add", "name", name, "type", "veth", "peer", "name", f"{name}_air", "netns",
               self.attacker.holder.pid)
            if machine:
                ip("link", "set", name, "netns", machine.holder.pid)
            else:
                self.addCleanup(subprocess.run, ["ip", "link", "delete", name], capture_output=True)
            ip("link", "set", f"{name}_air", "master", "air", "up", inside=inside)
            ip("address", "add", f"{address}/24", "broadcast", "10.76.1.255", "dev", name, inside=where)
            ip("link", "set", name, "up", inside=where)
            ip("route", "replace", "239.255.76.67/32", "dev", "lo", inside=where)
        ip("address", "add", f"{ATTACKER}/24", "broadcast", "10.76.1.255", "dev", "air", inside=inside)
        ip("link", "set", "air", "up", inside=inside)
        ip("route", "replace", "239.0.0.0/8", "dev", "air", inside=inside)
        self.robot_key = self.folder / "R1.key"
        self.make_robot_key()

    def make_robot_key(self, *words):
        subprocess.run([BIN / "saker", "base", "key", "--robot", "R1", *words, "-o", self.robot_key, "--set",
                        f"exchange.key_file={self.key}"], check=True, capture_output=True)

    def start_ground(self):
        base = self.start_base()
        self.wait(lambda: "listens as BASE" in self.log("base"), 20, "base")
        return base

    def start_link(self, name="link", key=None):
        return self.start(name, *self.robot.inside, BIN / "saker-link", "--robot", "R1", "--set",
                          f"link.ground={GROUND}:{PORT}", "--set", f"exchange.key_file={key or self.robot_key}")

    def connect(self):
        base, link = self.start_ground(), self.start_link()
        self.wait(lambda: "R1 is there" in self.log("base"), 20, "link")
        return base, link

    def listen(self, machine, seconds, *suffixes, url=LOCAL):
        inside = machine.inside if machine else []
        listener = subprocess.Popen([*inside, PROBE, "hear", url, str(seconds), *suffixes], stdout=subprocess.PIPE,
                                    text=True)
        self.addCleanup(self.end, listener)
        self.addCleanup(listener.stdout.close)
        time.sleep(0.5)
        return listener

    def heard(self, listener):
        return [tuple(line.split()) for line in listener.communicate(timeout=60)[0].splitlines()]

    def say(self, machine, channel, hex_bytes, count=1, rate_hz=100):
        inside = machine.inside if machine else []
        subprocess.run([*inside, PROBE, "say", LOCAL, channel, hex_bytes, str(count), str(rate_hz)], check=True)

    def capture(self):
        """tcpdump on the air; what `stop_capture` gives is what it wrote."""
        self.capture_file = self.folder / "air.pcap"
        dump = self.start("tcpdump", *self.attacker.inside, "tcpdump", "-Z", "root", "-i", "air", "-U", "-w",
                          self.capture_file)
        self.wait(lambda: "listening on air" in self.log("tcpdump"), 20, "tcpdump")
        return dump

    def stop_capture(self, dump):
        """[(source, destination, port, payload)] of all UDP datagrams, and the file's bytes."""
        time.sleep(0.5)
        self.stop(dump)
        data = self.capture_file.read_bytes()
        at, datagrams = 24, []
        while at < len(data):
            size = struct.unpack_from("<I", data, at + 8)[0]
            frame, at = data[at + 16:at + 16 + size], at + 16 + size
            if frame[12:14] == b"\x08\x00" and frame[23] == 17:
                head = 14 + 4 * (frame[14] & 15)
                length = struct.unpack_from(">H", frame, head + 4)[0]
                datagrams.append((socket.inet_ntoa(frame[26:30]), socket.inet_ntoa(frame[30:34]),
                                  struct.unpack_from(">H", frame, head + 2)[0], frame[head + 8:head + length]))
        return datagrams, data

    def inject(self, lines):
        """Sends (kind, address, port, payload) from the attacker's machine; kind: udp, or the source that it pretends."""
        script = (
            "import socket, sys, time\n"
            "udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)\n"
            "udp.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)\n"
            "udp.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 8)\n"
            "raw = socket.socket(socket.AF_INET, socket.SOCK_RAW, socket.IPPROTO_RAW)\n"
            "for line in sys.stdin:\n"
            "    kind, address, port, payload = line.split()\n"
            "    (udp if kind == 'udp' else raw).sendto(bytes.fromhex(payload), (address, int(port)))\n"
            "    time.sleep(0.0005)\n")
        text = "".join(f"{kind} {address} {port} {payload.hex()}\n" for kind, address, port, payload in lines)
        subprocess.run([*self.attacker.inside, "/usr/bin/python3", "-c", script], input=text, text=True, check=True)
