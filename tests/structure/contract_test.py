"""docs/contract.md and `saker … --help` say the same."""

import os
import re
import subprocess
import unittest

import repository

EVERYWHERE = {"--help", "--preset", "--config", "--set", "--seed", "--threads", "--verbose"}
WITH_OUT = {"--out", "--force"}


def help_of(*command):
    run = subprocess.run([os.environ["SAKER"], *command, "--help"], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return run.stdout


def section(text, title):
    found = re.search(rf"^{title}:\n((?:  .*\n)+)", text, re.MULTILINE)
    return found.group(1) if found else ""


def first_words(text):
    return re.findall(r"^  (\S+)", text, re.MULTILINE)


def long_names(words):
    """`-o,--out` -> `--out`"""
    return {name.split(",")[-1] for name in words}


def commands(prefix=()):
    """Every command that can be run, as words: ("scans",), ("map", "info"), …"""
    inner = first_words(section(help_of(*prefix), "Subcommands"))
    if not inner:
        return [prefix]
    return [command for name in inner for command in commands((*prefix, name))]


def helped(command):
    """(arguments, options) as --help has them, without the common options."""
    text = help_of(*command)
    options = long_names(w for w in first_words(section(text, "Options")) if w.startswith("-"))
    return set(first_words(section(text, "Positionals"))), options


def documented():
    """{command: (arguments, options)} as the contract's table has them."""
    text = (repository.ROOT / "docs/contract.md").read_text()
    table = {}
    for line in re.findall(r"^\| `saker ([^`]*)`", text, re.MULTILINE):
        line = line.replace("\\|", "|")
        command = re.match(r"[a-z-]+(?: [a-z]+)*", line).group()
        options = set(re.findall(r"--[a-z-]+", line))
        if re.search(r"(?<![^\s\[])-o\b", line):
            options |= WITH_OUT
        rest = re.sub(r"\[?-{1,2}[a-z-]+(?: [A-Za-z|.,]+)?\]?", "", line[len(command):])
        table[tuple(command.split())] = (set(re.findall(r"[A-Z]+", rest)), options | EVERYWHERE)
    return table


class Contract(unittest.TestCase):
    maxDiff = None

    def test_the_same_commands(self):
        self.assertEqual(sorted(documented()), sorted(commands()))

    def test_the_same_arguments_and_options(self):
        for command, said in documented().items():
            with self.subTest(command=" ".join(command)):
                self.assertEqual(said, helped(command))

    def test_every_command_shows_an_example_of_itself(self):
        for command in commands():
            with self.subTest(command=" ".join(command)):
                self.assertIn("Example:\n  saker " + " ".join(command), help_of(*command))


if __name__ == "__main__":
    unittest.main()
