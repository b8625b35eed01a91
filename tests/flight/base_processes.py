"""saker-base, robots' ends of the exchange and what goes wrong with them, by real processes over real LCM."""

import os
import pathlib
import secrets
import sqlite3
import subprocess
import tempfile
import time
import unittest

BIN = pathlib.Path(os.environ["SAKER_BIN"])


class BaseTest(unittest.TestCase):
    """Processes that are ended, whatever happens; a folder; a key."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="saker_base_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.key = self.folder / "team.key"
        self.make_key(self.key)

    @staticmethod
    def make_key(file):
        file.write_text(secrets.token_hex(32))
        file.chmod(0o600)

    def start(self, name, *command):
        with open(self.folder / f"{name}.log", "a") as log:
            process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=log,
                                       stdin=subprocess.DEVNULL)
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.kill()
        process.wait()

    def base_command(self, *settings, folder=None):
        command = [BIN / "saker-base", "--set", f"base.folder={folder or self.folder / 'base'}",
                   "--set", f"exchange.key_file={self.key}"]
        for setting in settings:
            command += ["--set", setting]
        return command

    def start_base(self, *settings):
        return self.start("base", *self.base_command(*settings))

    def start_robot(self, robot, made_bytes=0, loss=0, key=None):
        return self.start(robot, BIN / "exchange_robot", robot, key or self.key, self.folder / robot, made_bytes, loss)

    def log(self, name):
        return (self.folder / f"{name}.log").read_text()

    def wait(self, done, seconds, what):
        end = time.monotonic() + seconds
        while not done():
            if time.monotonic() > end:
                self.fail(f"no {what} within {seconds} s\n" + "\n".join(
                    f"{path.name}:\n{path.read_text()[-2000:]}" for path in sorted(self.folder.glob("*.log"))))
            time.sleep(0.05)

    def stored(self):
        """{(robot, flight): bytes without a gap} of the histories in the base's store."""
        file = self.folder / "base" / "base.db"
        streams = {}
        if not file.exists():
            return streams
        database = sqlite3.connect(f"file:{file}?mode=ro", uri=True)
        try:
            rows = database.execute("SELECT robot, version, place & 65535, bytes FROM chunks "
                                    "JOIN streams ON streams.id = place >> 16 WHERE kind = 0 ORDER BY place").fetchall()
        except sqlite3.OperationalError:  # not made yet
            rows = []
        finally:
            database.close()
        for robot, version, chunk, data in rows:
            held = streams.setdefault((robot, version), b"")
            if len(held) == 1100 * chunk:
                streams[robot, version] = held + data
        return streams

    def stored_bytes(self, robot):
        return len(self.stored().get((robot, 1), b""))

    def stop(self, process):
        """Its status after SIGTERM."""
        process.terminate()
        return process.wait(timeout=10)

    def held_by(self, robot):
        """{stream: bytes}, as the robot left it when it was stopped."""
        return {path.stem: path.read_bytes() for path in (self.folder / robot).glob("*.bytes")}


@unittest.skipUnless(os.environ.get("SAKER_NAMESPACE") == "yes", "runs by in_namespace.sh")
class NamespaceTest(BaseTest):
    pass
