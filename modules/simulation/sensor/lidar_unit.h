#pragma once

#include <deque>
#include <functional>

#include "saker/lidar/packet.h"
#include "saker/lidar/sensor_info.h"
#include "saker/simulation/mission/mission_config.h"
#include "saker/simulation/sensor/scanner.h"

namespace saker::simulation {

/// A UDP payload under way.
struct SensorDatagram {
  Time received = 0;
  int port = 0;
  std::vector<std::uint8_t> payload;
};

/// What has been sent and has not been taken, in the order of arrival. Has a ceiling: the oldest go
/// first, as from a socket's buffer that nobody reads.
class DatagramQueue {
 public:
  static constexpr std::size_t kMost = 4096;

  void add(SensorDatagram datagram);
  [[nodiscard]] std::vector<SensorDatagram> take_until(Time now);
  [[nodiscard]] std::int64_t dropped() const { return dropped_; }

 private:
  std::deque<SensorDatagram> queue_;
  std::int64_t dropped_ = 0;
};

/// A turning LiDAR: one packet's columns at a time, each cast from where the lidar is at that
/// column's time, as packets with their time of arrival; some of them lost, repeated or late as
/// configured.
class LidarUnit {
 public:
  using PoseAt = std::function<SE3(Time)>;  ///< T_sim_lidar

  /// The first column is measured at `start`. Throws Error on an impossible sensor.
  LidarUnit(const MissionConfig& config, const RayCaster& caster, const World& world, Time start,
            std::uint64_t seed);

  /// When the next packet's last column is measured: `turn` may be called then.
  [[nodiscard]] Time block_end() const;
  /// The next packet's columns. \return whether they end a revolution.
  bool turn(const PoseAt& pose_at, DatagramQueue& out);

  /// Of the revolution that ended last: time of its last column that is sent.
  [[nodiscard]] Time scan_stamp() const { return scan_stamp_; }
  [[nodiscard]] int revolutions() const { return frame_; }
  /// Returns by ObjectId so far.
  [[nodiscard]] const std::vector<int>& hits() const { return hits_; }
  [[nodiscard]] const lidar::SensorInfo& info() const { return info_; }

 private:
  [[nodiscard]] Time column_time(int column) const;
  [[nodiscard]] int last_sent_column() const;
  void send(int first_column, DatagramQueue& out);

  CaptureConfig config_;
  lidar::SensorInfo info_;
  lidar::PacketFormat format_;
  Time latency_;
  const World* world_;
  Scanner scanner_;
  core::Rng network_;

  Time start_;
  int frame_ = 0;
  int block_ = 0;
  core::Rng rng_;  // of the revolution under way
  CastScan scan_;
  Time scan_stamp_ = 0;
  std::vector<int> hits_;
};

}  // namespace saker::simulation
