#!/usr/bin/env python3
"""Writes docs/channels.md from lcmtypes/*.lcm and lcmtypes/channels.txt.

A field's comment says, in this order: unit, frame (or clock), range, invalid value[; note]

    float height_m;   // m, level, -1e4..1e4, NaN: unknown; by the barometer

A range's ends are numbers or constants of the message; `-` stands where there is nothing to say. The
range of a `num_…` field is the ceiling of its arrays, that of a text the ceiling of its bytes: the
largest size of every message follows, and periodic ones have to fit into one datagram.
"""

import dataclasses
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/channels.md"
DATAGRAM = 1400  # bytes that pass every Ethernet in one piece
FINGERPRINT = 8
BYTES = {"boolean": 1, "byte": 1, "int8_t": 1, "int16_t": 2, "int32_t": 4, "int64_t": 8, "float": 4, "double": 8}
UNITS = {"m", "cm", "m/s", "m/s^2", "rad", "rad/s", "rad^2 and m^2", "quaternion", "s", "ms", "us", "s/s", "Hz",
         "share", "nat", "count", "id", "enum", "bits", "flag", "text", "bytes", "struct"}
FRAMES = {"-", "odom", "world", "body", "lidar", "level", "object", "sensor clock", "system clock"}
NUMBER = re.compile(r"-?\d+(\.\d+)?(e-?\d+)?$")
INVALID = re.compile(r"(-?\d+|NaN|empty): \S.*$")
FIELD = re.compile(r"^  (?!const\b)([a-z]\w*) +(\w+)((?:\[\w+\])*); *(?:// (.*))?$", re.MULTILINE)


class Wrong(Exception):
    """A file that breaks the grammar, in one line."""


@dataclasses.dataclass
class Field:
    type: str
    name: str
    dimensions: list
    unit: str
    frame: str
    range: str
    invalid: str
    note: str


@dataclasses.dataclass
class Message:
    name: str
    about: str
    constants: dict
    fields: list

    def most(self, text):
        """The number that stands for the upper end of a range."""
        return self.constants.get(text) or int(float(text))

    def ceiling(self, name):
        """How many elements `[name]` can have."""
        if name.isdigit():
            return int(name)
        count = next((f for f in self.fields if f.name == name), None)
        if count is None or ".." not in count.range:
            raise Wrong(f"{self.name}: [{name}] has no ceiling")
        return self.most(count.range.split("..")[1])


def parsed_comment(where, comment, constants):
    """unit, frame, range, invalid, note"""
    body, _, note = (comment or "").partition("; ")
    parts = body.split(", ")
    if len(parts) != 4:
        raise Wrong(f"{where}: expected `// unit, frame, range, invalid[; note]`, found `{comment}`")
    unit, frame, extent, invalid = parts
    if unit not in UNITS:
        raise Wrong(f"{where}: unknown unit {unit}")
    if not set(frame.split(" <- ")) <= FRAMES:
        raise Wrong(f"{where}: unknown frame {frame}")
    ends = extent.split("..")
    known = [NUMBER.match(end) or end in constants for end in ends]
    if extent != "-" and (len(ends) != 2 or not all(known)):
        raise Wrong(f"{where}: {extent} is no range")
    if invalid != "-" and not INVALID.match(invalid):
        raise Wrong(f"{where}: {invalid} is no invalid value with its meaning")
    return unit, frame, extent, invalid, note


def parse(text):
    """One message of one file."""
    head = re.search(r"package saker;\n\n((?:// .*\n)+)struct (\w+)_t \{\n(.*)^\}", text, re.DOTALL | re.MULTILINE)
    if not head:
        raise Wrong("expected `package saker;`, a comment and one struct")
    about = " ".join(re.findall(r"^// (.*)", head.group(1), re.MULTILINE))
    name, body = head.group(2) + "_t", head.group(3)
    constants = {c: int(v) for c, v in re.findall(r"\b([A-Z][A-Z_0-9]*) = (-?\d+)", body)}
    fields = []
    for kind, field, dimensions, comment in FIELD.findall(body):
        said = parsed_comment(f"{name}.{field}", comment, constants)
        fields.append(Field(kind, field, re.findall(r"\w+", dimensions), *said))
    if len(fields) != len(re.findall(r"^  (?!const\b)\w.*;", body, re.MULTILINE)):
        raise Wrong(f"{name}: a field that cannot be read")
    return Message(name, about, constants, fields)


