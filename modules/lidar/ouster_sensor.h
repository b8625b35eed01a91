#pragma once

#include <chrono>

#include "saker/lidar/ouster_stream.h"
#include "saker/lidar/udp_receiver.h"

namespace saker::lidar {

struct OusterSensorOptions {
  int lidar_port = 7502;  ///< 0: any free one
  int imu_port = 7503;
  std::chrono::milliseconds silence{2000};  ///< without a packet, after which `next` gives up
};

/// A live sensor that sends its packets here.
class OusterSensor : public ScanSource {
 public:
  /// Throws Error when a port cannot be had.
  explicit OusterSensor(const SensorInfo& info, const OusterSensorOptions& options);

  /// Waits for the next frame; nothing when the sensor has fallen silent. May be called again then.
  [[nodiscard]] std::optional<Frame> next() override;
  [[nodiscard]] SourceCounters counters() const override { return stream_.counters(); }

  /// Takes all packets that are here, and waits up to `timeout` for the first; false when none
  /// came.
  bool poll(std::chrono::milliseconds timeout);

  [[nodiscard]] int lidar_port() const { return lidar_.port(); }
  [[nodiscard]] int imu_port() const { return imu_.port(); }

 private:
  void drain(UdpReceiver& receiver);

  OusterStream stream_;
  UdpReceiver lidar_;
  UdpReceiver imu_;
  std::chrono::milliseconds silence_;
};

}  // namespace saker::lidar
