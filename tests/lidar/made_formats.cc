#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "made_bag.h"
#include "made_clouds.h"
#include "saker/core/error.h"
#include "saker/lidar/recording.h"

/// made_formats CAPTURE FOLDER: the recording in other formats, written apart from the readers:
/// FOLDER/ros1.bag, ros2.db3 and mcap.mcap with its inertial samples, plain.bag, pcd/ and bin/
/// without. Times are moved on by kDriveBegin, so that names of files can hold them.
namespace saker::lidar::testing {
namespace {

namespace fs = std::filesystem;

/// Of a scan's points with a return, in its order.
struct Cloud {
  Time begin = 0;
  std::vector<MadePoint> points;
};

Cloud cloud_of(const Scan& scan) {
  Cloud cloud;
  const auto first = *std::min_element(scan.offset_ns.begin(), scan.offset_ns.end());
  cloud.begin = kDriveBegin + scan.stamp + first;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    if (!p.allFinite()) continue;
    cloud.points.push_back(
        {p.x(), p.y(), p.z(), std::round(255 * scan.reflectivity[i]),
         static_cast<std::uint32_t>(scan.offset_ns[i] - first),
         static_cast<std::uint16_t>(i / static_cast<std::size_t>(scan.columns))});
  }
  return cloud;
}

std::vector<MadeMessage> messages_of(const std::vector<Frame>& frames, Encoding encoding,
                                     bool inertial) {
  std::vector<MadeMessage> messages;
  for (const Frame& frame : frames) {
    for (const ImuSample& sample : frame.imu) {
      const Time stamp = kDriveBegin + sample.stamp;
      if (!inertial) continue;
      messages.push_back(
          {"/imu", "sensor_msgs/Imu", stamp,
           made_imu(stamp, sample.acceleration, sample.angular_velocity, encoding, "lidar")});
    }
    const Cloud cloud = cloud_of(frame.scan);
    messages.push_back({"/points", "sensor_msgs/PointCloud2", kDriveBegin + frame.scan.stamp,
                        made_cloud(cloud.points, cloud.begin, encoding)});
  }
  return messages;
}

void write_all(const std::vector<Frame>& frames, const fs::path& folder) {
  for (const char* name : {"pcd", "bin"}) fs::create_directories(folder / name);
  write_bytes(folder / "ros1.bag", made_ros1_bag(messages_of(frames, Encoding::kRos1, true)));
  write_bytes(folder / "plain.bag", made_ros1_bag(messages_of(frames, Encoding::kRos1, false)));
  write_ros2_database(messages_of(frames, Encoding::kCdr, true), folder / "ros2.db3");
  write_bytes(folder / "mcap.mcap",
              made_mcap(messages_of(frames, Encoding::kCdr, true), Encoding::kCdr));
  for (const Frame& frame : frames) {
    const Cloud cloud = cloud_of(frame.scan);
    const std::string name = std::to_string(cloud.begin);
    write_bytes(folder / "pcd" / (name + ".pcd"), made_pcd("binary", cloud.points));
    write_bytes(folder / "bin" / (name + ".bin"), made_floats(cloud.points));
  }
}

}  // namespace
}  // namespace saker::lidar::testing

int main(int count, char** arguments) {
  if (count != 3) {
    std::cerr << "usage: made_formats CAPTURE FOLDER\n";
    return 2;
  }
  try {
    const auto source = saker::lidar::open_recording(arguments[1]);
    std::vector<saker::lidar::Frame> frames;
    while (auto frame = source->next()) frames.push_back(std::move(*frame));
    saker::lidar::testing::write_all(frames, arguments[2]);
  } catch (const saker::Error& error) {
    std::cerr << "made_formats: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
