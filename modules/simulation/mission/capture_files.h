#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "saker/lidar/capture_writer.h"
#include "saker/lidar/imu_packet.h"
#include "saker/lidar/packet.h"
#include "saker/simulation/mission/scenario.h"

namespace saker::simulation {

/// The sensor that a scenario asks for. Throws Error that names the key.
[[nodiscard]] lidar::SensorInfo sensor_info(const CaptureConfig& config);

/// A column of a revolution as the sensor sends it; column k was measured at start + k · period.
[[nodiscard]] lidar::Column column_of(const CastScan& scan, const lidar::SensorInfo& info,
                                      const lidar::PacketFormat& format, int frame_id, int column,
                                      Time start);

/// Writes what the sensor sends as a capture (FOLDER/NAME.pcap, metadata in FOLDER/NAME.json):
/// packets of the window's columns and of the inertial unit in the order of time, some of them
/// lost, repeated or late as configured.
class SensorCapture {
 public:
  SensorCapture(const std::filesystem::path& folder, const std::string& name,
                const CaptureConfig& config, std::uint64_t seed);

  /// Ranges as a decoder should find them: uint32, mm, row-major, staggered; 0 where nothing was
  /// sent.
  using Ranges = std::vector<std::uint32_t>;

  /// One revolution; column k was measured at start + k · column period. Inertial samples up to its
  /// end go with it.
  Ranges write(const CastScan& scan, int frame_id, Time start,
               std::span<const lidar::ImuSample> imu);
  void finish();

  [[nodiscard]] const lidar::SensorInfo& info() const { return info_; }

 private:
  struct Datagram {
    Time time;
    int port;
    std::vector<std::uint8_t> bytes;
  };

  void add_packets(const CastScan& scan, int frame_id, Time start, Ranges& sent);
  void delay_some(std::vector<Datagram>& datagrams);

  lidar::SensorInfo info_;
  lidar::PacketFormat format_;
  CaptureConfig config_;
  core::Rng rng_;
  lidar::CaptureWriter writer_;
  std::vector<Datagram> queue_;
};

}  // namespace saker::simulation
