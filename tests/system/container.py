"""A clean Debian 12 with Saker's packages in it, booted by systemd in a container of its own."""

import ctypes
import os
import pathlib
import shutil
import subprocess
import threading
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "build/deploy"
PACKAGES = ROOT / "build/packages"
INCLUDED = "systemd,systemd-sysv,iproute2,procps,logrotate"
CAP_SYS_RESOURCE = 24
PTRACE_ATTACH = 16
WALL = 0x40000000  # waitpid(2), __WALL: threads too


def command(*words, check=True, timeout=900, **options):
    run = subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True, timeout=timeout, **options)
    if check and run.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, words))}: status {run.returncode}\n{run.stdout[-4000:]}")
    return run


def require_machine():
    if os.geteuid() != 0:
        raise unittest.SkipTest("containers need root")
    for program in ("debootstrap", "systemd-nspawn", "dpkg-shlibdeps"):
        if not shutil.which(program):
            raise unittest.SkipTest(f"{program} is missing: apt-get install debootstrap systemd-container dpkg-dev")


def may_raise_limits():
    status = pathlib.Path("/proc/self/status").read_text()
    mask = next(line.split()[1] for line in status.splitlines() if line.startswith("CapEff"))
    return bool(int(mask, 16) >> CAP_SYS_RESOURCE & 1)


def mirror():
    """Where this machine's apt gets its packages from."""
    sites = command("apt-get", "indextargets", "--format", "$(SITE)", "Created-By: Packages", "Codename: bookworm").stdout
    return os.environ.get("SAKER_MIRROR") or sites.split()[0]


def base():
    """A bare Debian, made once."""
    folder, part = FOLDER / "base", FOLDER / "base.part"
    if not folder.exists():
        shutil.rmtree(part, ignore_errors=True)
        FOLDER.mkdir(parents=True, exist_ok=True)
        made = command("debootstrap", "--variant=minbase", f"--include={INCLUDED}", "bookworm", part, mirror(),
                       check=False)
        if made.returncode != 0:
            raise unittest.SkipTest(f"no Debian from {mirror()}: {made.stdout[-500:]}")
        part.rename(folder)
    return folder


def packages():
    """Built once a run of the tests."""
    command(ROOT / "scripts/package")
    return sorted(PACKAGES.glob("saker-*_amd64.deb"))


def apt(root, *words):
    return command("chroot", root, "apt-get", "-y", "-q", "--no-install-recommends", *words,
                   env=os.environ | {"DEBIAN_FRONTEND": "noninteractive"})


def installed(name, debs):
    """A copy of the bare Debian with the packages in it, by apt."""
    root = FOLDER / name
    shutil.rmtree(root, ignore_errors=True)
    command("cp", "-a", base(), root)
    (root / "packages").mkdir()
    for deb in debs:
        shutil.copy(deb, root / "packages")
    apt(root, "update")
    apt(root, "install", *(f"/packages/{deb.name}" for deb in debs))
    return root


def reap(task):
    """A traced thread is not gone before who traces it has heard of its end."""
    try:
        while not os.WIFSIGNALED(os.waitpid(task, WALL)[1]):
            pass
    except ChildProcessError:
        pass


class Container:
    """Booted; `end` it, whatever happens."""

    def __init__(self, root):
        self.root = root
        with open(FOLDER / "boot.log", "w") as log:
            self.process = subprocess.Popen(
                ["systemd-nspawn", "-D", root, "-b", "--register=no", "--keep-unit", "--private-network",
                 "--capability=CAP_IPC_LOCK", "-M", f"saker-{os.getpid()}"],
                stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)
        self.init = None
        self.wait(self.booted, 60, "booted system")

    def booted(self):
        if self.process.poll() is not None:
            raise unittest.SkipTest("systemd-nspawn cannot boot here: " + (FOLDER / "boot.log").read_text()[-500:])
        children = pathlib.Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children").read_text().split()
        if not children:
            return False
        self.init = children[0]
        state = self.run("systemctl", "is-system-running", check=False).stdout.strip()
        return state in ("running", "degraded")

    def end(self):
        self.process.terminate()  # an orderly shutdown
        try:
            self.process.wait(timeout=30)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    def inside(self, *words):
        return ["nsenter", "-t", self.init, "-a", *map(str, words)]

    def run(self, *words, check=True):
        return command(*self.inside(*words), check=check)

    def wait(self, done, seconds, what):
        end = time.monotonic() + seconds
        while not done():
            if time.monotonic() > end:
                raise AssertionError(f"no {what} within {seconds} s")
            time.sleep(0.1)

    def host_pid(self, pid):
        """Of a process of the container, as this machine numbers it."""
        namespace = os.readlink(f"/proc/{self.init}/ns/pid")
        for entry in pathlib.Path("/proc").iterdir():
            try:
                if entry.name.isdigit() and os.readlink(entry / "ns/pid") == namespace:
                    line = next(x for x in (entry / "status").read_text().splitlines() if x.startswith("NSpid"))
                    if line.split()[-1] == str(pid):
                        return int(entry.name)
            except OSError:
                continue
        raise AssertionError(f"no process {pid} in the container")

    def hang_thread(self, pid, name):
        """One thread of a process stands still from now on, the others run: this process traces it."""
        for task in pathlib.Path(f"/proc/{self.host_pid(pid)}/task").iterdir():
            if (task / "comm").read_text().strip() == name:
                libc = ctypes.CDLL(None, use_errno=True)
                if libc.ptrace(PTRACE_ATTACH, int(task.name), None, None) != 0:
                    raise AssertionError(os.strerror(ctypes.get_errno()))
                threading.Thread(target=reap, args=(int(task.name),), daemon=True).start()
                return
        raise AssertionError(f"no thread {name}")
