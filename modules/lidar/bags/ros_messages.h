#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "saker/lidar/bags/message_file.h"
#include "saker/lidar/clouds/point_layout.h"

/// The few messages of ROS that hold scans and what belongs to them, in the bytes of ROS 1 or in
/// CDR (OMG's DDSI-RTPS, "extended CDR", little or big-endian). Each reader gives nothing where the
/// bytes are too few for what they say.
namespace saker::lidar {

/// Numbers and texts of one message, wherever its encoding puts them.
class MessageReader {
 public:
  MessageReader(ByteView bytes, Encoding encoding);

  template <class T>
  T number() {
    if (cdr_) cursor_.align(sizeof(T));
    return cursor_.number<T>();
  }
  [[nodiscard]] std::string text();
  /// A sequence of bytes.
  [[nodiscard]] ByteView bytes();
  [[nodiscard]] Eigen::Vector3d vector();
  /// Elements of a sequence of at least so many bytes each; 0 where there are fewer.
  [[nodiscard]] std::size_t count(std::size_t least_bytes = 1);
  void skip_numbers(std::size_t numbers);  ///< of float64
  /// An array of so many bytes.
  [[nodiscard]] ByteView array(std::size_t bytes) { return cursor_.take(bytes); }
  [[nodiscard]] Time time();

  struct Header {
    Time stamp = 0;
    std::string frame;
  };
  [[nodiscard]] Header header();

  [[nodiscard]] bool ok() const { return cursor_.ok(); }

 private:
  bool cdr_;
  Cursor cursor_;
};

/// sensor_msgs/PointCloud2, and livox_ros_driver's CustomMsg turned into one.
struct CloudMessage {
  MessageReader::Header header;
  PointLayout layout;
  std::size_t rows = 0, columns = 0, row_step = 0;
  ByteView data;  ///< in the message, or in `made`
  std::vector<std::uint8_t> made;
};
[[nodiscard]] std::optional<CloudMessage> read_point_cloud2(ByteView bytes, Encoding encoding);
[[nodiscard]] std::optional<CloudMessage> read_livox(ByteView bytes, Encoding encoding);

/// sensor_msgs/Imu, as it stands there.
struct ImuMessage {
  MessageReader::Header header;
  Eigen::Vector3d acceleration, angular_velocity;
};
[[nodiscard]] std::optional<ImuMessage> read_imu(ByteView bytes, Encoding encoding);

/// ouster_ros/PacketMsg: the packet.
[[nodiscard]] std::optional<ByteView> read_packet(ByteView bytes, Encoding encoding);

/// Packets of a spinning sensor: velodyne_msgs/VelodyneScan, pandar_msgs/PandarScan (arrays of
/// fixed length), hesai_lidar/PandarScan and hesai_ros_driver/UdpFrame (sequences).
struct TimedPacket {
  Time received = 0;
  ByteView bytes;
};
[[nodiscard]] std::vector<TimedPacket> read_packets(ByteView bytes, Encoding encoding,
                                                    const std::string& type);

/// std_msgs/String.
[[nodiscard]] std::optional<std::string> read_string(ByteView bytes, Encoding encoding);

/// One of tf2_msgs/TFMessage: T_parent_child.
struct TransformMessage {
  std::string parent, child;
  Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();
};
[[nodiscard]] std::vector<TransformMessage> read_transforms(ByteView bytes, Encoding encoding);

/// T_a_b by way of the transforms there are; nothing where no way leads from one to the other.
[[nodiscard]] std::optional<Eigen::Isometry3d> find_transform(
    const std::vector<TransformMessage>& transforms, const std::string& a, const std::string& b);

}  // namespace saker::lidar
