"""saker-ground by processes: real LCM of a made robot, real sockets of clients, good and bad ones."""

import asyncio
import contextlib
import json
import os
import pathlib
import re
import resource
import signal
import socket
import ssl
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request

try:
    import websockets
    from ground_client import Client, SDK
except ImportError:
    print("skipped: Debian's python3-websockets is not there")
    sys.exit(77)

BIN = pathlib.Path(os.environ["SAKER_BIN"])
URL = "udpm://239.255.76.67:7667?ttl=0"


def on(loop):
    """A test that is a coroutine."""
    return lambda self: asyncio.run(loop(self))


@unittest.skipUnless(os.environ.get("SAKER_NAMESPACE") == "yes", "runs by in_namespace.sh")
class GroundTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="saker_ground_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def start(self, *command, **options):
        process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, **options)

        def end():
            if process.poll() is None:
                process.kill()
            process.wait()
            if process.stdout:
                process.stdout.close()
        self.addCleanup(end)
        return process

    def ground(self, *options):
        """The process, and the address that it says."""
        log = open(self.folder / "ground.log", "ab")
        self.addCleanup(log.close)
        process = self.start(BIN / "saker-ground", "--port", 0, "--set", f"ground.folder={self.folder / 'ground'}",
                             *options, stdout=subprocess.PIPE, stderr=log, text=True)
        address = process.stdout.readline().strip()
        self.assertRegex(address, r"^https?://", (self.folder / "ground.log").read_text())
        return process, address

    def robot(self, name="R1", seconds=60, objects=5):
        return self.start(BIN / "made_robot", name, seconds, objects)

    def stop(self, process):
        process.send_signal(signal.SIGTERM)
        return process.wait(timeout=10)


async def ended(*tasks):
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


def socket_of(address):
    return address.replace("http", "ws", 1)


def status_of(address, path, method="GET"):
    """The status line of a request whose path goes out as it is."""
    host, port = re.match(r"http://([^:/]+):(\d+)/", address).groups()
    with socket.create_connection((host, int(port)), timeout=5) as s:
        s.sendall(f"{method} {path} HTTP/1.1\r\nHost: {host}:{port}\r\nConnection: close\r\n\r\n".encode())
        answer = b""
        while b"\r\n" not in answer:
            more = s.recv(4096)
            if not more:
                break
            answer += more
    return answer.split(b"\r\n")[0].decode()


def memory_mb(process):
    text = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+)", text).group(1)) / 1024


