"""What scripts that measure and write a page share: they run the programs, and say of which code and on which machine a figure is."""
import datetime
import math
import os
import pathlib
import platform
import re
import subprocess
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[2]
CODE = ("modules", "flight", "tools", "configs")


def run(*command, good=(0,), environment=None):
    """What it prints; ends the script where its status is not a good one."""
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True, cwd=ROOT, env=environment)
    if result.returncode not in good:
        sys.exit(f"{' '.join(map(str, command))}: status {result.returncode}: {result.stderr.strip()[-300:]}")
    return result.stdout


def commit():
    """Of the working tree; "and changes" where its code is not what was committed."""
    git = lambda *command: run("git", "-C", ROOT, *command).strip()
    try:
        changed = git("status", "--porcelain", "--", *CODE)
        return git("rev-parse", "--short=7", "HEAD") + (" and changes" if changed else "")
    except SystemExit:
        return "unknown"


def machine():
    info = pathlib.Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else math.nan
    return f"{names[0] if names else platform.machine()}, {os.cpu_count()} threads, load {load:.1f}"


def today():
    return datetime.date.today().isoformat()


def text(value):
    return "–" if value is None else f"{value:.4g}"


def prose(words):
    """Lines of a paragraph."""
    return textwrap.wrap(" ".join(words.split()), width=140, break_long_words=False, break_on_hyphens=False)


def command_lines(command):
    """Lines of one command as a shell takes them; what is in quotation marks stays together."""
    lines = [""]
    for word in re.findall(r'"[^"]*"|\S+', command):
        if lines[-1] and len(lines[-1]) + len(word) > 130:
            lines[-1] += " \\"
            lines.append("  " + word)
        else:
            lines[-1] += f" {word}" if lines[-1] else word
    return lines


def table(heads, rows):
    """Lines of a table in Markdown."""
    line = lambda cells: f"| {' | '.join(map(str, cells))} |"
    return [line(heads), "|" + "---|" * len(heads), *map(line, rows)]
