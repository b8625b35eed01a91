#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "saker/lidar/recording.h"
#include "saker/lidar/scan_assembler.h"
#include "saker/lidar/sensor_clock.h"
#include "saker/lidar/sensor_info.h"

namespace saker::lidar {

/// One sensor's packets, lidar and inertial mixed as they arrive, to frames: the same for a capture
/// and for sockets.
///
/// Packets are told apart by their size and head. A frame gets the inertial samples up to its
/// stamp; later ones wait for the next frame. Samples that are not newer than the last one given
/// out are dropped and counted. Where the inertial unit's clock is seconds away from the lidar's,
/// its samples get the time of the lidar packet that arrived before them instead; `imu_by_arrival`
/// says so. Where the sensor's clock steps, stamps go on as if it had not (sensor_clock.h),
/// counted; live, that is the gate's (sensor_gate.h).
class OusterStream {
 public:
  enum class Stamps { may_step, go_on };

  struct Item {
    Frame frame;
    AssembledScan assembled;  ///< its `scan` is moved to the frame
  };

  explicit OusterStream(const SensorInfo& info, bool keep_ranges = false,
                        Stamps stamps = Stamps::may_step);

  /// A UDP payload: any bytes are allowed.
  void add(std::span<const std::uint8_t> payload);
  void finish();
  [[nodiscard]] std::optional<Item> take();

  [[nodiscard]] SourceCounters counters() const;
  [[nodiscard]] int late_imu_samples() const { return late_imu_samples_; }
  [[nodiscard]] bool imu_by_arrival() const { return imu_by_arrival_; }
  [[nodiscard]] std::size_t packet_bytes() const { return format_.packet_bytes(); }
  [[nodiscard]] const SensorInfo& info() const { return info_; }

 private:
  void add_lidar(std::span<const std::uint8_t> payload);
  void add_imu(std::span<const std::uint8_t> payload);
  void place_imu();
  void place(std::vector<ImuSample> samples);
  [[nodiscard]] Time corrected(Time stamp) const;
  void time_by_arrival(std::vector<ImuSample>& samples);
  void keep(const ImuSample& sample);
  [[nodiscard]] std::vector<ImuSample> imu_until(Time stamp);

  SensorInfo info_;
  PacketFormat format_;
  ScanAssembler assembler_;
  SensorClock clock_;
  Stamps stamps_;
  // Packets that wait for the next one of the lidar, which tells whether the clock stepped.
  std::vector<std::vector<ImuSample>> imu_packets_;
  std::deque<ImuSample> imu_;  // by time; the oldest are dropped beyond the ceiling
  Time last_lidar_ = 0;        // stamp of the newest packet's last valid column, as sent
  Time last_imu_given_ = 0;
  bool imu_by_arrival_ = false;
  int imu_apart_ = 0;  // packets in a row whose time is far from the lidar's
  int imu_samples_ = 0;
  int late_imu_samples_ = 0;
  int bad_imu_packets_ = 0;
  int next_name_ = 0;
};

/// Six digits, as scans without a file of their own are named.
[[nodiscard]] std::string running_name(int number);

}  // namespace saker::lidar