class Live(GroundTest):
    @on
    async def test_shows_the_vehicle_and_its_objects_as_they_are(self):
        self.robot(objects=40)
        process, address = self.ground()
        async with Client(socket_of(address)) as client:
            self.assertEqual(client.info["metadata"]["mode"], "live")
            await client.subscribe("/R1/objects", "/R1/odometry", "/R1/mission", "/R1/points", "/R1/health")
            whole = await client.newest("/R1/objects", lambda m: len(m["objects"]) == 40, 20)
            self.assertEqual([o["id"] for o in whole["objects"]], list(range(40)))
            self.assertEqual(whole["objects"][7]["size"], [4, 2, 1.5])
            self.assertEqual(whole["objects"][7]["position"], [35, 2, 0.75])
            odometry = await client.newest("/R1/odometry")
            self.assertAlmostEqual(odometry["position"][0] ** 2 + odometry["position"][1] ** 2, 100, places=3)
            self.assertEqual((await client.newest("/R1/mission"))["phase"], "tour")
            self.assertGreater(len((await client.newest("/R1/points"))["data"]), 50000)
        self.assertEqual(self.stop(process), 0)

    @on
    async def test_a_lost_link_is_said_within_two_seconds_and_comes_back(self):
        robot = self.robot()
        _, address = self.ground()
        async with Client(socket_of(address)) as client:
            await client.subscribe("/R1/link")
            await client.newest("/R1/link", lambda m: not m["lost"])
            robot.kill()
            lost_at = time.monotonic()
            await client.newest("/R1/link", lambda m: m["lost"])
            self.assertLess(time.monotonic() - lost_at, 2)
            client.messages.clear()
            self.robot()
            await client.newest("/R1/link", lambda m: not m["lost"])

    @on
    async def test_several_robots_are_each_their_own(self):
        self.robot("R1", objects=3)
        _, address = self.ground()
        async with Client(socket_of(address), SDK) as client:
            await client.subscribe("/R1/site")
            self.robot("R2", objects=4)  # later
            await client.subscribe("/R2/site", "/R2/objects")
            one, two = await client.newest("/R1/site"), await client.newest("/R2/site")
            self.assertNotEqual(one["colour"], two["colour"])
            self.assertEqual((await client.newest("/R2/objects"))["total"], 4)

    @on
    async def test_history_is_there_for_who_comes_late(self):
        self.robot()
        _, address = self.ground()
        await asyncio.sleep(4)
        async with Client(socket_of(address)) as client:
            kept = await client.call("history", {"topic": "/R1/odometry", "seconds": 2})
            self.assertGreater(len(kept["messages"]), 15)
            self.assertLess(len(kept["messages"]), 25)

    @on
    async def test_it_only_listens(self):
        self.robot(seconds=8)
        _, address = self.ground()
        probe = self.start(BIN / "lcm_probe", "hear", URL, 6, "_[A-Z_]+", stdout=subprocess.PIPE, text=True)
        async with Client(socket_of(address)) as client:
            await client.subscribe("/R1/objects")
            answer = await client.call("order", {"robot": "R1", "kind": "land"})
            self.assertEqual(answer["state"], "refused")  # without a key of the team
            await client.socket.send("garbage")
            with self.assertRaises(websockets.ConnectionClosed):
                await client.until(lambda: False, 5)
        heard = {line.split()[0] for line in probe.communicate()[0].splitlines()}
        self.assertEqual(heard, {f"R1_{kind}" for kind in ("STATE", "ODOMETRY", "SETPOINT", "VERDICT", "MISSION", "PLAN",
                                                           "TRAJECTORY", "HEALTH", "OBJECTS")})

    @on
    async def test_an_order_to_a_name_makes_no_robot(self):
        self.robot(seconds=20)
        _, address = self.ground()
        async with Client(socket_of(address)) as client:
            await client.subscribe("/R1/state")
            answer = await client.call("order", {"robot": "R9", "kind": "hold"})
            self.assertEqual(answer["state"], "refused")
            client.messages.clear()
            await client.newest("/R1/state")
            self.assertFalse([topic for topic in client.channels if topic.startswith("/R9/")])
        log = (self.folder / "ground/orders.log").read_text()
        self.assertIn('"robot":"R9","kind":"hold","by":"127.0.0.1"', log)

    @on
    async def test_a_recording_is_whole_or_not_there(self):
        self.robot()
        file = self.folder / "flight.mcap"
        process, _ = self.ground("--record", file)
        await asyncio.sleep(3)
        self.assertFalse(file.exists())
        self.assertEqual(self.stop(process), 0)
        told = subprocess.run([BIN / "saker", "info", file], capture_output=True, text=True)
        self.assertIn("/R1/odometry", told.stdout, told.stderr)
        self.assertIn("/R1/scan", told.stdout)


