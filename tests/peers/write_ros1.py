"""write_ros1.py MESSAGES BAG none|bz2|lz4: a bag by Debian's python3-rosbag, of messages that it read and wrote anew."""

import sys

import genpy
import rosbag
import sensor_msgs.msg

import messages

TYPES = {"sensor_msgs/PointCloud2": sensor_msgs.msg.PointCloud2, "sensor_msgs/Imu": sensor_msgs.msg.Imu}

with rosbag.Bag(sys.argv[2], "w", compression=sys.argv[3], chunk_threshold=20000) as bag:
    for topic, kind, time, content in messages.read(sys.argv[1]):
        message = TYPES[kind]()
        message.deserialize(content)
        bag.write(topic, message, genpy.Time(time // 10**9, time % 10**9))
