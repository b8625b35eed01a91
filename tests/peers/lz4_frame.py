"""An LZ4 frame of what comes in, by ROS's own library."""

import sys

import roslz4

sys.stdout.buffer.write(roslz4.compress(sys.stdin.buffer.read()))
