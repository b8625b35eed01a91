#!/usr/bin/env python3
"""docs/safety.md, from the tests alone: what can go wrong, what happens then, and the test that shows it.

usage: scripts/evidence/hazards.py [--check]

A row is the comment over its test, of C++ ("//") or Python ("#"), which may go on over lines that begin with two more spaces:
    // Hazard: GROUP | what goes wrong | what happens | seconds until it is at rest or landing, or –
Without --check the table is written anew; with it, the status is 1 where page and tests differ.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/safety.md"
BEGIN = "<!-- from the tests: scripts/evidence/hazards.py -->"
COMMENT = re.compile(r"^\s*(?://|#) Hazard: (.*(?:\n\s*(?://|#)   .*)*)", re.MULTILINE)
CPP = re.compile(r"\s*TEST(?:_F|_P)?\((\w+),\s*(\w+)\)")
PYTHON = re.compile(r"\s*(?:@.*\n\s*)*def (test_\w+)")
HEADS = ("what goes wrong", "what happens", "at rest or landing after", "test")


def name_of_test(file, rest):
    """Of the test that stands right under the comment."""
    if match := CPP.match(rest):
        return f"`{match[1]}.{match[2]}`"
    if match := PYTHON.match(rest):
        return f"`{match[1]}`"
    raise SystemExit(f"{file.relative_to(ROOT)}: a hazard without a test right under it")


def rows_of(file):
    text = file.read_text()
    for match in COMMENT.finditer(text):
        words = re.sub(r"\n\s*(?://|#)\s*", " ", match[1])
        fields = [field.strip() for field in words.split("|")]
        if len(fields) != 4:
            raise SystemExit(f"{file.relative_to(ROOT)}: \"{words}\", expected GROUP | what goes wrong | what happens | seconds")
        group, hazard, happens, seconds = fields
        yield group, (hazard, happens, seconds, f"{name_of_test(file, text[match.end():])}, `{file.relative_to(ROOT)}`")


def table():
    groups = {}
    for file in sorted([*(ROOT / "tests").rglob("*_test.cc"), *(ROOT / "tests").rglob("*_test.py")]):
        for group, row in rows_of(file):
            groups.setdefault(group, []).append(row)
    lines = []
    for group, rows in sorted(groups.items()):
        lines += ["", f"## {group}", "", "| " + " | ".join(HEADS) + " |", "|---|---|---|---|"]
        lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def main():
    text = PAGE.read_text()
    wanted = text[:text.index(BEGIN) + len(BEGIN)] + "\n" + table()
    if "--check" in sys.argv[1:]:
        if text != wanted:
            sys.exit(f"{PAGE.relative_to(ROOT)} differs from the tests: scripts/evidence/hazards.py writes it")
        return
    PAGE.write_text(wanted)


if __name__ == "__main__":
    main()