def messages():
    found = [parse(path.read_text()) for path in sorted((ROOT / "lcmtypes").glob("*.lcm"))]
    return {message.name: message for message in found}


def channels():
    """[(suffix, type, network, from, to, rate)]"""
    lines = (ROOT / "lcmtypes/channels.txt").read_text().splitlines()
    return [tuple(cell.strip() for cell in line.split("|")) for line in lines if line and line[0] != "#"]


def largest(message, known):
    """Bytes of the largest one, without the fingerprint."""
    size = 0
    for field in message.fields:
        if field.type == "string":
            one = 4 + message.most(field.range.split("..")[1]) + 1
        else:
            one = BYTES[field.type] if field.type in BYTES else largest(known[field.type], known)
        for dimension in field.dimensions:
            one *= message.ceiling(dimension)
        size += one
    return size


def size_of(name, known):
    return FINGERPRINT + largest(known[name], known)


def check(known, table):
    """Every message has a channel or is part of one; what is periodic fits into one datagram."""
    parts = {field.type for message in known.values() for field in message.fields}
    carried = {row[1] for row in table}
    for name in known:
        if (name in carried) == (name in parts):
            raise Wrong(f"{name}: expected on one channel or inside another message")
    for suffix, name, network, _, _, rate in table:
        first = known[name].fields[0]
        if (first.type, first.name) != ("int64_t", "utime"):
            raise Wrong(f"{name}: utime comes first")
        if network == "control" and not rate.startswith("event") and size_of(name, known) > DATAGRAM:
            raise Wrong(f"{suffix}: {size_of(name, known)} bytes, expected at most {DATAGRAM}")


def field_row(field):
    dimensions = "".join(f"[{d}]" for d in field.dimensions)
    return (f"| `{field.type} {field.name}{dimensions}` | {field.unit} | {field.frame} | {field.range} "
            f"| {field.invalid} | {field.note} |")


def message_section(message):
    lines = [f"### {message.name}", "", message.about, ""]
    if message.constants:
        lines += ["Constants: " + ", ".join(f"{c} = {v}" for c, v in message.constants.items()) + ".", ""]
    lines += ["| field | unit | frame | range | invalid | note |", "|---|---|---|---|---|---|"]
    return lines + [field_row(field) for field in message.fields] + [""]


def page():
    known, table = messages(), channels()
    check(known, table)
    lines = ["# Channels", "",
             "Made by `lcmtypes/channels.py` from `lcmtypes/*.lcm` and `lcmtypes/channels.txt`; a test compares.", "",
             "A channel's name begins with the robot's: `R1_STATE`. `control` and `bulk` are two LCM networks (keys",
             "`bus.control_url`, `bus.bulk_url`); bulk never leaves the machine. `lcm-logger` needs one run for each, on bulk",
             "with a receive buffer: `--lcm-url='udpm://239.255.76.67:7668?ttl=0&recv_buf_size=2097152'`.",
             "Size: bytes of the largest message; periodic ones on `control` fit into one datagram.", "",
             "| channel | type | network | from → to | rate | size |", "|---|---|---|---|---|---|"]
    for suffix, name, network, sender, receiver, rate in table:
        lines.append(f"| `{suffix}` | [{name}](#{name}) | {network} | {sender} → {receiver} | {rate} "
                     f"| {size_of(name, known):,} |")
    lines += ["", "## Messages", "", "Arrays run over their `num_…` field; a range's end may be a constant.", ""]
    for name in sorted(known):
        lines += message_section(known[name])
    return "\n".join(lines).rstrip() + "\n"


if __name__ == "__main__":
    PAGE.write_text(page())
