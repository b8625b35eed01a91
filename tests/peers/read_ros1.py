"""read_ros1.py BAG MESSAGES: the messages of a bag by Debian's python3-rosbag."""

import sys

import rosbag

import messages

with rosbag.Bag(sys.argv[1]) as bag:
    messages.write(sys.argv[2], [(topic, message[0], time.to_nsec(), message[1])
                                 for topic, message, time in bag.read_messages(raw=True)])
