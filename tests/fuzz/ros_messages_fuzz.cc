#include "fuzz.h"
#include "saker/lidar/bags/ros_messages.h"
#include "saker/lidar/spinning/spinning_packet.h"

namespace saker::lidar {

/// The first byte chooses the encoding.
void fuzz::run(ByteView input) {
  if (input.empty()) return;
  const Encoding encoding = input[0] % 2 == 0 ? Encoding::kRos1 : Encoding::kCdr;
  const ByteView bytes = input.subspan(1);
  for (const auto& cloud : {read_point_cloud2(bytes, encoding), read_livox(bytes, encoding)}) {
    if (!cloud) continue;
    PointReader reader(cloud->layout, "message");
    Frame frame;
    frame.fault = reader.read(cloud->data, cloud->rows, cloud->columns, cloud->row_step,
                              cloud->header.stamp, frame.scan);
    if (!frame.fault.empty()) frame.scan = {};
    expect_consistent(frame);
  }
  (void)read_imu(bytes, encoding);
  (void)read_packet(bytes, encoding);
  for (const char* type : {"velodyne_msgs/VelodyneScan", "pandar_msgs/PandarScan", "x"}) {
    for (const TimedPacket& packet : read_packets(bytes, encoding, type)) {
      (void)unread_spinning_packet(packet.bytes);
    }
  }
  (void)read_string(bytes, encoding);
  (void)find_transform(read_transforms(bytes, encoding), "lidar", "imu");
}

}  // namespace saker::lidar
