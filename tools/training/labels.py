"""What the network tells apart, the SemanticKITTI ids of each, and the class of objects::ClassTable that it is merged into."""
import numpy as np

# (output, class, ids); id 21 is the simulator's own: SemanticKITTI counts vans as cars.
TABLE = [
    ("other", "other", [52, 99]),
    ("car", "vehicle", [10, 252]),
    ("van", "vehicle", [21]),
    ("truck", "vehicle", [18, 258]),
    ("bus", "vehicle", [13, 257]),
    ("other_vehicle", "vehicle", [20, 259]),
    ("person", "other", [30, 254]),
    ("two_wheeler", "other", [11, 15, 31, 32, 253, 255]),
    ("vegetation", "other", [70]),
    ("building", "other", [50]),
    ("fence", "other", [51]),
    ("trunk", "trunk", [71]),
    ("pole", "pole", [80]),
    ("ground", "ground", [40, 44, 48, 49, 60, 72]),
]
OUTPUTS = [output for output, _, _ in TABLE]
CLASSES = ["other", "vehicle", "trunk", "pole", "ground"]
CLASS_OF = np.array([CLASSES.index(name) for _, name, _ in TABLE])
WRITTEN = np.array([99, 10, 71, 80, 40], np.uint32)
IGNORED = 255
IGNORED_IDS = [0, 1, 81]


def table():
    """Output of each id; what has no label, and traffic signs, count neither way."""
    lut = np.zeros(1 << 16, np.uint8)
    for number, (_, _, ids) in enumerate(TABLE):
        lut[ids] = number
    lut[IGNORED_IDS] = IGNORED
    return lut


def merged(outputs):
    """Class of each output number; IGNORED stays."""
    lut = np.full(256, IGNORED, np.uint8)
    lut[: len(CLASS_OF)] = CLASS_OF
    return lut[outputs]
