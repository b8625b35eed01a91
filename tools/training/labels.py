"""Classes of the network and the SemanticKITTI ids that are merged into them (as objects::ClassTable)."""
import numpy as np

CLASSES = ["other", "vehicle", "trunk", "pole", "ground"]
IDS = {
    "vehicle": [10, 13, 18, 20, 252, 257, 258, 259],
    "trunk": [71],
    "pole": [80],
    "ground": [40, 44, 48, 49, 60, 72],
}
WRITTEN = np.array([99, 10, 71, 80, 40], np.uint32)
IGNORED = 255
IGNORED_IDS = [0, 1, 81]


def table():
    """Class of each id; what has no label, and traffic signs, count neither way."""
    lut = np.zeros(1 << 16, np.uint8)
    for number, name in enumerate(CLASSES):
        lut[IDS.get(name, [])] = number
    lut[IGNORED_IDS] = IGNORED
    return lut
