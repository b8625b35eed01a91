"""The network's inputs, by the C++ code that the flight uses (modules/segmentation/training_inputs.cc)."""
import ctypes
import os
import pathlib

import numpy as np

LIBRARY = "libsaker_training_inputs.so"
MAX_PIXELS = 80 * 1024


def load_library():
    """Built by `scripts/build`; SAKER_TRAINING_INPUTS names another one."""
    built = pathlib.Path(__file__).resolve().parents[2] / "build/release/lib" / LIBRARY
    return ctypes.CDLL(os.environ.get("SAKER_TRAINING_INPUTS", str(built)))


_library = load_library()
_library.saker_channel_name.restype = ctypes.c_char_p
CHANNELS = _library.saker_channels()
CHANNEL_NAMES = [_library.saker_channel_name(i).decode() for i in range(CHANNELS)]
LOG_RANGE = CHANNEL_NAMES.index("log_range")


def _pointer(array):
    return array.ctypes.data_as(ctypes.c_void_p)


def project(points, ring=None):
    """Index of the point in each pixel (rows, columns), -1 for none, and the pixel of each point, of (n, 3) points."""
    points = np.ascontiguousarray(points, np.float32)
    size = np.zeros(2, np.int32)
    point = np.empty(MAX_PIXELS, np.int32)
    pixel = np.empty(len(points), np.int32)
    ring = None if ring is None else np.ascontiguousarray(ring, np.uint16)
    rings = None if ring is None else _pointer(ring)
    _library.saker_project(_pointer(points), rings, len(points), _pointer(size), _pointer(point), _pointer(pixel))
    return point[: size[0] * size[1]].reshape(size[0], size[1]).copy(), pixel


def features(image):
    """Channels of an image of points (rows, columns, 3), NaN where nothing returned: (channels, rows, columns)."""
    image = np.ascontiguousarray(image, np.float32)
    rows, columns = image.shape[:2]
    out = np.empty((CHANNELS, rows, columns), np.float32)
    _library.saker_features(_pointer(image), rows, columns, _pointer(out))
    return out