class Clients(GroundTest):
    def test_the_page_and_nothing_else_is_served(self):
        _, address = self.ground()
        page = BIN.parent.parent.parent / "flight/ground/page/index.html"
        with urllib.request.urlopen(address) as answer:
            self.assertEqual(answer.read(), page.read_bytes())
            self.assertEqual(answer.headers["x-content-type-options"], "nosniff")
        for path in ("/../main.cc", "/%2e%2e/main.cc", "/..%2fmain.cc", "//etc/passwd", "/none.js", "/.git"):
            self.assertNotIn(" 200 ", status_of(address, path), path)
        self.assertIn(" 405 ", status_of(address, "/", "POST"))

    @on
    async def test_pages_of_other_sites_are_refused(self):
        _, address = self.ground()
        for options in ({"origin": "https://evil.example"}, {"extra_headers": {"Host": "evil.example"}}):
            with self.assertRaises(Exception, msg=options):
                async with Client(socket_of(address), **options):
                    pass
        far = "https://" + ".".join(["a" * 60] * 5) + ".example"  # longer than any buffer: it is one all the same
        with self.assertRaises(Exception):
            async with Client(socket_of(address), origin=far):
                pass
        with self.assertRaises(Exception):
            async with Client(socket_of(address), "chat"):
                pass
        async with Client(socket_of(address), origin=address.rstrip("/")):
            pass

    @on
    async def test_by_another_interface_the_key_is_needed(self):
        self.robot()
        _, address = self.ground("--listen", "127.0.0.1")
        self.assertRegex(address, r"^https://127\.0\.0\.1:\d+/$")
        key = (self.folder / "ground/address.key").read_text().strip()
        self.assertRegex(key, r"^[0-9a-f]{32}$")
        self.assertEqual((self.folder / "ground/address.key").stat().st_mode & 0o777, 0o600)
        self.assertNotIn(key, (self.folder / "ground.log").read_text())
        address += f"?key={key}"
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        context.load_verify_locations(self.folder / "ground/certificate-127.0.0.1.pem")  # which names the address
        async with Client(socket_of(address), ssl=context, origin="https://app.foxglove.dev") as client:
            await client.subscribe("/R1/state")
            await client.newest("/R1/state")
        for wrong in ("", "?key=", "?key=" + "0" * 32):
            with self.assertRaises(Exception, msg=wrong):
                async with Client(re.sub(r"\?.*", wrong, socket_of(address)), ssl=context):
                    pass

    def test_the_key_of_the_address_is_said_on_a_terminal_alone(self):
        ours, its = os.openpty()
        process = self.start(BIN / "saker-ground", "--port", 0, "--listen", "127.0.0.1", "--set",
                             f"ground.folder={self.folder / 'ground'}", stdout=its, stderr=subprocess.DEVNULL)
        with open(ours) as terminal:
            address = terminal.readline().strip()
            os.close(its)
        key = (self.folder / "ground/address.key").read_text().strip()
        self.assertRegex(address, rf"^https://127\.0\.0\.1:\d+/\?key={key}$")
        self.assertEqual(self.stop(process), 0)

    @on
    async def test_twenty_clients_and_bad_ones_among_them(self):
        self.robot(objects=200, seconds=150)
        process, address = self.ground()
        host, port = re.match(r"http://([^:]+):(\d+)/", address).groups()
        topics = ("/R1/objects", "/R1/odometry", "/R1/points", "/R1/scene")
        clients = [await Client(socket_of(address)).__aenter__() for _ in range(20)]
        try:
            for client in clients:
                await client.subscribe(*topics)
            deaf = await Client(socket_of(address)).__aenter__()
            await deaf.subscribe(*topics)
            deaf.socket.transport.pause_reading()
            before = memory_mb(process)
            hear = [asyncio.create_task(client.drain()) for client in clients]
            for _ in range(30):  # garbage of every kind, by connections of their own
                with socket.create_connection((host, int(port))) as s:
                    s.sendall(os.urandom(3000))
                bad = await Client(socket_of(address)).__aenter__()
                await bad.socket.send(b"\xff" + os.urandom(199))  # no operation of the protocol
                await asyncio.sleep(0.1)
            await asyncio.sleep(30)  # what the kernel keeps for the deaf one fills first
            await ended(*hear)
            for client in clients:
                client.messages.clear()
            await asyncio.gather(*(c.until(lambda c=c: sum(t == "/R1/odometry" for t, *_ in c.messages) >= 10, 10)
                                   for c in clients))
            self.assertLess(memory_mb(process) - before, 64)
        finally:
            for client in clients:
                await client.__aexit__()
        self.assertEqual(self.stop(process), 0)
        totals = (self.folder / "ground.log").read_text()
        self.assertRegex(totals, r"\b1 cut that took nothing, 30 cut that sent garbage")

    @on
    async def test_one_that_asks_for_much_and_takes_nothing_is_cut_at_once(self):
        self.robot(objects=200, seconds=150)
        process, address = self.ground()
        async with Client(socket_of(address)) as good:
            await good.subscribe("/R1/objects", "/R1/odometry")
            await good.newest("/R1/objects", lambda m: len(m["objects"]) >= 60, 20)
            hears = asyncio.create_task(good.drain())
            await asyncio.sleep(5)  # some of it is kept
            greedy = await Client(socket_of(address)).__aenter__()
            greedy.socket.transport.pause_reading()
            before = memory_mb(process)
            call = struct.pack("<BIII", 2, greedy.services["history"]["id"], 1, 4) + b'json{"topic":"/R1/objects","seconds":600}'
            with contextlib.suppress(websockets.ConnectionClosed, asyncio.TimeoutError):
                for _ in range(2000):
                    await asyncio.wait_for(greedy.socket.send(call), 5)
            await asyncio.sleep(2)
            await ended(hears)
            good.messages.clear()
            await good.newest("/R1/odometry")
            self.assertLess(memory_mb(process) - before, 64)
            greedy.socket.transport.abort()

    @on
    async def test_a_message_in_pieces_is_one_and_one_that_is_too_long_is_none(self):
        self.robot()
        _, address = self.ground()
        async with Client(socket_of(address)) as client:
            await client.until(lambda: "/R1/state" in client.channels)
            client.topics[0] = "/R1/state"
            whole = json.dumps({"op": "subscribe", "subscriptions": [{"id": 0, "channelId": client.channels["/R1/state"]["id"]}]})
            await client.socket.send([whole[:9], whole[9:20], whole[20:]])
            await client.newest("/R1/state")
            await client.socket.send(" " * 70000)
            with self.assertRaises(websockets.ConnectionClosed):
                await client.until(lambda: False, 5)

    @on
    async def test_too_many_connections_leave_the_others_alone(self):
        self.robot()
        _, address = self.ground()
        resource.setrlimit(resource.RLIMIT_NOFILE, (1024, resource.getrlimit(resource.RLIMIT_NOFILE)[1]))
        host, port = re.match(r"http://([^:]+):(\d+)/", address).groups()
        async with Client(socket_of(address)) as client:
            await client.subscribe("/R1/odometry")
            idle = [socket.create_connection((host, int(port))) for _ in range(100)]
            client.messages.clear()
            await client.until(lambda: len(client.messages) >= 20, 10)
            for s in idle:
                s.close()


