#pragma once

#include <string>
#include <vector>

#include "saker/lidar/bags/message_file.h"

/// Which topics of a bag hold the scans and the inertial samples.
namespace saker::lidar {

enum class ScanMessage { kPointCloud2, kLivox, kOusterPackets, kSpinningPackets };

struct TopicChoice {
  ScanMessage kind = ScanMessage::kPointCloud2;
  std::vector<std::size_t> scans;  ///< one topic; of packets those of one sensor
  int imu = -1;                    ///< topic of sensor_msgs/Imu; −1: none, or in the packets
  std::string name;                ///< of the topic with the scans
  std::string imu_name;
};

/// By type; `wanted` names topics where there are several. Throws Error (`where` is what it begins
/// with) when there are no scans, or several topics with some and none is named.
[[nodiscard]] TopicChoice choose_topics(const std::vector<Topic>& topics,
                                        const std::vector<std::string>& wanted,
                                        const std::string& where);

/// Topics that tell of the sensor and of how things are mounted.
[[nodiscard]] bool is_metadata(const Topic& topic);
[[nodiscard]] bool is_static_transform(const Topic& topic);

}  // namespace saker::lidar
