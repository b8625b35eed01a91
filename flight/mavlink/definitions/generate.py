"""C++ structs of the MAVLink messages from messages.txt: generate.py messages.txt messages.h"""

import re
import sys
from pathlib import Path

SIZES = {"uint64": 8, "int64": 8, "double": 8, "uint32": 4, "int32": 4, "float": 4, "uint16": 2,
         "int16": 2, "uint8": 1, "int8": 1, "char": 1}
FIELD = re.compile(r"(?P<extension>\+ )?(?P<type>[a-z0-9]+)(\[(?P<count>\d+)\])? (?P<name>[a-z][a-z0-9_]*)$")
MESSAGE = re.compile(r"(?P<name>[A-Z][A-Z0-9_]*) (?P<id>\d+) (?P<crc>\d+)$")
LONGEST = 255


class Wrong(Exception):
    pass


class Field:
    def __init__(self, match):
        self.name, self.type = match["name"], match["type"]
        self.count, self.extension = int(match["count"] or 0), bool(match["extension"])
        if self.type not in SIZES:
            raise Wrong(f"field {self.name}: type {self.type}, expected one of {', '.join(SIZES)}")

    @property
    def length(self):
        return SIZES[self.type] * (self.count or 1)

    def cpp_type(self):
        scalar = self.type if self.type in ("float", "double", "char") else f"std::{self.type}_t"
        return f"std::array<{scalar}, {self.count}>" if self.count else scalar

    def wire_type(self):
        return self.type if self.type in ("float", "double", "char") else self.type + "_t"


class Message:
    def __init__(self, match):
        self.name, self.id, self.crc = match["name"], int(match["id"]), int(match["crc"])
        self.fields = []

    @property
    def base(self):
        return [field for field in self.fields if not field.extension]

    def struct_name(self):
        return "".join(part.capitalize() for part in self.name.split("_"))

    def check(self):
        sizes = [SIZES[field.type] for field in self.base]
        if not sizes or sizes != sorted(sizes, reverse=True):
            raise Wrong(f"{self.name}: fields from the widest type to the narrowest are expected")
        extensions = [field.extension for field in self.fields]
        if extensions != sorted(extensions):
            raise Wrong(f"{self.name}: a field without + after one with +")
        if len({field.name for field in self.fields}) != len(self.fields):
            raise Wrong(f"{self.name}: a field's name twice")
        if sum(field.length for field in self.fields) > LONGEST:
            raise Wrong(f"{self.name}: longer than {LONGEST} bytes")
        if self.crc != crc_extra(self):
            raise Wrong(f"{self.name}: CRC_EXTRA {self.crc}, its fields give {crc_extra(self)}")


def crc(data, value=0xFFFF):
    """CRC-16/MCRF4XX."""
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ (0x8408 if value & 1 else 0)
    return value


def crc_extra(message):
    """What both ends have to know alike: a byte made of the message's name and of its fields'."""
    value = crc(f"{message.name} ".encode())
    for field in message.base:
        value = crc(f"{field.wire_type()} {field.name} ".encode(), value)
        if field.count:
            value = crc(bytes([field.count]), value)
    return value & 0xFF ^ value >> 8


def read(text):
    messages = []
    for number, line in enumerate(text.splitlines(), 1):
        line = line.split("#")[0].strip()
        if not line:
            continue
        if match := MESSAGE.match(line):
            messages.append(Message(match))
        elif (match := FIELD.match(line)) and messages:
            messages[-1].fields.append(Field(match))
        else:
            raise Wrong(f"line {number}: {line!r}, expected NAME id CRC_EXTRA or [+] type[count] name")
    for message in messages:
        message.check()
    ids = [message.id for message in messages]
    if ids != sorted(set(ids)):
        raise Wrong("messages in ascending order of their ids, each once, are expected")
    return messages


def struct(message):
    length = sum(field.length for field in message.fields)
    least = sum(field.length for field in message.base)
    members = "\n".join(f"  {field.cpp_type()} {field.name}{{}};" for field in message.fields)
    visits = "\n".join(f'    v("{field.name}", m.{field.name});' for field in message.fields)
    return f"""
struct {message.struct_name()} {{
  static constexpr const char* kName = "{message.name}";
  static constexpr std::uint32_t kId = {message.id};
  static constexpr std::uint8_t kCrcExtra = {message.crc};
  static constexpr std::size_t kLength = {length};      // bytes, with extensions
  static constexpr std::size_t kBaseLength = {least};  // bytes, as in MAVLink 1

{members}

  /// Calls v(name, field) for each field in the order on the wire.
  template <class Self, class Visitor>
  static void visit(Self& m, Visitor&& v) {{
{visits}
  }}
}};
"""


def header(messages):
    rows = "\n".join(f"    {{{m.id}, {m.crc}, {sum(f.length for f in m.base)}, "
                     f"{sum(f.length for f in m.fields)}, \"{m.name}\"}}," for m in messages)
    types = ", ".join(m.struct_name() for m in messages)
    return f"""// Made by generate.py from messages.txt: change that.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>

namespace saker::flight::mavlink {{
{"".join(struct(m) for m in messages)}
struct Definition {{
  std::uint32_t id;
  std::uint8_t crc_extra;
  std::uint8_t base_length, length;
  const char* name;
}};

/// In ascending order of ids.
inline constexpr std::array<Definition, {len(messages)}> kDefinitions = {{{{
{rows}
}}}};

using AllMessages = std::tuple<{types}>;

}}  // namespace saker::flight::mavlink
"""


def main():
    source, target = map(Path, sys.argv[1:3])
    try:
        target.write_text(header(read(source.read_text())))
    except Wrong as wrong:
        sys.exit(f"{source}: {wrong}")


if __name__ == "__main__":
    main()
