#pragma once

#include <vector>

#include "saker/lidar/column_count.h"
#include "saker/lidar/sensor_reading.h"
#include "saker/lidar/udp_source.h"

/// Senders that may be the sensor: packets that agree among each other, though not with what is
/// known of it. For the gate (sensor_gate.h).
namespace saker::lidar {

/// Who a sensor is, as far as it is known; 0: not yet.
struct SensorIdentity {
  std::uint32_t address = 0;
  std::uint16_t lidar_port = 0, imu_port = 0;
  PacketSender sender;

  bool operator==(const SensorIdentity&) const = default;
};

/// "192.168.7.2:7502, inertial unit :7503, serial number 122, init id 3".
[[nodiscard]] std::string to_string(const SensorIdentity& identity);

struct ArrivedReading {
  SensorReading reading;
  UdpSource from;
  Time arrival = 0;  ///< ns of the receiver's clock

  [[nodiscard]] Time offset() const { return reading.newest - arrival; }
};

class SensorCandidates {
 public:
  static constexpr int kLidarToAgree = 8,
                       kImuToAgree = 4;        ///< packets: some hundredths of a second
  static constexpr int kImuToAgreeOnStep = 2;  ///< of the sensor that is known

  struct Candidate {
    SensorIdentity identity;
    Time offset = 0;  ///< of its stamps to their arrival, the least late one
    ColumnTime first_column, last_column;
    Time newest_imu = 0, heard = 0;
    Time first_arrival = 0;  ///< of its first packet of the lidar
    int lidar = 0, imu = 0;  ///< packets

    [[nodiscard]] bool agrees() const { return lidar >= kLidarToAgree && imu >= kImuToAgree; }
    [[nodiscard]] bool agrees_on_step() const {
      return lidar >= kLidarToAgree && imu >= kImuToAgreeOnStep;
    }
  };

  explicit SensorCandidates(const SensorInfo& info) : count_(info) { all_.reserve(kMost); }

  /// \param begin  whether it may be a new one's first packet
  /// \return the one that it belongs to, or null. Valid until the next call.
  [[nodiscard]] const Candidate* offer(const ArrivedReading& packet, bool begin);
  void clear() { all_.clear(); }
  /// Whoever sends the lidar's packets as the one that is known does, which was heard just now.
  void drop(const SensorIdentity& known);

 private:
  static constexpr std::size_t kMost = 4;  // the one of whom least was heard gives way

  [[nodiscard]] bool belongs(const ArrivedReading& packet, const Candidate& candidate) const;
  static void add(const ArrivedReading& packet, Candidate& candidate);
  [[nodiscard]] Candidate& place_for_another();

  ColumnCount count_;
  std::vector<Candidate> all_;
};

}  // namespace saker::lidar