class FinishedRun(GroundTest):
    def made_run(self):
        out = self.folder / "out"
        out.mkdir()
        (out / "trajectory.txt").write_text("".join(
            f"{100 + 0.1 * i} {0.1 * i} 0 3 0 0 0 1\n" for i in range(101)))
        return out

    @on
    async def test_is_shown_played_and_wound(self):
        _, address = self.ground(self.made_run())
        async with Client(socket_of(address), SDK) as client:
            self.assertEqual(client.info["dataStartTime"], {"sec": 100, "nsec": 0})
            self.assertEqual(client.info["dataEndTime"], {"sec": 110, "nsec": 0})
            await client.subscribe("/R1/odometry", "/playback")
            self.assertEqual((await client.newest("/R1/odometry"))["position"][0], 10)
            client.messages.clear()
            self.assertEqual((await client.call("seek", {"t_s": 103}))["t_s"], 103)
            self.assertEqual((await client.newest("/R1/odometry"))["position"][0], 3)
            await client.call("play", {"playing": True, "speed": 10})
            await client.newest("/playback", lambda m: m["t_s"] == 110 and not m["playing"])
            with self.assertRaises(RuntimeError):
                await client.call("seek", {"t_s": None})

    def test_what_is_none_is_refused_in_one_line(self):
        ran = subprocess.run([BIN / "saker-ground", self.folder], capture_output=True, text=True, timeout=20)
        self.assertEqual(ran.returncode, 2)
        self.assertEqual(len(ran.stderr.splitlines()), 1, ran.stderr)
        self.assertIn("no map.json", ran.stderr)


if __name__ == "__main__":
    unittest.main()
