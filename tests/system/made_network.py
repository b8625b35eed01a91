"""A network for any class table, as ONNX: one convolution of nothing but zeros, all classes alike."""

import hashlib
import json

CHANNELS = ["valid", "log_range", "height", "fine_height", "normal_up", "right_edge", "lower_edge", "right_step", "lower_step", "slope",
            "elevation", "row_pitch"]
FLOAT, INTS = 1, 7  # TensorProto.DataType, AttributeProto.AttributeType


def varint(n):
    return bytes([n & 127 | 128]) + varint(n >> 7) if n > 127 else bytes([n])


def number(field, value):
    """Protocol Buffers: an integer."""
    return varint(field << 3) + varint(value)


def piece(field, content):
    """A string, bytes or a message within a message."""
    content = content.encode() if isinstance(content, str) else content
    return varint(field << 3 | 2) + varint(len(content)) + content


def ints(name, values):
    return piece(1, name) + number(20, INTS) + b"".join(number(8, v) for v in values)


def zeros(name, *shape):
    count = 4
    for n in shape:
        count *= n
    return b"".join(number(1, n) for n in shape) + number(2, FLOAT) + piece(8, name) + piece(9, bytes(count))


def image(name, channels):
    """One image of any size."""
    shape = [number(1, 1), number(1, channels), piece(2, "rows"), piece(2, "columns")]
    return piece(1, name) + piece(2, piece(1, number(1, FLOAT) + piece(2, b"".join(piece(1, d) for d in shape))))


def network(classes):
    """The scores of two columns side by side, as segmentation expects."""
    node = piece(1, "image") + piece(1, "weights") + piece(2, "scores") + piece(4, "Conv")
    node += piece(5, ints("kernel_shape", [1, 2])) + piece(5, ints("strides", [1, 2]))
    graph = piece(1, node) + piece(2, "zeros") + piece(5, zeros("weights", 2 * classes, len(CHANNELS), 1, 2))
    graph += piece(11, image("image", len(CHANNELS))) + piece(12, image("scores", 2 * classes))
    return number(1, 7) + piece(7, graph) + piece(8, piece(1, "") + number(2, 11))


def write_network(folder, classes):
    """\\param classes  names, in the table's order; the file's path is returned."""
    file = folder / "segmentation.onnx"
    file.write_bytes(network(len(classes)))
    digest = hashlib.sha256(file.read_bytes()).hexdigest()
    file.with_suffix(".yaml").write_text(
        json.dumps({"classes": classes, "channels": CHANNELS, "sha256": digest}))
    return file
