#pragma once

#include <string>

#include "saker/autonomy/plant.h"
#include "saker/lidar/scan.h"

/// Scans as other programs of robots read them: sensor_msgs/PointCloud2 of ROS 2 in CDR (little
/// endian), with the fields x, y, z and intensity, float32.
namespace saker::flight::viewers {

inline constexpr const char* kRosCloudType = "sensor_msgs/msg/PointCloud2";
/// The type's definition with all that it uses, as MCAP's `ros2msg` wants it.
extern const char* const kRosCloudDefinition;

/// Points that were hit, in the lidar frame; beams without an answer are left out.
[[nodiscard]] std::string ros_cloud(const autonomy::RegisteredScan& scan,
                                    const std::string& frame_id);

/// A scan as the sensor said it: points with a return in their order, with `t` (uint32, ns after
/// the stamp, which is the time of the first of them) and, where beams are known, `ring` (uint16).
/// `reflectivity` and `offset_ns` have one a point.
[[nodiscard]] std::string ros_cloud(const lidar::Scan& scan, const std::string& frame_id);

}  // namespace saker::flight::viewers
