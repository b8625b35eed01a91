#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "made_messages.h"
#include "made_sensor.h"
#include "saker/lidar/spinning/spinning_model.h"

/// Packets of Velodyne's and Hesai's sensors in a box whose walls are known, written apart from the
/// readers by the makers' manuals.
namespace saker::lidar::testing {

/// Walls at x = −10 and 12 m, y = −8 and 9 m, floor and ceiling at z = −2 and 7 m.
inline const Eigen::Array3d kBoxLeast(-10, -8, -2), kBoxMost(12, 9, 7);

/// From the origin along a direction of length 1, m.
[[nodiscard]] double box_range(const Eigen::Vector3d& direction);
/// Of a point from the nearest of the box's faces, m.
[[nodiscard]] double off_the_box(const Eigen::Vector3d& point);

struct MadeSpinning {
  SpinningModel model;
  double turns = 2.5;
  double first_azimuth_deg = 300;  ///< so that the first scan is a short one
  double turning_deg_us = 360 * 10e-6;
  bool two_returns = false;  ///< the other one 3 m farther; every seventh has only that
  double unit_m = 0.002;     ///< of a range; 0.004 of a VLP-32C and Hesai's
  Time begin = kDriveBegin + 10 * kNanosecondsPerSecond;  ///< of the first packet
};

struct MadePacket {
  Bytes bytes;
  Time time = 0;  ///< of its first block, true
};

/// A VLP-16 and so on as its manual has it; an HDL-64E with `made_calibration`.
[[nodiscard]] MadeSpinning made_spinning(SpinningKind kind);
[[nodiscard]] std::vector<MadePacket> made_packets(const MadeSpinning& made);

/// Of an HDL-64E, as YAML (ROS) and as Velodyne's XML, the same numbers.
[[nodiscard]] std::string made_calibration_yaml();
[[nodiscard]] std::string made_calibration_xml();

/// A capture of the packets, received 0.1 ms after their time.
void write_capture(const std::vector<MadePacket>& packets, const std::filesystem::path& file,
                   int port = 2368);

/// Messages of `type`, a hundred packets each.
[[nodiscard]] std::vector<MadeMessage> made_packet_messages(const std::vector<MadePacket>& packets,
                                                            const std::string& type,
                                                            Encoding encoding);

}  // namespace saker::lidar::testing
