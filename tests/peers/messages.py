"""A file of messages for the tests of peers: of each its topic, type, time (ns) and bytes."""

import struct


def read(path):
    data, at = open(path, "rb").read(), 0
    while at < len(data):
        parts = []
        for _ in range(2):
            (size,) = struct.unpack_from("<I", data, at)
            parts.append(data[at + 4:at + 4 + size].decode())
            at += 4 + size
        time, size = struct.unpack_from("<qI", data, at)
        at += 12
        yield parts[0], parts[1], time, data[at:at + size]
        at += size


def write(path, messages):
    with open(path, "wb") as out:
        for topic, kind, time, content in messages:
            for text in (topic.encode(), kind.encode()):
                out.write(struct.pack("<I", len(text)) + text)
            out.write(struct.pack("<qI", time, len(content)) + content)
