"""Samples of the processes of one flight in real time, for `saker soak --samples`; keeps it hovering by order.

soak_samples.py FOLDER MINUTES SAKER PID     PID: of scripts/fly, whose children are looked at
"""

import json
import os
import pathlib
import subprocess
import sys
import time

EVERY_S = 5
HOLD_AGAIN_S = 200  # a hold by order lasts 300 s
BEGINS_WITHIN_S = 120
NAMES = ("saker-flight", "saker-collision-checker", "saker-sim")
TICKS, PAGE = os.sysconf("SC_CLK_TCK"), os.sysconf("SC_PAGESIZE")


def children(pid):
    """All below it, by their program's name."""
    found = {}
    for folder in pathlib.Path("/proc").iterdir():
        if not folder.name.isdigit():
            continue
        try:
            fields = (folder / "stat").read_text().rpartition(") ")[2].split()
            name = pathlib.Path(os.readlink(folder / "exe")).name
        except OSError:
            continue
        if int(fields[1]) == pid and name in NAMES:
            found[name] = folder
    return found


def unread_kb(folder):
    """In the UDP sockets of one process: /proc/net/udp lists those of its network by inode."""
    own = set()
    for handle in (folder / "fd").iterdir():
        try:
            own.add(os.readlink(handle))
        except OSError:
            continue
    total = 0
    for line in (folder / "net/udp").read_text().splitlines()[1:]:
        words = line.split()
        if f"socket:[{words[9]}]" in own:
            total += int(words[4].split(":")[1], 16)
    return total / 1000


class Process:
    def __init__(self, name, folder, begin):
        self.name, self.folder, self.begin = name, folder, begin
        self.cpu, self.at = self.cpu_s(), time.monotonic()

    def cpu_s(self):
        fields = (self.folder / "stat").read_text().rpartition(") ")[2].split()
        return (int(fields[11]) + int(fields[12])) / TICKS

    def sample(self):
        now, cpu = time.monotonic(), self.cpu_s()
        work, self.cpu, self.at = (cpu - self.cpu) / (now - self.at), cpu, now
        return {"process": self.name, "t_h": (now - self.begin) / 3600,
                "memory_mb": int((self.folder / "statm").read_text().split()[1]) * PAGE * 1e-6,
                "handles": len(list((self.folder / "fd").iterdir())),
                "threads": len(list((self.folder / "task").iterdir())), "waiting": unread_kb(self.folder), "work": work}


def hold(saker, folder):
    run = subprocess.run([saker, "order", "R1", "hold", "--set", f"exchange.key_file={folder}/team.key"],
                         capture_output=True, text=True, timeout=30, check=False)
    return run.returncode == 0


def wait_for_flight(pid, saker, folder):
    end = time.monotonic() + BEGINS_WITHIN_S
    while time.monotonic() < end:
        time.sleep(2)
        log = folder / "flight/saker-flight.log"
        if log.exists() and "tour" in log.read_text() and hold(saker, folder):
            return children(pid)
    return {}


def main(folder, minutes, saker, pid):
    found = wait_for_flight(pid, saker, folder)
    if set(found) != set(NAMES):
        print(f"soak_samples.py: no flight within {BEGINS_WITHIN_S} s: {folder}/fly.txt", file=sys.stderr)
        return 1
    begin = held = time.monotonic()
    processes = [Process(name, path, begin) for name, path in sorted(found.items())]
    with open(folder / "soak.jsonl", "w", encoding="utf-8") as file:
        while time.monotonic() < begin + 60 * minutes:
            time.sleep(EVERY_S)
            try:
                for process in processes:
                    file.write(json.dumps(process.sample()) + "\n")
            except OSError:
                print(f"soak_samples.py: a process ended after {time.monotonic() - begin:.0f} s", file=sys.stderr)
                return 1
            file.flush()
            if time.monotonic() > held + HOLD_AGAIN_S:
                held = time.monotonic()
                if not hold(saker, folder):
                    print("soak_samples.py: an order to hold was not accepted", file=sys.stderr)
                    return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), float(sys.argv[2]), sys.argv[3], int(sys.argv[4])))
