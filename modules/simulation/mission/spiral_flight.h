#pragma once

#include <map>
#include <vector>

#include "saker/lidar/ouster_stream.h"
#include "saker/simulation/mission/spiral_world.h"
#include "saker/simulation/sensor/lidar_unit.h"

namespace saker::simulation {

/// A spiral about one object as a recording: what its LiDAR and inertial unit send, decoded as it
/// would be from sockets. Beside it the truth. A function of its arguments.
class SpiralFlight : public lidar::ScanSource {
 public:
  /// Throws Error on an impossible sensor and a class that cannot be made.
  SpiralFlight(const SpiralConfig& config, const SpiralSubject& subject, std::uint64_t seed);

  [[nodiscard]] std::optional<lidar::Frame> next() override;
  [[nodiscard]] lidar::SourceCounters counters() const override { return stream_.counters(); }
  [[nodiscard]] int expected_scans() const override;

  // Truth.
  [[nodiscard]] const World& world() const { return site_.world; }
  [[nodiscard]] ObjectId subject() const { return site_.subject; }
  [[nodiscard]] Time start() const { return start_; }
  [[nodiscard]] SE3 T_sim_lidar(Time stamp) const;
  /// From the object in the revolution with that stamp; 0 where there was no such revolution.
  [[nodiscard]] int returns(Time stamp, ObjectId object) const;
  [[nodiscard]] const lidar::SensorInfo& sensor() const { return unit_.info(); }

 private:
  void turn();

  SpiralConfig config_;
  SpiralWorld site_;
  RayCaster caster_;
  Time start_;
  LidarUnit unit_;
  DatagramQueue queue_;
  lidar::OusterStream stream_;
  std::vector<lidar::ImuSample> imu_;
  std::size_t imu_sent_ = 0;
  std::vector<int> hits_;  ///< up to the last revolution
  std::map<Time, std::vector<int>> returns_;
};

}  // namespace saker::simulation
